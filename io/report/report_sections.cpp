#include "io/report/report_sections.h"

#include "io/plots/plot_svg.h"
#include "io/report/report_campaign.h"
#include "io/report/report_figures.h"
#include "io/report/report_numbers.h"
#include "io/report/report_tables.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

bool has_truth(const ReportInput& input) {
  return std::any_of(input.specimens.begin(), input.specimens.end(),
                     [](const SpecimenReport& specimen) { return specimen.truth.has_value(); });
}

void add_flags(Page& page, const std::vector<SpecimenEstimates>& estimates) {
  std::string items;
  for (const SpecimenEstimates& specimen : estimates) {
    for (const MaterialFlag& flag : specimen.flags) {
      const std::string where =
          flag.term > 0 ? fmt::format("{}, term {}", specimen.label, flag.term) : specimen.label;
      items += fmt::format("<li><b>{}:</b> {} <code>{}</code></li>\n", escaped_markup(where),
                           escaped_markup(flag.text), escaped_markup(flag.name));
    }
  }
  if (items.empty()) return;
  page.add_heading(3, "flags", "What the data could not tell");
  page.add_html("<ul class=\"flags\">\n" + items + "</ul>\n");
}

std::string summary_caption(const std::vector<SpecimenEstimates>& estimates) {
  std::string text = estimates.front().is_stiffness
                         ? "Stiffness at once (<i>R</i><sub>0</sub>) and in the end "
                           "(<i>R</i><sub>∞</sub>): no punch geometry was given, so no modulus is "
                           "claimed."
                         : "Young's modulus at once (<i>E</i><sub>0</sub>) and in the end "
                           "(<i>E</i><sub>∞</sub>).";
  text +=
      " In brackets 95 % intervals from the record alone; the systematic part "
      "(geometry, calibration, frame), also at 95 %, scales all moduli of a specimen together "
      "and leaves every <i>g</i> and <i>τ</i> as it is.";
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

std::string fit_caption(const FitResult& fit) {
  const bool is_punch = fit.kind == FitKind::kIndentation;
  std::string text = fmt::format(
      "Data (dots; averages of neighbours where samples crowd) and fit with {}, {} samples",
      counted(fit.terms.size(), "term"), fit.n_samples);
  if (fit.n_spikes > 0) text += fmt::format(", {} left out as spikes", fit.n_spikes);
  text += fit.curves.sigma.size() == fit.curves.time_s.size()
              ? "; below, the difference in units of its standard deviation."
              : "; below, the difference.";
  if (is_punch) text += " The force axis shows the hold and cuts the motion before it off.";
  if (fit.noise.sigma > 0.0) {
    const std::string base = fit.curves.unit;
    const ShownUnit unit = shown_unit(base, {fit.noise.sigma});
    text += fmt::format(" Noise of one sample: {} {}; variance factor for autocorrelation {}.",
                        readable_number(fit.noise.sigma * unit.per_si, 3),
                        escaped_markup(unit.text), readable_number(fit.noise.inflation, 3));
  }
  return text;
}

// An error is known to two digits at best.
std::string rough_html(double value) {
  const Interval two_digits{0.9 * value, 1.1 * value};
  return number_html(value, 1.0, value > 0.0 ? &two_digits : nullptr);
}

std::string run_caption(const CapturedRun& run, const RunSeries& series) {
  std::string text =
      fmt::format("The run as recorded, times since it began: {} readings", series.time_s.size());
  if (!series.flagged_s.empty())
    text += fmt::format(" and {} flagged (drawn at the edge where they lie beyond)",
                        series.flagged_s.size());
  text += fmt::format(" of the {}, {} of the stage", series.is_force ? "force gauge" : "amplifier",
                      counted(run.stage_reports.size(), "report"));
  text += series.depth_m.empty()
              ? "; position on the stage's own axis."
              : "; depth of the punch below contact, that is, stage position less contact position "
                "and deflection of the frame. The approach far above the surface is cut off.";
  if (run.status != "finished") text += " <b>This run was " + escaped_markup(run.status) + ".</b>";
  return text;
}

}  // namespace

