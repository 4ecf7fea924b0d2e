#pragma once

// Nonlinear least squares by Ceres with a dense QR factorisation, without output.

namespace ceres {
class Problem;
}

namespace viscard {

// When a search ends. Ceres' relative changes: of the sum of squares, of the parameters, and of the gradient.
struct SearchEnd {
  int max_iterations = 500;
  double function_tolerance = 1e-15;
  double parameter_tolerance = 1e-12;
  double gradient_tolerance = 1e-14;
};

struct SearchSummary {
  double rss = 0.0;            // sum of squared residuals at the end; unit of the residuals squared
  bool is_usable = false;      // the parameters may be used, converged or not
  bool has_converged = false;  // one of the tolerances was reached
};

// Minimises the sum of squares of `problem` from the values in its parameter blocks, which it replaces.
SearchSummary solve_dense(ceres::Problem& problem, const SearchEnd& end);

}  // namespace viscard
