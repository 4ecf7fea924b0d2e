// largest_eigenpairs() of models/pillar/krylov_modes.h by the search chosen at run time: ours under
// another name, or Spectra's Lanczos method with implicit restarts.
#define largest_eigenpairs our_largest_eigenpairs
#include VISCARD_OUR_MODES_SOURCE
#undef largest_eigenpairs

#include "tests/benchmarks/factor_peers/peer_choice.h"

#include <Spectra/SymEigsBase.h>

#include <algorithm>

namespace viscard {

// As krylov_modes.h declares them for the solver.
EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options);
EigenPairs largest_eigenpairs(const LinearMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options);

namespace {

using MapIn = Eigen::Map<const Eigen::VectorXd>;
using MapOut = Eigen::Map<Eigen::VectorXd>;

struct SpectraProduct {
  using Scalar = double;
  const LinearMap* B;
  Eigen::Index size;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const { MapOut(y, size) = (*B)(MapIn(x, size)); }
};

struct SpectraOperator {
  using Scalar = double;
  const PencilMap* op;
  const LinearMap* B;
  Eigen::Index size;
  double scale;
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* in, double* out) const {
    const Eigen::VectorXd x = MapIn(in, size);
    MapOut(out, size) = (*op)(x, (*B)(x)) / scale;
  }
};

// As SymGEigsShiftSolver in its mode of shift and inversion, but the values stay those of the
// operator.
class SpectraSearch : public Spectra::SymEigsBase<SpectraOperator, SpectraProduct> {
 public:
  SpectraSearch(SpectraOperator op, SpectraProduct& B, Eigen::Index count, Eigen::Index space)
      : SymEigsBase(std::move(op), B, count, space) {}
};

// Twice the modes and four vectors between restarts: of the settings tried (twice and three times
// the modes and up to twelve more, 20, 30) this one needs the least time.
EigenPairs spectra_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  if (count >= size) return our_largest_eigenpairs(op, B, size, count, options);
  SpectraProduct product{&B, size};
  const int space = std::min(size, 2 * count + 4);
  // Spectra's tolerance is relative for values above 4e-11 only, so the operator is scaled to 1.
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd start(size);
  for (double& x : start) x = normal(random);
  const Eigen::VectorXd B_start = B(start);
  const Eigen::VectorXd image = op(start, B_start);
  const double scale = std::abs(image.dot(B_start)) / start.dot(B_start);
  SpectraSearch search({&op, &B, size, scale}, product, count, space);
  search.init(image.data());
  search.compute(Spectra::SortRule::LargestAlge, 100, options.tolerance,
                 Spectra::SortRule::LargestAlge);
  EigenPairs pairs;
  pairs.values = scale * search.eigenvalues();
  pairs.vectors = search.eigenvectors();
  pairs.converged = search.info() == Spectra::CompInfo::Successful;
  if (pairs.converged) pairs.residual = options.tolerance;
  return pairs;
}

}  // namespace

EigenPairs largest_eigenpairs(const PencilMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  const double start_s = peers::cpu_s();
  EigenPairs pairs = peers::choice().search == peers::SearchKind::kOurs
                         ? our_largest_eigenpairs(op, B, size, count, options)
                         : spectra_eigenpairs(op, B, size, count, options);
  peers::spent().modes += peers::cpu_s() - start_s;
  return pairs;
}

EigenPairs largest_eigenpairs(const LinearMap& op, const LinearMap& B, int size, int count,
                              const KrylovOptions& options) {
  const PencilMap of_both = [&op](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    return op(x);
  };
  return largest_eigenpairs(of_both, B, size, count, options);
}

}  // namespace viscard