void add_summary(Page& page, const ReportInput& input,
                 const std::vector<SpecimenEstimates>& estimates) {
  page.add_heading(2, "summary", "Summary");
  page.add_table(summary_table(estimates), summary_caption(estimates));
  const std::string dashes =
      has_truth(input) ? " Dashed: the truth the emulated rig was made with." : "";
  if (const auto plot = relaxation_plot(input, estimates)) {
    page.add_figure(
        *plot, "relaxation",
        "Relaxation of all specimens, left in absolute terms, right relative to the first "
        "value; bands are 95 % intervals from the records alone." +
            dashes);
  }
  page.begin_row_of_figures();
  if (const auto plot = ratio_plot(input, estimates)) {
    std::string caption = "Instantaneous modulus over mixing ratio.";
    if (input.law) caption += " " + escaped_markup(input.law->text);
    page.add_figure(*plot, "mixing_ratio", caption);
  }
  if (const auto plot = spectrum_plot(input, estimates)) {
    page.add_figure(*plot, "spectrum",
                    "Relaxation spectrum: relative moduli over relaxation times, bars are 95 % "
                    "intervals of both.");
  }
  page.end_row_of_figures();
  const HtmlTable spread = spread_table(estimates);
  if (!spread.is_empty()) {
    page.add_table(
        spread,
        "Repeated specimens of a mixing ratio: standard deviation between specimens, "
        "relative to the mean, beside the standard error of a single fit (median). Where "
        "the first is larger, specimens differ by more than the fit can err.");
  }
  const HtmlTable terms = terms_table(estimates);
  if (!terms.is_empty()) {
    const char* form = estimates.front().is_stiffness ? "R" : "E";
    page.add_table(terms,
                   fmt::format("Prony series <i>{0}</i>(<i>t</i>) = <i>{0}</i><sub>0</sub> [1 − "
                               "Σ <i>g<sub>i</sub></i> (1 − e<sup>−<i>t</i>/<i>τ<sub>i</sub></i>"
                               "</sup>)], with 95 % intervals.",
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
        fmt::format(", {} more once the systematic part is added", count.n_inside_with_systematic);
  }
  if (count.n_not_resolved > 0) text += fmt::format("; {} were not resolved", count.n_not_resolved);
  text += fmt::format("; <i>E</i><sub>0</sub> is off by at most {:.2g} %.",
                      100.0 * count.largest_E0_error);
  page.add_paragraph(text);
  page.add_table(table, "What the emulated rig was made with beside what the fit found.");
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
  page.add_figure(
      *plot, "pillar",
      "The time-stepping solver (rings, some of its steps) on the exact answer (lines), "
      "relative to the first value, and below the relative error of every step; errors "
      "below 10⁻¹⁶ are drawn there.");
  page.add_table(table, "Agreement of the solver with the exact answer.");
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
  const auto fitted = specimen.fit ? fit_plot(*specimen.fit) : std::nullopt;
  const bool has_orders = specimen.fit && !specimen.fit->orders.empty();
  page.add_heading(2, estimates.anchor, estimates.label);
  for (const std::string& note : specimen.notes) page.add_paragraph(escaped_markup(note));
  if (!recorded && !fitted && !has_orders) {
    page.add_paragraph("Known from its material file only: no recorded data and no fit to show.");
    return;
  }
  if (recorded) page.add_figure(*recorded, "run", run_caption(*specimen.run, series));
  if (fitted) page.add_figure(*fitted, "fit", fit_caption(*specimen.fit));
  if (const auto profiles = specimen.fit ? profile_plot(*specimen.fit) : std::nullopt) {
    page.add_figure(
        *profiles, "profiles",
        "Profile likelihoods: rise of the residual sum of squares, over the variance of "
        "the noise, as one parameter is held and all others are fitted again. The "
        "dashed line, 3.84, ends the 95 % interval; a curve that is no parabola tells "
        "of an interval that is not symmetric." +
            std::string(specimen.run ? " The times held are those of specimen and frame "
                                       "in series."
                                     : ""));
  }
  if (has_orders) {
    page.add_table(
        orders_table(*specimen.fit),
        "Orders tried. AICc and BIC stand above their smallest value; cross-validation is "
        "the error of predicting left-out blocks over that of the noise.");
  }
}

}  // namespace viscard
