#include "models/maths/dense.h"
#include "models/pillar/time/state_transition.h"
#include "models/pillar/time/transient_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

// Shorter periods than this share of the longest one are raised to it: such motions follow the load
// at once.
constexpr double kShortestPeriod = 1e-6;
// Shorter relaxation times than this share of the shortest period are raised to it: such a relaxation
// ends before anything moves.
constexpr double kShortestRelaxation = 1e-3;

// The modes a of the instantaneous stiffness, each scaled to the root of its energy, with their
// frequencies W, and b_i = a - d_i, the part of a that has relaxed in term i (eq. 16, 17):
//   a' = W v,  v' = W (-a + sum_i R_i b_i + f p),  b_i' = (a - b_i)/tau_i,
// R_i the share of the stiffness that term i relaxes, p the load. In these variables no motion
// grows, so that rounding stays rounding (Moler & Van Loan, SIAM Rev. 45 (2003) 3).
struct StateSpace {
  Eigen::MatrixXd rate_1_s;
  Eigen::MatrixXd seen;   // observers x modes
  Eigen::MatrixXd rates;  // of v: the rates of the observers
  double load_size = 0.0;
  Eigen::Index modes = 0;
};

StateSpace state_space_of(const ViscoelasticSystem& small, const TransientRequest& r,
                          const Eigen::MatrixXd& observers) {
  const Eigen::MatrixXd shear = dense(small.shear);
  const Eigen::MatrixXd bulk = dense(small.bulk);
  const Cholesky stiffness(dense(small.elastic) + shear + bulk);
  // L^-1 X L^-T of a symmetric X.
  const auto scaled = [&](const Eigen::MatrixXd& X) {
    return stiffness.solve_lower(Eigen::MatrixXd(stiffness.solve_lower(X).transpose()));
  };
  const EigenSystem modes = symmetric_eigen(scaled(dense(small.mass)));  // of 1/W^2
  const Eigen::MatrixXd& V = modes.vectors;
  const Eigen::Index n = V.rows();
  const double longest = std::sqrt(modes.values[n - 1]);
  const Eigen::VectorXd W =
      modes.values.cwiseMax(std::pow(kShortestPeriod * longest, 2)).cwiseSqrt().cwiseInverse();
  const auto relaxing = [&](const Eigen::MatrixXd& X) {
    return Eigen::MatrixXd(V.transpose() * scaled(X) * V);
  };
  const Eigen::MatrixXd of_shear = relaxing(shear);
  const Eigen::MatrixXd of_bulk = relaxing(bulk);
  std::vector<MaterialTerm> terms;
  for (const MaterialTerm& term : small.terms) {
    if (term.g != 0.0 || term.k != 0.0) terms.push_back(term);
  }
  const Eigen::VectorXd push = V.transpose() * stiffness.solve_lower(r.load);
  StateSpace space;
  space.modes = n;
  space.load_size = std::max(push.norm(), 1e-300);
  space.seen = stiffness.solve_lower(Eigen::MatrixXd(observers.transpose())).transpose() * V;
  space.rates = space.seen * W.asDiagonal();
  // After the modes and their relaxed parts, the load and its growth over one output interval.
  const Eigen::Index load = n * static_cast<Eigen::Index>(2 + terms.size());
  Eigen::MatrixXd& A = space.rate_1_s;
  A = Eigen::MatrixXd::Zero(load + 2, load + 2);
  A.block(0, n, n, n).diagonal() = W;
  A.block(n, 0, n, n).diagonal() = -W;
  A.col(load).segment(n, n) = W.cwiseProduct(push) / space.load_size;
  A(load, load + 1) = 1.0 / r.spacing_s();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Eigen::Index at = n * static_cast<Eigen::Index>(2 + i);
    const double rate_1_s =
        1.0 / std::max(terms[i].tau_s, kShortestRelaxation * kShortestPeriod * longest);
    A.block(n, at, n, n) = W.asDiagonal() * (terms[i].g * of_shear + terms[i].k * of_bulk);
    A.block(at, 0, n, n).diagonal().setConstant(rate_1_s);
    A.block(at, at, n, n).diagonal().setConstant(-rate_1_s);
  }
  return space;
}

}  // namespace

TransientResult run_exactly(const ViscoelasticSystem& small, const TransientRequest& r,
                            const Eigen::MatrixXd& observers) {
  const StateSpace space = state_space_of(small, r, observers);
  const std::vector<TransientPiece> pieces = pieces_of(r);
  const double spacing_s = r.spacing_s();
  const bool is_regular = std::all_of(pieces.begin(), pieces.end(), [&](const TransientPiece& p) {
    return p.length_s == spacing_s;
  });
  const StateTransition transition(space.rate_1_s, spacing_s, is_regular);
  TransientMotion motion = empty_motion(pieces, observers.rows());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(space.rate_1_s.rows());
  const Eigen::Index load = x.size() - 2;
  Eigen::Index end = 0;
  for (const TransientPiece& piece : pieces) {
    x[load] = space.load_size * piece.first;
    x[load + 1] = space.load_size * (piece.last - piece.first) * (spacing_s / piece.length_s);
    transition.advance(std::min(piece.length_s, spacing_s), x);
    motion.values.col(++end) = space.seen * x.head(space.modes);
    motion.rates.col(end) = space.rates * x.segment(space.modes, space.modes);
  }
  TransientResult result = result_of(r, pieces, std::move(motion));
  result.steps = static_cast<int>(pieces.size());
  result.converged = true;
  return result;
}

}  // namespace viscard
