#include "fit/laws/fit_mixing_ratio.h"
#include "io/basics/atomic_file.h"
#include "io/cli/fit/fit_command.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/progress.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/fit_file.h"
#include "io/flow/words/fit_text.h"
#include "io/materials/material_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

namespace viscard {
namespace {

// The table of records; repeats show their touch.
void print_records(const RatioFit& fit, std::ostream& out) {
  const auto n_specimens = static_cast<std::size_t>(fit.law.n_specimens);
  const bool has_repeats = fit.specimens.size() > n_specimens;
  if (has_repeats) out << counted(fit.specimens.size(), "record") << " of ";
  out << fmt::format("{} at {}\n\n", counted(n_specimens, "specimen"),
                     counted(fit.law.ratios.size(), "mixing ratio"));
  out << fmt::format("{:<24} {:>7} {}{:>12} {:>10}\n", "specimen", "ratio",
                     has_repeats ? "touch " : "", "E0 (Pa)", "own error");
  for (const RatioSpecimen& one : fit.specimens) {
    out << fmt::format("{:<24} {:>7.4g} {}{:>12.6g} {:>8.2g} %\n", one.name, one.mixing_ratio,
                       has_repeats ? fmt::format("{:>5} ", one.touch) : "", one.E0_Pa,
                       100.0 * one.ln_E0_se);
  }
}

// Standard deviations at three levels: E0 in per cent of itself, the share that relaxes in per cent
// of E0.
void print_scatter(const RatioFit& fit, std::ostream& out) {
  for (const Scatter& scatter : fit.scatter) {
    const bool is_modulus = scatter.quantity == "ln_E0";
    out << fmt::format(
        "\nscatter of {}; error of one fit {:.2g} %\n",
        is_modulus ? "E0" : fmt::format("sum g, of {:.3g} % on average", 100.0 * scatter.mean),
        100.0 * scatter.own_error);
    for (const auto& [name, level] : {std::pair{"touch, on one specimen", &scatter.touch},
                                      std::pair{"specimen, of one ratio", &scatter.specimen},
                                      std::pair{"ratio, about the law", &scatter.ratio}}) {
      out << fmt::format("  {:<24}", name);
      if (!is_identified(*level)) {
        out << fmt::format("not identified: {}\n", level->note);
        continue;
      }
      out << fmt::format("{:>8.2g} %  95 % {:.2g} to {:.2g} %  ({}){}\n", 100.0 * level->deviation,
                         100.0 * level->interval_95.low, 100.0 * level->interval_95.high,
                         fmt::format("{} d.f.", level->degrees_of_freedom),
                         level->note.empty() ? "" : "; " + level->note);
    }
  }
}

void print(const RatioFit& fit, std::ostream& out) {
  print_records(fit, out);
  out << fmt::format("\n{:>9} {:>5}  form\n", "BIC", "par.");
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, fit.forms.size()); ++i) {
    const RatioComparison& row = fit.forms[i];
    out << fmt::format("{:>9.2f} {:>5}  {}: {}\n", row.bic - fit.forms.front().bic,
                       row.n_parameters, form_name(row.form), form_in_words(row.form));
  }
  out << "\n" << law_in_words(fit) << "\n";
  const auto scatter = [&](double spread, int parameter) {
    return has_known_spread(fit.law, parameter) ? fmt::format("{:.2g} %", 100.0 * spread)
                                                : std::string("unknown");
  };
  out << "between specimens: E0 " << scatter(fit.law.spread_ln_E0, 0);
  if (fit.law.n_terms > 0) {
    out << ", g " << scatter(fit.law.spread_ln_g, 1) << ", tau "
        << scatter(fit.law.spread_ln_tau, fit.law.n_terms + 1);
  }
  out << " (standard deviations about the law)\n";
  print_scatter(fit, out);
  out << "\n";
  for (const double ratio : fit.best.ratios) {
    const Material at = material_at_ratio(fit, ratio);
    out << fmt::format(
        "ratio {:>6.4g}: E0 {:.5g} Pa, {} 95 % {:.5g} to {:.5g}\n", ratio, at.E0_Pa,
        has_known_spread(fit.best, 0) ? "a new specimen" : "the one specimen (scatter unknown)",
        at.uncertainty->E0_Pa_95.low, at.uncertainty->E0_Pa_95.high);
  }
  print_flags(fit.flags, out);
}

}  // namespace

int run_joint_fit(JointRequest request, const FitOutput& output, Streams& streams) {
  const WordsOnSignal words_on_signal("the joint fit was stopped, and nothing is written");
  Progress progress(streams, "fit");
  request.progress = [&](double done, const std::string& file) { progress.show(done, file); };
  request.note = [&](const std::string& text) { streams.err << "viscard: " << text << "\n"; };
  const RatioFit fit = fit_jointly(request);
  progress.clear();
  if (!output.json) print(fit, FittedText(streams));
  if (!output.file.empty()) write_file(output.file, json_from_ratio_fit(fit), output.overwrite);
  if (output.json) {
    print_result(
        {"viscard-joint/1", request.files}, [&](ResultVisitor& v) { show_keys(v, fit); }, streams);
  }
  return kDone;
}

}  // namespace viscard
