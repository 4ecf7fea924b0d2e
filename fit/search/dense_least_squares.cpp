#include "fit/search/dense_least_squares.h"

#include <ceres/ceres.h>

namespace viscard {

SearchSummary solve_dense(ceres::Problem& problem, const SearchEnd& end) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = end.max_iterations;
  options.function_tolerance = end.function_tolerance;
  options.parameter_tolerance = end.parameter_tolerance;
  options.gradient_tolerance = end.gradient_tolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {.rss = 2.0 * summary.final_cost,
          .is_usable = summary.IsSolutionUsable(),
          .has_converged = summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace viscard
