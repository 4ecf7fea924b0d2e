#include "io/flow/optimise/design_front.h"

#include "io/basics/parallel.h"
#include "io/flow/optimise/design_choices.h"
#include "models/maths/failure_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Small is good.
double cost_of(const DesignSpec& spec, const OptimisedDesign& design, std::size_t which) {
  const double logarithm = std::log(std::max(std::abs(design.objectives[which].value), 1e-300));
  return spec.objectives[which].is_largest() ? -logarithm : logarithm;
}

// Drops designs that another design beats in one objective without loss in the other. Differences
// of the size of the rounding of dimensions are ignored.
void keep_undominated(const DesignSpec& spec, std::vector<OptimisedDesign>& designs) {
  constexpr double kSame = 2e-3;
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

// Largest violation of a limit, as a logarithm; 0 if all limits are kept.
double lack_of(const OptimisedDesign& design) {
  constexpr double kNotAnswered = 100.0;
  double most = 0.0;
  for (const JudgedLine& line : design.judgement.lines) {
    most = std::max(
        most, line.found.is_answered && line.margin > 0.0 ? -std::log(line.margin) : kNotAnswered);
  }
  return most;
}

// The front of a specification without choices.
DesignFront front_of(const DesignSpec& spec,
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
  return front;
}

// One design of several: the best one for a single objective, or the one with the smallest
// violation.
OptimisedDesign best_of(const DesignSpec& spec, const std::vector<OptimisedDesign>& designs) {
  return *std::min_element(
      designs.begin(), designs.end(), [&](const OptimisedDesign& a, const OptimisedDesign& b) {
        if (a.is_feasible != b.is_feasible) return a.is_feasible;
        return a.is_feasible ? cost_of(spec, a, 0) < cost_of(spec, b, 0) : lack_of(a) < lack_of(b);
      });
}

}  // namespace

DesignFront design_front(const DesignSpec& spec,
                         const std::function<void(double, const std::string&)>& progress) {
  DesignFront all;
  const std::vector<DesignSpec> specs = chosen_specs(spec);
  const auto n = static_cast<double>(specs.size());
  const WrittenValues written = written_choices(spec);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const std::string chosen = text_of_chosen(specs[i].chosen, written);
    try {
      const DesignFront one = front_of(specs[i], [&](double part, const std::string& what) {
        if (progress) {
          progress((static_cast<double>(i) + part) / n,
                   chosen.empty() ? what : chosen + ": " + what);
        }
      });
      all.n_solved += one.n_solved;
      all.designs.insert(all.designs.end(), one.designs.begin(), one.designs.end());
    } catch (const std::runtime_error& error) {
      if (chosen.empty() || !is_refusal(error)) throw;
      throw std::runtime_error(std::string(error.what()) + " (with " + chosen + ")");
    }
  }
  const bool is_any = std::any_of(all.designs.begin(), all.designs.end(),
                                  [](const OptimisedDesign& one) { return one.is_feasible; });
  if (!is_any || spec.objectives.size() < 2) {
    all.designs = {best_of(spec, all.designs)};
    return all;
  }
  std::erase_if(all.designs, [](const OptimisedDesign& one) { return !one.is_feasible; });
  keep_undominated(spec, all.designs);
  return all;
}

Plot picture_of_front(const DesignSpec& spec, const DesignFront& front) {
  PlotPanel panel;
  PlotSeries line{.mark = Mark::kLine, .ink = Ink::kGrey};
  const WrittenValues written = written_choices(spec);
  std::map<StudyValues, PlotSeries> dots;  // by the values of the choices
  for (const OptimisedDesign& design : front.designs) {
    const auto first_range =
        design.values.begin() + static_cast<std::ptrdiff_t>(spec.choices.size());
    const StudyValues chosen(design.values.begin(), first_range);
    PlotSeries& own =
        dots.try_emplace(
                chosen,
                PlotSeries{.mark = Mark::kPoints,
                           .label = chosen.empty() ? "designs" : text_of_chosen(chosen, written),
                           .ink = ink_of_series(dots.size()),
                           .pattern = static_cast<int>(dots.size()),
                           .size = 1.5})
            .first->second;
    for (PlotSeries* const one : {&own, &line}) {
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
  panel.series = {line};
  for (auto& [chosen, own] : dots) panel.series.push_back(std::move(own));
  Plot plot{
      .title = "Front between two objectives",
      .description = "Each dot is a design that the solver confirmed; none is better in both."};
  plot.panels.push_back(std::move(panel));
  plot.height_px = 460;
  return plot;
}

}  // namespace viscard
