#include "models/pillar/time/reduced_span.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

SymmetricSparse full_lower(const Eigen::MatrixXd& matrix) {
  SymmetricSparse sparse(matrix.rows(), matrix.cols());
  sparse.reserve(
      Eigen::VectorXi::Constant(static_cast<int>(matrix.cols()), static_cast<int>(matrix.rows())));
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Eigen::Index i = j; i < matrix.rows(); ++i) sparse.insert(i, j) = matrix(i, j);
  }
  sparse.makeCompressed();
  return sparse;
}

void append(Eigen::MatrixXd& matrix, const Eigen::VectorXd& column) {
  matrix.conservativeResize(Eigen::NoChange, matrix.cols() + 1);
  matrix.col(matrix.cols() - 1) = column;
}

// Extends basis' * image by one row and column.
void border(Eigen::MatrixXd& small, const Eigen::MatrixXd& basis, const Eigen::MatrixXd& image) {
  const Eigen::Index n = basis.cols();
  small.conservativeResize(n, n);
  small.col(n - 1) = basis.transpose() * image.col(n - 1);
  small.row(n - 1) = small.col(n - 1).transpose();
}

}  // namespace

ReducedSpan::ReducedSpan(const ViscoelasticSystem& body) : body_(body) {
  factor(1.0, 1.0, instantaneous_);
  for (Eigen::MatrixXd* m : {&basis_, &elastic_, &shear_, &bulk_, &mass_}) {
    m->resize(body.shear.rows(), 0);
  }
}

void ReducedSpan::factor(double shear, double bulk, StiffnessFactor& factored) const {
  if (body_.incompressible) factored.constrain(body_.bulk);
  factored.factor(stiffness_at(body_, shear, bulk));
}

Eigen::VectorXd ReducedSpan::projected(const Eigen::VectorXd& v) const {
  Eigen::VectorXd products = elastic_.transpose() * v;
  products += shear_.transpose() * v;
  products += bulk_.transpose() * v;
  return basis_ * products;
}

bool ReducedSpan::add(Eigen::VectorXd v) {
  if (count() == basis_.rows()) return false;
  const double before = energy_norm(v);
  // Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 6.9).
  for (int pass = 0; pass < 2; ++pass) {
    if (count() > 0) v -= projected(v);
  }
  const double after = energy_norm(v);
  if (!(after > 1e-9 * before) || !std::isfinite(after)) return false;
  v /= after;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(v.size());
  const Eigen::VectorXd elastic = times(body_.elastic, v);
  const Eigen::VectorXd shear = times(body_.shear, v);
  // An incompressible body's volume does not change.
  const Eigen::VectorXd bulk = body_.incompressible ? none : times(body_.bulk, v);
  // Rounding is orthogonal to the basis from one side only: what it adds has no energy of its own.
  constexpr double kMostOverlap = 1e-3;
  if (count() > 0) {
    const Eigen::VectorXd overlap = basis_.transpose() * (elastic + shear + bulk);
    if (!(overlap.cwiseAbs().maxCoeff() < kMostOverlap)) return false;
  }
  append(basis_, v);
  append(elastic_, elastic);
  append(shear_, shear);
  append(bulk_, bulk);
  append(mass_, has_mass() ? times(body_.mass, v) : none);
  border(small_elastic_, basis_, elastic_);
  border(small_shear_, basis_, shear_);
  border(small_bulk_, basis_, bulk_);
  border(small_mass_, basis_, mass_);
  return true;
}

Eigen::MatrixXcd ReducedSpan::restricted(std::complex<double> shear, std::complex<double> bulk,
                                         std::complex<double> omega2) const {
  Eigen::MatrixXcd sum(count(), count());
  sum.real() = small_elastic_ + shear.real() * small_shear_ + bulk.real() * small_bulk_ -
               omega2.real() * small_mass_;
  sum.imag() =
      shear.imag() * small_shear_ + bulk.imag() * small_bulk_ - omega2.imag() * small_mass_;
  return sum;
}

Eigen::VectorXcd ReducedSpan::image_of(std::complex<double> shear, std::complex<double> bulk,
                                       std::complex<double> omega2,
                                       const Eigen::VectorXcd& c) const {
  Eigen::MatrixXd parts(c.size(), 2);
  parts << c.real(), c.imag();
  const auto whole = [&](const Eigen::MatrixXd& matrix) -> Eigen::VectorXcd {
    const Eigen::MatrixXd product = matrix * parts;
    Eigen::VectorXcd sum(product.rows());
    sum.real() = product.col(0);
    sum.imag() = product.col(1);
    return sum;
  };
  Eigen::VectorXcd sum = shear * whole(shear_) + bulk * whole(bulk_) - omega2 * whole(mass_);
  return sum + whole(elastic_);
}

double ReducedSpan::dual_norm(const Eigen::VectorXd& residual) const {
  return std::sqrt(std::max(residual.dot(instantaneous_.solve(residual)), 0.0));
}

ReducedBody ReducedSpan::reduced() const {
  ReducedBody result;
  result.basis = basis_;
  result.system.terms = body_.terms;
  result.system.elastic = full_lower(small_elastic_);
  result.system.shear = full_lower(small_shear_);
  result.system.bulk = full_lower(small_bulk_);
  if (has_mass()) result.system.mass = full_lower(small_mass_);
  if (body_.load.size() > 0) result.system.load = basis_.transpose() * body_.load;
  return result;
}

double ReducedSpan::energy_norm(const Eigen::VectorXd& v) const {
  Eigen::VectorXd force = times(body_.elastic, v) + times(body_.shear, v);
  if (!body_.incompressible) force += times(body_.bulk, v);
  return std::sqrt(std::max(v.dot(force), 0.0));
}

}  // namespace viscard
