#include "models/maths/require.h"
#include "models/pillar/time/inertial_stepper.h"
#include "models/pillar/time/modal_response.h"
#include "models/pillar/time/transient_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// The exponential takes about 50 states^3 operations: a minute for this many.
constexpr Eigen::Index kMostStates = 2000;

TransientMotion run_once(const ViscoelasticSystem& small, const TransientRequest& r,
                         const std::vector<TransientPiece>& pieces,
                         const Eigen::MatrixXd& observers, int refinement, int& steps) {
  InertialStepper stepper(small);
  TransientMotion motion = empty_motion(pieces, observers.rows());
  Eigen::Index end = 0;
  for (const TransientPiece& piece : pieces) {
    const int n =
        refinement * std::max(1, static_cast<int>(std::ceil(piece.length_s / r.first_step_s)));
    stepper.set_step(piece.length_s / n);
    for (int i = 0; i < n; ++i) {
      const double a = piece.first + (piece.last - piece.first) * i / n;
      const double b = piece.first + (piece.last - piece.first) * (i + 1) / n;
      stepper.advance(a * r.load, b * r.load);
    }
    steps += n;
    motion.values.col(++end) = observers * stepper.displacement();
    motion.rates.col(end) = observers * stepper.velocity();
  }
  return motion;
}

double largest_change(const Eigen::MatrixXd& now, const Eigen::MatrixXd& before) {
  double largest = 0.0;
  for (Eigen::Index row = 0; row < now.rows(); ++row) {
    const double size = now.row(row).cwiseAbs().maxCoeff();
    if (size == 0.0) continue;
    largest = std::max(largest, (now.row(row) - before.row(row)).cwiseAbs().maxCoeff() / size);
  }
  return largest;
}

}  // namespace

TransientResult run_transient(const ViscoelasticSystem& small, const TransientRequest& r,
                              const Eigen::MatrixXd& observers) {
  require(r.end_s > 0.0 && r.outputs >= 2 && r.first_step_s > 0.0,
          "a transient needs a positive end and first step, and at least two outputs");
  require(!r.history.empty() && std::is_sorted(r.history.begin(), r.history.end(),
                                               [](const CoursePoint& a, const CoursePoint& b) {
                                                 return a.time_s < b.time_s;
                                               }),
          "a transient load needs a history whose times do not go back");
  if (small.rigid.cols() > 0) return run_floating(small, r, observers);
  if (relaxes_alike(small)) return run_by_modes(small, r, observers);
  const auto states = small.mass.rows() * static_cast<Eigen::Index>(2 + small.terms.size());
  return states <= kMostStates ? run_exactly(small, r, observers)
                               : run_by_steps(small, r, observers);
}

TransientResult run_by_steps(const ViscoelasticSystem& small, const TransientRequest& r,
                             const Eigen::MatrixXd& observers) {
  const std::vector<TransientPiece> pieces = pieces_of(r);
  TransientMotion last, better = empty_motion(pieces, observers.rows());
  double error_estimate = 0.0;
  bool converged = false;
  int steps = 0;
  int refinement = 1;
  for (int level = 0; !converged; ++level, refinement *= 2) {
    TransientMotion run = run_once(small, r, pieces, observers, refinement, steps);
    if (level > 0) {
      const Eigen::MatrixXd values = (4.0 * run.values - last.values) / 3.0;
      if (level > 1) {
        error_estimate = largest_change(values, better.values);
        converged = error_estimate <= r.tolerance;
      }
      better = run;
      better.values = values;
      better.rates = (4.0 * run.rates - last.rates) / 3.0;
    }
    last = std::move(run);
    if (!converged && 3 * steps > r.most_steps) break;
  }
  TransientResult result = result_of(r, pieces, std::move(better));
  result.error_estimate = error_estimate;
  result.converged = converged;
  result.steps = steps;
  return result;
}

}  // namespace viscard
