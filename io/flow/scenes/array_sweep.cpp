#include "io/flow/scenes/array_sweep.h"

#include "io/basics/inputs.h"
#include "io/flow/scenes/wanted_results.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// The answer of a sweep holds the estimate of each effect at the point where leaving it out costs
// most.
void keep_largest(const std::vector<SceneEffect>& point, std::vector<SceneEffect>& sum) {
  if (sum.empty()) sum = point;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (point[i].estimate > sum[i].estimate) sum[i] = point[i];
  }
}

// The deviation at one spacing, against the limit.
struct Deviation {
  double spacing_m = 0.0;
  double percent = 0.0, error = 0.0;
};

// Spacings of a table against a limit that their deviations fall below.
class SpacingLimit {
 public:
  SpacingLimit(std::vector<Deviation> all, double limit_percent)
      : all_(std::move(all)), limit_percent_(limit_percent) {}

  // Adds the first spacing below the limit and, where a larger one lies above it again, the one from
  // which on all lie below.
  void add_to(SceneAnswer& answer, const std::string& at) const {
    const auto first = static_cast<std::size_t>(
        std::find_if(all_.begin(), all_.end(), [&](const Deviation& d) { return is_below(d); }) -
        all_.begin());
    if (first == all_.size()) return;
    answer.results.push_back(
        {"first_spacing" + at, all_[first].spacing_m, "m", uncertainty_m(first)});
    std::size_t settled = all_.size();
    while (settled > first && is_below(all_[settled - 1])) --settled;
    if (settled == first) return;
    const Deviation& again = all_[settled - 1];
    std::string note = fmt::format(
        "the deviation{} is below {:g} % at {:.4g} um only because it changes sign there; it is "
        "{:.2g} % at {:.4g} um",
        at, limit_percent_, 1e6 * all_[first].spacing_m, again.percent, 1e6 * again.spacing_m);
    if (settled == all_.size()) {
      note += ", and no spacing of the sweep is known to be wide enough";
    } else {
      note += fmt::format(", and stays below from {:.4g} um on", 1e6 * all_[settled].spacing_m);
      answer.results.push_back(
          {"settled_spacing" + at, all_[settled].spacing_m, "m", uncertainty_m(settled)});
    }
    answer.notes.push_back(note);
  }

 private:
  bool is_below(const Deviation& d) const { return std::abs(d.percent) < limit_percent_; }
  // Down to the next smaller spacing that lies above the limit with any error within the estimates,
  // because the limit is crossed between; up to the next larger one that lies below it likewise.
  double uncertainty_m(std::size_t i) const {
    const auto is_sure = [&](const Deviation& d) {
      return std::abs(std::abs(d.percent) - limit_percent_) > d.error;
    };
    std::size_t low = i, high = i;
    while (low > 0 && !(is_sure(all_[low - 1]) && !is_below(all_[low - 1]))) --low;
    while (high + 1 < all_.size() && !(is_sure(all_[high]) && is_below(all_[high]))) ++high;
    const double lower_m = low > 0 ? all_[low - 1].spacing_m : 0.0;
    return std::max(all_[i].spacing_m - lower_m, all_[high].spacing_m - all_[i].spacing_m);
  }

  std::vector<Deviation> all_;
  double limit_percent_;
};

}  // namespace

SceneAnswer solve_sweep(const SceneFile& file, std::map<std::size_t, SweepRow>& rows,
                        const SweepListener& listener) {
  const auto& scene = std::get<ArrayScene>(file.scene);
  const std::vector<SweepPoint> points = points_of(scene, file.sweep);
  std::vector<Scene> left;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (rows.count(i) > 0) continue;
    left.push_back(points[i].scene);
    number.push_back(i);
  }
  simulate_all(left, [&](std::size_t i, const SceneAnswer& answer) {
    SceneAnswer kept = answer;
    keep_wanted(scene.wanted, kept);
    const SweepRow row{std::move(kept.results), answer.unknowns, answer.discretisation.degree,
                       answer.discretisation.layers};
    if (listener.keep) listener.keep(number[i], row);
    rows[number[i]] = row;
    const double done = static_cast<double>(rows.size());
    if (listener.progress)
      listener.progress(done / static_cast<double>(points.size()), points[number[i]].label);
  });
  SceneAnswer sum = joined(file.sweep, points, rows);
  for (std::size_t i = 0; i < points.size(); ++i) {
    keep_largest(plan_effects(points[i].scene).effects, sum.effects);
    const SweepRow& row = rows.at(i);
    if (row.unknowns <= sum.unknowns) continue;
    sum.unknowns = row.unknowns;
    sum.discretisation.degree = row.degree;
    sum.discretisation.layers = row.layers;
  }
  return sum;
}

SceneAnswer joined(const ArraySweep& sweep, const std::vector<SweepPoint>& points,
                   const std::map<std::size_t, SweepRow>& rows) {
  SceneAnswer answer;
  const std::size_t per_line = std::max<std::size_t>(1, sweep.spacing_m.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (SceneResult r : rows.at(i).results) {
      r.name += " at " + points[i].label;
      answer.results.push_back(std::move(r));
    }
  }
  if (!(sweep.limit_percent > 0.0)) return answer;
  for (std::size_t line = 0; line < points.size(); line += per_line) {
    std::vector<Deviation> all;
    for (std::size_t i = line; i < line + per_line; ++i) {
      for (const SceneResult& r : rows.at(i).results) {
        if (!r.name.starts_with("deviation_percent")) continue;
        all.push_back({points[i].scene.geometry.spacing_m, r.value, r.error_estimate});
        break;
      }
    }
    const std::string& label = points[line].label;
    const std::size_t end = label.rfind(", spacing");
    SpacingLimit(all, sweep.limit_percent)
        .add_to(answer, end == std::string::npos ? "" : " at " + label.substr(0, end));
  }
  return answer;
}

std::string csv_from_sweep(const std::vector<SweepPoint>& points,
                           const std::map<std::size_t, SweepRow>& rows,
                           const std::string& command) {
  std::string text = head_of_table(command);
  text += "diameter_m,spacing_m,thickness_m";
  const auto unit = [](const std::string& u) { return u == "%" ? std::string() : "_" + u; };
  for (const SceneResult& r : rows.begin()->second.results) {
    text += fmt::format(",{}{},{}_error", r.name, unit(r.unit), r.name);
  }
  for (const auto& [i, row] : rows) {
    const ArrayGeometry& g = points[i].scene.geometry;
    text += fmt::format("\n{:.9g},{:.9g},{:.9g}", g.diameter_m, g.spacing_m, g.film_thickness_m);
    for (const SceneResult& r : row.results)
      text += fmt::format(",{:.9g},{:.3g}", r.value, r.error_estimate);
  }
  return text + "\n";
}

}  // namespace viscard
