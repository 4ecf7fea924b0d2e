#include "io/report/report_sections.h"

#include "fit/intervals/left_out.h"
#include "io/plots/plot_svg.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"
#include "io/report/report_tables.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>

namespace viscard {
namespace {

bool has_truth(const ReportInput& input) {
  return std::any_of(input.specimens.begin(), input.specimens.end(),
                     [](const SpecimenReport& specimen) { return specimen.truth.has_value(); });
}

// The text of a flag, whose term the page names beside the specimen.
std::string without_term(const MaterialFlag& flag) {
  const std::string stem = fmt::format("term {}: ", flag.term);
  return flag.text.starts_with(stem) ? flag.text.substr(stem.size()) : flag.text;
}

void add_flags(Page& page, const std::vector<SpecimenEstimates>& estimates) {
  std::string items;
  for (const SpecimenEstimates& specimen : estimates) {
    for (const MaterialFlag& flag : specimen.flags) {
      const std::string where =
          flag.term > 0 ? fmt::format("{}, term {}", specimen.label, flag.term) : specimen.label;
      items += fmt::format("<li><b>{}:</b> {} <code>{}</code></li>\n", escaped_markup(where),
                           escaped_markup(without_term(flag)), escaped_markup(flag.name));
    }
  }
  if (items.empty()) return;
  page.add_heading(3, "flags", "What the data could not determine");
  page.add_html("<ul class=\"flags\">\n" + items + "</ul>\n");
}

std::string summary_caption(const std::vector<SpecimenEstimates>& estimates) {
  std::string text =
      estimates.front().is_stiffness
          ? "Instantaneous stiffness (<i>R</i><sub>0</sub>) and equilibrium stiffness "
            "(<i>R</i><sub>∞</sub>). No punch geometry was given, so no modulus is claimed."
          : "Instantaneous (<i>E</i><sub>0</sub>) and equilibrium (<i>E</i><sub>∞</sub>) Young's "
            "modulus.";
  text +=
      " Brackets hold 95 % intervals from the record alone. The systematic part (geometry, "
      "calibration, frame), also at 95 %, is that of the instantaneous value. Frame and load cell "
      "change <i>g</i> and <i>τ</i> as well; <code>viscard fit</code> prints the intervals of "
      "<i>g</i> that include it.";
  const auto with = std::find_if(estimates.begin(), estimates.end(), [](const auto& specimen) {
    return specimen.two_point.has_value();
  });
  if (with != estimates.end()) {
    text += " The two-point modulus is a cross-check, not a result";
    if (!with->two_point->bias.empty()) {
      text += fmt::format(" (of {}: {})", escaped_markup(with->label),
                          escaped_markup(with->two_point->bias));
    }
    text += ".";
  }
  return text;
}

// Two digits of an error are enough.
std::string rough_html(double value) {
  const Interval two_digits{0.9 * value, 1.1 * value};
  return number_html(value, 1.0, value > 0.0 ? &two_digits : nullptr);
}

std::string run_caption(const CapturedRun& run, const RunSeries& series) {
  std::string text =
      fmt::format("The run as recorded, times since it began: {} readings", series.time_s.size());
  if (!series.flagged_s.empty())
    text += fmt::format(" and {} flagged ones (drawn at the edge if they are outside)",
                        series.flagged_s.size());
  text += fmt::format(" of the {}, {} of the stage", series.is_force ? "force gauge" : "amplifier",
                      counted(run.stage_reports.size(), "report"));
  text += series.depth_m.empty()
              ? ", over its own position axis."
              : ". The depth of the punch is the stage position minus the contact position and the "
                "deflection of the frame. Most of the approach is not shown.";
  if (run.status != "finished") text += " <b>This run was " + escaped_markup(run.status) + ".</b>";
  return text;
}

}  // namespace

std::string fit_caption(const FitResult& fit, bool is_relative) {
  const bool is_punch = fit.kind == FitKind::kIndentation;
  const bool is_oscillation = !fit.curves.loss_measured.empty();
  std::string text = fmt::format(
      "{} and fit with {}, {}",
      is_oscillation ? "Storage modulus (rings, solid line), loss modulus (squares, dashed line) "
                       "and their ratio tan δ"
                     : "Data (dots; averages of neighbours where samples are dense)",
      counted(fit.terms.size(), "term"),
      is_oscillation ? counted(fit.n_samples, "row") : counted(fit.n_samples, "sample"));
  if (fit.n_spikes > 0) text += fmt::format(", {} omitted as spikes", fit.n_spikes);
  if (fit.n_left_out > fit.n_spikes) text += "; " + escaped_markup(left_out_text(fit));
  text += fit.curves.sigma.size() == fit.curves.time_s.size()
              ? ". Below: the difference divided by its standard deviation"
              : ". Below: the difference";
  text += is_oscillation ? "." : ", over the logarithm of time and in time order.";
  if (is_punch) text += " The force axis shows the range of the hold.";
  if (is_relative && fit.noise.sigma > 0.0) {
    text += fmt::format(" Noise: {} % of each modulus; variance factor for autocorrelation {}.",
                        readable_number(100.0 * fit.noise.sigma, 3),
                        readable_number(fit.noise.inflation, 3));
  } else if (fit.noise.sigma > 0.0) {
    const std::string base = fit.curves.unit;
    const ShownUnit unit = shown_unit(base, {fit.noise.sigma});
    text += fmt::format(" Noise of one sample: {} {}; variance factor for autocorrelation {}.",
                        readable_number(fit.noise.sigma * unit.per_si, 3),
                        escaped_markup(unit.text), readable_number(fit.noise.inflation, 3));
  }
  return text;
}

void add_summary(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates) {
  page.add_heading(2, "summary", "Summary");
  page.add_table(summary_table(estimates), summary_caption(estimates));
  const std::string dashes =
      has_truth(input) ? " Dashed: the true material of the emulated rig." : "";
  if (const auto plot = relaxation_plot(input, estimates)) {
    page.add_figure(*plot, "relaxation",
                    "Relaxation of all specimens: absolute (left) and relative to the first value "
                    "(right). Bands are 95 % intervals from the records alone." +
                        dashes);
  }
  page.add_html("<div class=\"row\">\n");  // side by side if the page is wide enough
  if (const auto plot = ratio_plot(input, estimates)) {
    std::string caption = "Instantaneous modulus over mixing ratio.";
    if (input.law) caption += " " + escaped_markup(input.law->text);
    page.add_figure(*plot, "mixing_ratio", caption);
  }
  if (const auto plot = spectrum_plot(input, estimates)) {
    page.add_figure(
        *plot, "spectrum",
        "Relaxation spectrum: relative moduli over relaxation times. Bars are 95 % intervals.");
  }
  page.add_html("</div>\n");
  const HtmlTable spread = spread_table(estimates);
  if (!spread.is_empty()) {
    page.add_table(
        spread,
        "Repeated specimens of a mixing ratio: the standard deviation between specimens, relative "
        "to the mean, and the median standard error of a single fit. If the first is larger, the "
        "specimens differ by more than the error of the fit.");
  }
  const HtmlTable levels = levels_table(input.law ? input.law->scatter : std::vector<Scatter>{});
  if (!levels.is_empty()) {
    page.add_table(
        levels,
        "Scatter at three levels, as standard deviations: of <i>E</i><sub>0</sub> in per "
        "cent of itself, of the share that relaxes in per cent of <i>E</i><sub>0</sub>. "
        "The errors of the single fits are not in it.");
  }
  const HtmlTable terms = terms_table(estimates);
  if (!terms.is_empty()) {
    const char* form = estimates.front().is_stiffness ? "R" : "E";
    page.add_table(terms,
                   fmt::format("Prony series <i>{0}</i>(<i>t</i>) = <i>{0}</i><sub>0</sub> [1 − Σ "
                               "<i>g<sub>i</sub></i> (1 − "
                               "e<sup>−<i>t</i>/<i>τ<sub>i</sub></i></sup>)], with 95 % intervals.",
                               form));
  }
  add_flags(page, estimates);
}

void add_recovery(Page& page, const ReportInput& input,
                  const std::vector<SpecimenEstimates>& estimates) {
  const HtmlTable table = recovery_table(input, estimates);
  if (table.is_empty()) return;
  const RecoveryCount count = count_recovery(input, estimates);
  page.add_heading(2, "truth", "Truth and estimate");
  std::string text = fmt::format(
      "The runs come from an emulated rig whose truth is known. {} of {} intervals contain it",
      count.n_inside, count.n);
  if (count.n_inside_with_systematic > 0) {
    text +=
        fmt::format(", {} more do with the systematic part added", count.n_inside_with_systematic);
  }
  if (count.n_not_resolved > 0) text += fmt::format("; {} were not resolved", count.n_not_resolved);
  text += fmt::format("; <i>E</i><sub>0</sub> is off by at most {:.2g} %.",
                      100.0 * count.largest_E0_error);
  page.add_paragraph(text);
  page.add_table(table, "The true values of the emulated rig and the estimates of the fit.");
}

void add_pillar(Page& page, const ReportInput& input,
                const std::vector<SpecimenEstimates>& estimates) {
  const auto plot = pillar_plot(input, estimates);
  if (!plot) return;
  page.add_heading(2, "pillar", "The fitted material in a pillar");
  HtmlTable table({{"Specimen", false},
                   {"Relaxation, largest relative error"},
                   {"Creep, largest relative error"}});
  std::string setup;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const std::optional<PillarCheck>& pillar = input.specimens[i].pillar;
    if (!pillar) continue;
    if (setup.empty()) setup = pillar->setup;
    table.add_row({escaped_markup(estimates[i].label),
                   rough_html(pillar->relaxation.largest_relative_error),
                   rough_html(pillar->creep.largest_relative_error)});
  }
  if (!setup.empty()) page.add_paragraph(escaped_markup(setup));
  page.add_figure(*plot, "pillar",
                  "Above: the time-stepping solver (marks, some of its steps) and the exact "
                  "solution (lines), relative to the first value. Below: the relative error of "
                  "every step; errors below 10⁻¹⁶ are drawn at 10⁻¹⁶.");
  page.add_table(table, "Agreement of the solver with the exact solution.");
}

