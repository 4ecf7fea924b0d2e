#include "io/flow/optimise/step_on_model.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace viscard {
namespace {

constexpr double kPenalty =
    100.0;  // objective per lack: no gain of 100 in the logarithm buys a limit

double merit_of(unsigned n, const double* x, double*, void* data) {
  const auto& score = *static_cast<const ScoreAt*>(data);
  const DesignScore at = score(DesignPoint(x, x + n - 1));
  return at.objective + kPenalty * x[n - 1];
}

// NLopt keeps values <= 0.
void lacks_of(unsigned m, double* result, unsigned n, const double* x, double*, void* data) {
  const auto& score = *static_cast<const ScoreAt*>(data);
  const DesignScore at = score(DesignPoint(x, x + n - 1));
  for (unsigned i = 0; i < m; ++i) result[i] = -at.margins[i] - x[n - 1];
}

double objective_of(unsigned n, const double* x, double*, void* data) {
  return (*static_cast<const ScoreAt*>(data))(DesignPoint(x, x + n)).objective;
}

void limits_of(unsigned m, double* result, unsigned n, const double* x, double*, void* data) {
  const DesignScore at = (*static_cast<const ScoreAt*>(data))(DesignPoint(x, x + n));
  for (unsigned i = 0; i < m; ++i) result[i] = -at.margins[i];
}

// A score is computed once for objective and margins at a point.
ScoreAt remembering(const ScoreAt& score) {
  return [&score, last = DesignPoint{}, kept = DesignScore{}](const DesignPoint& at) mutable {
    if (at != last) {
      kept = score(at);
      last = at;
    }
    return kept;
  };
}

void run(nlopt::opt& optimiser, std::vector<double>& x) {
  double least = 0.0;
  try {
    optimiser.optimize(x, least);
  } catch (const nlopt::roundoff_limited&) {  // no better value is possible
  }
}

}  // namespace

double DesignScore::lack() const {
  double most = 0.0;
  for (const double margin : margins) most = std::max(most, -margin);
  return most;
}

double DesignScore::merit() const {
  return objective + kPenalty * lack();
}

DesignPoint step_on_model(const ScoreAt& score, const DesignPoint& centre, double radius) {
  constexpr int kMost = 600;
  ScoreAt once = remembering(score);
  const std::size_t n = centre.size();
  const DesignScore here = score(centre);
  nlopt::opt optimiser(nlopt::LN_COBYLA, static_cast<unsigned>(n + 1));
  std::vector<double> low, high, x;
  for (const double share : centre) {
    low.push_back(std::max(0.0, share - radius));
    high.push_back(std::min(1.0, share + radius));
    x.push_back(std::clamp(share, low.back(), high.back()));
  }
  const double lack = here.lack();
  low.push_back(0.0);
  high.push_back(lack + 10.0);
  x.push_back(lack);
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_min_objective(merit_of, &once);
  optimiser.add_inequality_mconstraint(lacks_of, &once,
                                       std::vector<double>(here.margins.size(), 1e-6));
  std::vector<double> first_step(n + 1, 0.4 * radius);
  first_step.back() = std::max(0.05, 0.5 * lack);
  optimiser.set_initial_step(first_step);
  optimiser.set_xtol_abs(1e-5);
  optimiser.set_maxeval(kMost);
  run(optimiser, x);
  x.pop_back();
  return score(x).merit() < here.merit() ? x : centre;
}

DesignPoint search_ranges(const ScoreAt& score, std::size_t n_ranges, std::size_t n_margins,
                          std::uint64_t seed) {
  static std::mutex one_at_a_time;  // the generator of NLopt is one for the program
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  nlopt::srand(static_cast<unsigned long>(seed));
  ScoreAt once = remembering(score);
  nlopt::opt optimiser(nlopt::GN_ISRES, static_cast<unsigned>(n_ranges));
  optimiser.set_lower_bounds(std::vector<double>(n_ranges, 0.0));
  optimiser.set_upper_bounds(std::vector<double>(n_ranges, 1.0));
  optimiser.set_min_objective(objective_of, &once);
  optimiser.add_inequality_mconstraint(limits_of, &once, std::vector<double>(n_margins, 1e-6));
  optimiser.set_maxeval(static_cast<int>(300 * (n_ranges + 1)));
  std::vector<double> x(n_ranges, 0.5);
  run(optimiser, x);
  return x;
}

}  // namespace viscard
