#include "io/flow/optimise/design_front.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// Small is good.
double cost_of(const DesignSpec& spec, const OptimisedDesign& design, std::size_t which) {
  const double logarithm = std::log(std::max(std::abs(design.objectives[which].value), 1e-300));
  return spec.objectives[which].is_largest() ? -logarithm : logarithm;
}

// Drops designs that another one beats in one objective without loss in the other.
void keep_undominated(const DesignSpec& spec, std::vector<OptimisedDesign>& designs) {
  constexpr double kSame = 1e-4;
  std::vector<OptimisedDesign> kept;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const double a = cost_of(spec, designs[i], 0), b = cost_of(spec, designs[i], 1);
    bool is_beaten = false;
    for (std::size_t j = 0; j < designs.size(); ++j) {
      const double c = cost_of(spec, designs[j], 0), d = cost_of(spec, designs[j], 1);
      const bool is_better = c < a - kSame || d < b - kSame;
      const bool is_same = std::abs(c - a) <= kSame && std::abs(d - b) <= kSame;
      is_beaten = is_beaten ||
                  (i != j && c <= a + kSame && d <= b + kSame && (is_better || (is_same && j < i)));
    }
    if (!is_beaten) kept.push_back(designs[i]);
  }
  std::sort(kept.begin(), kept.end(), [&](const OptimisedDesign& a, const OptimisedDesign& b) {
    return cost_of(spec, a, 0) < cost_of(spec, b, 0);
  });
  designs = std::move(kept);
}

}  // namespace

DesignFront design_front(const DesignSpec& spec,
                         const std::function<void(double, const std::string&)>& progress) {
  DesignFront front;
  const bool is_front = spec.objectives.size() == 2;
  const double n = is_front ? static_cast<double>(spec.front_points) : 1.0;
  const auto add = [&](OptimiseOptions options) {
    const double done = static_cast<double>(front.designs.size());
    if (progress) {
      options.progress = [&, done](double part, const std::string& what) {
        progress((done + part) / n, what);
      };
    }
    front.designs.push_back(optimise_design(spec, options));
    front.n_solved += front.designs.back().n_solved;
  };
  add({});
  if (!is_front || !front.designs[0].is_feasible) return front;
  OptimiseOptions other;
  other.objective = 1;
  add(other);
  const double first = cost_of(spec, front.designs[0], 1),
               last = cost_of(spec, front.designs[1], 1);
  for (std::int64_t i = 1; i + 1 < spec.front_points; ++i) {
    OptimiseOptions between;
    between.second = ObjectiveBound{first + (last - first) * static_cast<double>(i) / (n - 1.0)};
    add(between);
    if (!front.designs.back().is_feasible) front.designs.pop_back();
  }
  keep_undominated(spec, front.designs);
  return front;
}

Plot picture_of_front(const DesignSpec& spec, const DesignFront& front) {
  PlotPanel panel;
  PlotSeries dots{.mark = Mark::kPoints, .label = "designs", .size = 1.5};
  PlotSeries line{.mark = Mark::kLine, .ink = Ink::kGrey};
  for (const OptimisedDesign& design : front.designs) {
    for (PlotSeries* const one : {&dots, &line}) {
      one->x.push_back(design.objectives[0].value);
      one->y.push_back(design.objectives[1].value);
    }
  }
  const auto label = [&](std::size_t which) {
    const DesignedObjective& one = front.designs[0].objectives[which];
    return one.quantity + (one.unit.empty() || one.unit == "1" ? "" : " (" + one.unit + ")") +
           ", " + spec.objectives[which].goal;
  };
  panel.x = {label(0), false};
  panel.y = {label(1), false};
  panel.series = {line, dots};
  Plot plot{
      .title = "Front between two objectives",
      .description = "Each dot is a design that the solver confirmed; none is better in both."};
  plot.panels.push_back(std::move(panel));
  plot.height_px = 460;
  return plot;
}

}  // namespace viscard