void add_specimen(Page& page, const SpecimenReport& specimen, const SpecimenEstimates& estimates) {
  RunSeries series;
  if (specimen.run && specimen.fit) {
    series = series_from_run(*specimen.run, specimen.fit->contact_position_m,
                             specimen.fit->curves.motion_start_s);
  } else if (specimen.run) {
    series = series_from_run(*specimen.run, std::nullopt);
  }
  const auto recorded = specimen.run ? run_plot(series) : std::nullopt;
  const auto fitted =
      specimen.fit ? fit_plot(*specimen.fit, specimen.shift.has_value()) : std::nullopt;
  const bool is_relative = specimen.shift || (specimen.fit && specimen.fit->kind == FitKind::kDma);
  const bool has_orders = specimen.fit && !specimen.fit->orders.empty();
  page.add_heading(2, estimates.anchor, estimates.label);
  for (const std::string& note : specimen.notes) page.add_paragraph(escaped_markup(note));
  if (!recorded && !fitted && !has_orders) {
    page.add_paragraph("Known from its material file only: no recorded data and no fit to show.");
    return;
  }
  if (recorded) page.add_figure(*recorded, "run", run_caption(*specimen.run, series));
  if (fitted) page.add_figure(*fitted, "fit", fit_caption(*specimen.fit, is_relative));
  if (specimen.fit) add_tests(page, *specimen.fit);
  if (const auto shifts = specimen.shift ? shift_plot(*specimen.shift) : std::nullopt) {
    page.add_figure(
        *shifts, "shift",
        fmt::format("Shift factors of the isotherms, reference {:.4g} °C: as taken "
                    "({}) with the 95 % band, and fitted free with 95 % intervals.",
                    specimen.shift->T_ref_C, escaped_markup(specimen.shift->form_text)));
  }
  if (const auto profiles = specimen.fit ? profile_plot(*specimen.fit) : std::nullopt) {
    page.add_figure(
        *profiles, "profiles",
        "Profile likelihoods: rise of the residual sum of squares, divided by the variance of the "
        "noise, while one parameter is held and all others are fitted again. The 95 % interval "
        "ends at the dashed line, 3.84; it is asymmetric if the curve is not a parabola." +
            std::string(specimen.run ? " The times are those of specimen and frame in series."
                                     : ""));
  }
  if (const auto spectrum = specimen.fit ? spectrum_panel(*specimen.fit) : std::nullopt) {
    page.add_figure(
        Plot{.title = "Continuous spectrum",
             .description = "The smoothest relaxation spectrum that the data allow, with the band "
                            "of all spectra.",
             .panels = {*spectrum},
             .height_px = 320},
        "spectrum",
        fmt::format("The relaxation spectrum H(τ) = dE/d ln τ without a number of terms: the "
                    "smoothest one that the "
                    "data allow, and the band of the mean over half a decade of all of them. "
                    "Lines: the times of the "
                    "series. Over these times, all spectra allow E0 from {:.5g} to {:.5g} {} and "
                    "E∞ from {:.5g} to {:.5g} {}.",
                    specimen.fit->spectrum->E0_95.low, specimen.fit->spectrum->E0_95.high,
                    specimen.fit->is_stiffness ? "N/m" : "Pa", specimen.fit->spectrum->E_inf_95.low,
                    specimen.fit->spectrum->E_inf_95.high,
                    specimen.fit->is_stiffness ? "N/m" : "Pa"));
  }
  if (has_orders) {
    page.add_table(
        orders_table(*specimen.fit),
        "Orders tried. AICc and BIC are differences from their smallest value; cross-validation is "
        "the error of predicting omitted blocks, divided by that of the noise.");
  }
}

}  // namespace viscard
