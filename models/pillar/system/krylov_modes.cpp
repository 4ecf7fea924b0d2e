#include "models/pillar/system/krylov_modes.h"

#include "models/maths/dense.h"
#include "models/maths/failure_text.h"

#include <Spectra/SymEigsBase.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

using ConstMap = Eigen::Map<const Eigen::VectorXd>;
using Map = Eigen::Map<Eigen::VectorXd>;

// Rounding in a stiff system (a slender body, a stiff volume) can keep residuals above the
// tolerance. If an eigenvalue has a residual below this limit (so its own error is below the square
// of it) and does not change in a larger space, it is accepted.
constexpr double kSettledResidual = 1e-4;
constexpr double kSettledChange = 1e-11;

// The interfaces through which Spectra asks for y = B x and y = op x. It asks for B x twice in a row, for the norm of x and
// for its products with the vectors before, so that the last one is kept.
struct InnerProduct {
  using Scalar = double;
  const LinearMap& B;
  Eigen::Index size;
  mutable Eigen::VectorXd last = {}, image = {};  // x and B x
  Eigen::Index rows() const { return size; }
  void perform_op(const double* x, double* y) const {
    const ConstMap asked(x, size);
    if (last.size() != size || last != asked) {
      last = asked;
      image = B(last);
    }
    Map(y, size) = image;
  }
};

struct ScaledOperator {
  using Scalar = double;
  const PencilMap& op;
  const LinearMap& B;
  Eigen::Index size;
  double scale;
  Eigen::Index rows() const { return size; }
  // Spectra would iterate for ever on numbers that are not finite (a length by B that rounding makes negative).
  void perform_op(const double* in, double* out) const {
    const Eigen::VectorXd x = ConstMap(in, size);
    Map(out, size) = op(x, B(x)) / scale;
    if (!ConstMap(out, size).allFinite()) throw std::runtime_error("not finite");
  }
};

// Like SymGEigsShiftSolver, but it does not transform the eigenvalues, and it gives access to those
// that have not converged.
class Lanczos : public Spectra::SymEigsBase<ScaledOperator, InnerProduct> {
 public:
  Lanczos(const ScaledOperator& op, const InnerProduct& B, int count, int space)
      : SymEigsBase(ScaledOperator(op), B, count, space) {}
  Eigen::VectorXd rough_values() const { return m_ritz_val.head(m_nev); }
};

class LanczosSearch {
 public:
  LanczosSearch(const PencilMap& op, const LinearMap& B, int size) : op_(op), B_{B, size} {
    std::mt19937_64 random(1);  // a fixed seed, so that results are reproducible
    std::normal_distribution<double> normal;
    Eigen::VectorXd start(size);
    for (double& x : start) x = normal(random);
    const Eigen::VectorXd B_start = B(start);
    image_ = op(start, B_start);  // lies entirely in the range of op
    // Spectra's tolerance is relative only for values above 4e-11, so op is scaled to about 1.
    scale_ = std::abs(B_start.dot(image_)) / B_start.dot(start);
  }

  // Checks the residuals `checks` times, with a restart between checks.
  EigenPairs in_space(int space, int checks, int count, double tolerance) const {
    Lanczos lanczos({op_, B_.B, B_.size, scale_}, B_, count,
                    std::clamp(space, count + 1, static_cast<int>(B_.size)));
    try {
      lanczos.init(image_.data());
      lanczos.compute(Spectra::SortRule::LargestAlge, checks, tolerance,
                      Spectra::SortRule::LargestAlge);
    } catch (const std::exception& error) {
      if (is_passing(error)) throw;
      // A product that is not finite, or no inner product.
      return {Eigen::VectorXd::Zero(count), {}, false};
    }
    if (lanczos.info() != Spectra::CompInfo::Successful) {
      return leading_pairs(scale_ * lanczos.rough_values(), lanczos.eigenvectors(), tolerance);
    }
    return {scale_ * lanczos.eigenvalues(), lanczos.eigenvectors(), true, count};
  }

 private:
  // The converged part of a search that did not converge as a whole, judged by residuals: the last
  // restart may have changed the order.
  EigenPairs leading_pairs(Eigen::VectorXd values, const Eigen::MatrixXd& vectors,
                           double tolerance) const {
    EigenPairs pairs{std::move(values), {}, false};
    for (; pairs.leading < vectors.cols(); ++pairs.leading) {
      const Eigen::VectorXd v = vectors.col(pairs.leading);
      const double value = pairs.values[pairs.leading];
      const Eigen::VectorXd rest = op_(v, B_.B(v)) - value * v;
      if (!(std::sqrt(std::abs(rest.dot(B_.B(rest)))) <= tolerance * std::abs(value))) break;
    }
    pairs.vectors = vectors.leftCols(pairs.leading);
    return pairs;
  }

  const PencilMap& op_;
  InnerProduct B_;
  Eigen::VectorXd image_;
  double scale_ = 1.0;
};

// All eigenpairs of a small op, because the Lanczos method cannot find all of them. With B = R'R
// the matrix R op R^-1 is symmetric. Directions without mass (B = 0) have mu = 0 and no norm: their
// vector is 0.
EigenPairs all_eigenpairs(const PencilMap& op, const LinearMap& B, int size) {
  Eigen::MatrixXd b(size, size);
  Eigen::MatrixXd images(size, size);
  for (int i = 0; i < size; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(size, i);
    b.col(i) = B(unit);
    images.col(i) = op(unit, b.col(i));
  }
  const EigenSystem root = symmetric_eigen(b);
  const double smallest = 1e-14 * root.values.maxCoeff();
  const Eigen::Index none = (root.values.array() <= smallest).count();
  const Eigen::Index rank = size - none;
  const Eigen::VectorXd scale = root.values.tail(rank).cwiseSqrt();
  const Eigen::MatrixXd R_inverse =
      root.vectors.rightCols(rank) * scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd R = scale.asDiagonal() * root.vectors.rightCols(rank).transpose();
  const EigenSystem all = symmetric_eigen(R * images * R_inverse);

  EigenPairs pairs{Eigen::VectorXd::Zero(size), Eigen::MatrixXd::Zero(size, size), true, size};
  pairs.values.head(rank) = all.values.reverse();
  pairs.vectors.leftCols(rank) = (R_inverse * all.vectors).rowwise().reverse();
  return pairs;
}

}  // namespace

EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  if (count < 1 || count > size) {
    throw std::invalid_argument(std::to_string(count) + " modes asked of a system of " +
                                std::to_string(size) + " unknowns");
  }
  if (count == size) return all_eigenpairs(op, B, size);
  const LanczosSearch search(op, B, size);
  EigenPairs pairs = search.in_space(2 * count + 4, 6, count, options.tolerance);
  if (pairs.converged || options.is_quick) return pairs;
  const int largest = options.largest_space;
  // A space costs as many products as it has vectors, whether it needs them or not.
  for (const int space : {largest / 6, largest / 3, largest}) {
    pairs = search.in_space(space, 1, count, options.tolerance);
    if (pairs.converged) return pairs;
  }
  pairs = search.in_space(largest, 1, count, kSettledResidual);
  if (pairs.converged) {
    const EigenPairs before = search.in_space(largest - largest / 4, 1, count, kSettledResidual);
    pairs.converged = before.converged && ((pairs.values - before.values).array().abs() <=
                                           kSettledChange * pairs.values.array().abs())
                                              .all();
  }
  if (!pairs.converged) pairs.leading = 0;  // not certain
  return pairs;
}

}  // namespace viscard
