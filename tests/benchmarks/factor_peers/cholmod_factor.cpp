#include "tests/benchmarks/factor_peers/peer_choice.h"

#include <suitesparse/cholmod.h>

#include <stdexcept>

namespace viscard::peers {
namespace {

// CHOLMOD's settings and work space: one for each kind, kept as long as the process runs.
cholmod_common* started(int supernodal, int ordering) {
  auto* common = new cholmod_common;
  cholmod_start(common);
  common->supernodal = supernodal;
  common->nmethods = 1;
  common->method[0].ordering = ordering;
  common->print = 0;
  return common;
}

cholmod_common* simplicial_amd() {
  static cholmod_common* const common = started(CHOLMOD_SIMPLICIAL, CHOLMOD_AMD);
  return common;
}
cholmod_common* simplicial_metis() {
  static cholmod_common* const common = started(CHOLMOD_SIMPLICIAL, CHOLMOD_METIS);
  return common;
}
cholmod_common* supernodal_amd() {
  static cholmod_common* const common = started(CHOLMOD_SUPERNODAL, CHOLMOD_AMD);
  return common;
}
cholmod_common* automatic_amd() {
  static cholmod_common* const common = started(CHOLMOD_AUTO, CHOLMOD_AMD);
  return common;
}

// CHOLMOD's views of Eigen's memory; it does not write to them.
cholmod_sparse view(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<int*>(lower.outerIndexPtr());
  view.i = const_cast<int*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense view(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(matrix.rows());
  view.ncol = static_cast<std::size_t>(matrix.cols());
  view.nzmax = view.nrow * view.ncol;
  view.d = static_cast<std::size_t>(matrix.outerStride());
  view.x = const_cast<double*>(matrix.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

Eigen::Map<const Eigen::MatrixXd> map(const cholmod_dense& of) {
  return {static_cast<const double*>(of.x), static_cast<Eigen::Index>(of.nrow),
          static_cast<Eigen::Index>(of.ncol)};
}

class CholmodFactor : public Factor {
 public:
  explicit CholmodFactor(FactorKind kind) : kind_(kind) {
    common_ = kind == FactorKind::kCholmodMetis ? simplicial_metis() : simplicial_amd();
  }
  ~CholmodFactor() override {
    cholmod_free_factor(&L_, common_);
    cholmod_free_dense(&X_, common_);
    cholmod_free_dense(&Y_, common_);
    cholmod_free_dense(&E_, common_);
  }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  void analyse(const Sparse& lower) override {
    // A negative diagonal entry, that of an electric potential, makes the matrix indefinite.
    if ((lower.diagonal().array() > 0.0).all()) {
      if (kind_ == FactorKind::kCholmodSupernodal) common_ = supernodal_amd();
      if (kind_ == FactorKind::kCholmodAuto) common_ = automatic_amd();
    }
    cholmod_sparse A = view(lower);
    cholmod_free_factor(&L_, common_);
    L_ = cholmod_analyze(&A, common_);
    if (L_ == nullptr) throw std::runtime_error("CHOLMOD could not analyse the matrix");
  }

  bool factor(const Sparse& lower) override {
    cholmod_sparse A = view(lower);
    cholmod_factorize(&A, L_, common_);
    if (L_->minor < L_->n && L_->is_ll) {  // indefinite after all
      common_ = simplicial_amd();
      analyse_again(lower);
      cholmod_factorize(&A, L_, common_);
    }
    if (common_->status < CHOLMOD_OK || L_->minor < L_->n) return false;
    read_pivots();
    return pivots_.allFinite();
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override {
    cholmod_dense b = view(right_side);
    cholmod_solve2(CHOLMOD_A, L_, &b, nullptr, &X_, nullptr, &Y_, &E_, common_);
    return map(*X_).col(0);
  }

  Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const override {
    cholmod_dense b = view(right_sides);
    cholmod_dense* permuted = cholmod_solve(CHOLMOD_P, L_, &b, common_);
    cholmod_dense* x = cholmod_solve(CHOLMOD_L, L_, permuted, common_);
    Eigen::MatrixXd result = map(*x);
    if (L_->is_ll) result.array().colwise() *= pivots_.array().sqrt();  // unit diagonal of L
    cholmod_free_dense(&permuted, common_);
    cholmod_free_dense(&x, common_);
    return result;
  }

  const Eigen::VectorXd& pivots() const override { return pivots_; }
  Eigen::Index entries() const override {
    return static_cast<Eigen::Index>(L_->is_super ? L_->xsize : L_->nzmax);
  }

 private:
  void analyse_again(const Sparse& lower) {
    cholmod_sparse A = view(lower);
    cholmod_free_factor(&L_, common_);
    L_ = cholmod_analyze(&A, common_);
  }

  void read_pivots() {
    const auto* x = static_cast<const double*>(L_->x);
    const auto* p = static_cast<const int*>(L_->p);
    pivots_.resize(static_cast<Eigen::Index>(L_->n));
    if (!L_->is_super) {
      for (std::size_t j = 0; j < L_->n; ++j) pivots_[static_cast<Eigen::Index>(j)] = x[p[j]];
    } else {
      const auto* super = static_cast<const int*>(L_->super);
      const auto* pi = static_cast<const int*>(L_->pi);
      const auto* px = static_cast<const int*>(L_->px);
      for (std::size_t s = 0; s < L_->nsuper; ++s) {
        const int rows = pi[s + 1] - pi[s];
        for (int j = 0; j < super[s + 1] - super[s]; ++j) {
          pivots_[super[s] + j] = x[px[s] + j * rows + j];
        }
      }
    }
    if (L_->is_ll) pivots_ = pivots_.cwiseAbs2().eval();
  }

  FactorKind kind_;
  cholmod_common* common_;
  ::cholmod_factor* L_ = nullptr;
  mutable cholmod_dense *X_ = nullptr, *Y_ = nullptr, *E_ = nullptr;  // reused by solve()
  Eigen::VectorXd pivots_;
};

}  // namespace

std::unique_ptr<Factor> cholmod_factor(FactorKind kind) {
  return std::make_unique<CholmodFactor>(kind);
}

}  // namespace viscard::peers
