#pragma once

#include "io/flow/design/requirement_kinds.h"
#include "io/flow/optimise/design_space.h"

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace viscard {

// The quantities of one point. Logarithms, because limits and objectives are products of powers of lengths.
struct SolvedPoint {
  bool exists = false;  // every quantity is answered
  std::string why_not;  // the first that is not
  std::vector<double> log_value, relative_error;
};

// The quantities that a specification needs, from the solver; a point is solved once.
class SolvedValues {
 public:
  SolvedValues(const DesignSpec& spec, const DesignSpace& space);

  // Quantities with a limit, in the order of requirement_kinds(), then objectives without a limit.
  const std::vector<const RequirementKind*>& kinds() const { return kinds_; }
  // At several points, on all cores.
  std::vector<SolvedPoint> at(const std::vector<DesignPoint>& points);
  // Standard uncertainty of each log_value under the uncertainties of the scene, to first order with the
  // errors of its derivatives. Throws std::runtime_error if nothing is uncertain.
  std::vector<double> spread_at(const DesignPoint& point) const;
  // Quantities that were solved, without those to first order.
  std::size_t n_solved() const { return n_solved_; }

 private:
  // `solver` answers to first order if `is_nearby`.
  SolvedPoint solve(const Scene& scene, const SceneSolver& solver = simulate,
                    bool is_nearby = false) const;

  const DesignSpec& spec_;
  const DesignSpace& space_;
  std::vector<const RequirementKind*> kinds_;
  std::map<DesignPoint, SolvedPoint> known_;
  mutable std::atomic<std::size_t> n_solved_ = 0;
};

}  // namespace viscard
