#include "io/cli/scene/uncertainty_output.h"

#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/pictures/picture_numbers.h"
#include "io/pictures/share_picture.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace viscard {
namespace {

std::string interval_words(const ResultUncertainty& result) {
  if (!result.no_interval.empty()) return "no interval";
  return fmt::format("{} to {} {}", text_of(result.interval_95.low, 4),
                     text_of(result.interval_95.high, 4), result.unit == "1" ? "" : result.unit);
}

// Which way derivatives were taken.
std::string derivative_words(const SceneUncertainty& all) {
  std::string by_differences;
  std::size_t by_solver = 0;
  for (std::size_t i = 0; i < all.inputs.size(); ++i) {
    if (all.by_solver[i]) {
      ++by_solver;
    } else {
      by_differences += (by_differences.empty() ? "" : ", ") + all.inputs[i].name;
    }
  }
  if (by_solver == 0) return "derivatives: differences of whole answers";
  return "derivatives: from one solution of the solver" +
         (by_differences.empty() ? "" : "; differences of whole answers for " + by_differences);
}

std::string csv_of(const SceneUncertainty& uncertainty, const std::string& command) {
  std::string text = fmt::format(
      "{}result,unit,value,low_95,high_95,standard_uncertainty,numerical_error,"
      "input,share,share_with_others,share_standard_error\n",
      head_of_table(command));
  for (const ResultUncertainty& r : uncertainty.results) {
    for (std::size_t i = 0; i < r.causes.size(); ++i) {
      const CauseShare& cause = r.causes[i];
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.6g},{:.3g},{},{:.5f},{:.5f},{:.2g}\n",
                          r.name, r.unit, r.value, r.interval_95.low, r.interval_95.high,
                          r.standard_uncertainty, r.numerical_error, uncertainty.inputs[i].name,
                          cause.share, cause.with_others, cause.standard_error);
    }
  }
  return text;
}

std::string picture_of(const SceneUncertainty& uncertainty) {
  std::vector<std::string> parts;
  for (const UncertainInput& input : uncertainty.inputs) parts.push_back(input.name);
  std::vector<ShareBar> bars;
  bool has_rest = false;
  for (const ResultUncertainty& result : uncertainty.results) {
    if (!(result.standard_uncertainty > 0.0)) continue;
    ShareBar bar{result.name,
                 result.no_interval.empty() ? interval_in_unit(result.interval_95.low,
                                                               result.interval_95.high, result.unit)
                                            : "no interval",
                 {}};
    for (const CauseShare& cause : result.causes) bar.shares.push_back(cause.share);
    has_rest = has_rest || share_jointly(result) > 0.005;
    bars.push_back(std::move(bar));
  }
  return svg_from_shares(parts, has_rest ? "several inputs together" : "", bars,
                         "Share of each input in the variance (95 % intervals beside)");
}

void print_result(const ResultUncertainty& result, const SceneUncertainty& all, std::ostream& out) {
  constexpr double kSmallest = 0.005;  // of the shares that are printed
  out << fmt::format("  {:<28} {}, standard uncertainty {}, numerical error {:.1e}\n", result.name,
                     interval_words(result), text_of(result.standard_uncertainty, 3),
                     result.numerical_error);
  if (!result.no_interval.empty()) out << "    no interval: " << result.no_interval << "\n";
  std::vector<std::size_t> order(result.causes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.causes[a].share > result.causes[b].share;
  });
  for (const std::size_t i : order) {
    if (result.causes[i].share < kSmallest) continue;
    out << fmt::format("    {:>5.1f} %  {}  ({})\n", 100.0 * result.causes[i].share,
                       all.inputs[i].name, all.descriptions[i]);
  }
  if (share_jointly(result) < kSmallest) return;
  out << fmt::format("    {:>5.1f} %  several inputs together\n", 100.0 * share_jointly(result));
}

}  // namespace

void print_uncertainty(const SceneUncertainty& uncertainty, std::ostream& out) {
  out << fmt::format("\nuncertainty: 95 % intervals from {} ({}), {}\n",
                     counted(uncertainty.inputs.size(), "input"),
                     uncertainty.is_sampled ? "Sobol' sequence" : uncertainty.method(),
                     counted(uncertainty.n_answers, "answer"));
  for (const ResultUncertainty& result : uncertainty.results) {
    print_result(result, uncertainty, out);
  }
  out << "  " << derivative_words(uncertainty) << "\n";
  out << "  " << uncertainty.reason << "\n";
  if (uncertainty.is_sampled) {
    out << fmt::format(
        "  sampled with degree {}, {} at the rim; deviations there differ by {:.1e} of the "
        "standard "
        "uncertainty\n",
        uncertainty.mesh.degree,
        counted(static_cast<std::size_t>(uncertainty.mesh.layers), "layer"),
        uncertainty.mesh_error);
  }
  for (const std::string& note : uncertainty.notes) out << "  note: " << note << "\n";
}

void write_uncertainty(const SceneUncertainty& uncertainty, const std::string& folder,
                       const std::string& command, bool overwrite) {
  const std::filesystem::path in = folder;
  write_file(in / "uncertainty.csv", csv_of(uncertainty, command), overwrite);
  write_file(in / "uncertainty.svg", picture_of(uncertainty), overwrite);
}

}  // namespace viscard
