#include "models/pillar/time/reduced_span.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

void add_column(Eigen::MatrixXd& matrix, const Eigen::VectorXd& column) {
  matrix.conservativeResize(Eigen::NoChange, matrix.cols() + 1);
  matrix.col(matrix.cols() - 1) = column;
}

// Extends basis' * image by one row and column, which the leading `uncoupled` vectors do not meet.
void border(Eigen::MatrixXd& small, const Eigen::MatrixXd& basis, const Eigen::MatrixXd& image,
            Eigen::Index uncoupled) {
  const Eigen::Index n = basis.cols();
  small.conservativeResize(n, n);
  if (image.col(n - 1).isZero(0.0)) {
    small.col(n - 1).setZero();
  } else {
    small.col(n - 1) = basis.transpose() * image.col(n - 1);
  }
  small.col(n - 1).head(uncoupled).setZero();
  small.row(n - 1) = small.col(n - 1).transpose();
}

}  // namespace

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

ReducedSpan::ReducedSpan(const ViscoelasticSystem& body)
    : body_(body),
      has_elastic_(body.elastic.coeffs().cwiseAbs().sum() > 0.0),
      shift_1_s2_(body.rigid.cols() > 0 ? body.free_shift_1_s2 : 0.0) {
  factor(1.0, 1.0, instantaneous_);
  for (Eigen::MatrixXd* m : {&basis_, &elastic_, &shear_, &bulk_, &mass_, &force_}) {
    m->resize(body.shear.rows(), 0);
  }
  add_rigid_motions();
}

void ReducedSpan::factor(double shear, double bulk, StiffnessFactor& factored) const {
  if (body_.incompressible) factored.constrain(body_.bulk);
  SymmetricSparse stiffness = stiffness_at(body_, shear, bulk);
  if (shift_1_s2_ > 0.0) stiffness.coeffs() += shift_1_s2_ * body_.mass.coeffs();
  factored.factor(stiffness);
  const StiffnessFactor::Product product = product_at(body_, shear, bulk);
  if (!product) return;
  factored.refine_by([this, product](const Eigen::VectorXd& u, const Eigen::VectorXd& source) {
    Eigen::VectorXd force = product(u, source);
    if (shift_1_s2_ > 0.0) force += shift_1_s2_ * times(body_.mass, u);
    return force;
  });
}

Eigen::VectorXd ReducedSpan::elastic_times(const Eigen::VectorXd& v) const {
  if (has_elastic_) return times(body_.elastic, v);
  return Eigen::VectorXd::Zero(v.size());
}

// By the entries, which is enough to compare sizes.
double ReducedSpan::energy_norm(const Eigen::VectorXd& v) const {
  Eigen::VectorXd force = elastic_times(v) + times(body_.shear, v);
  if (!body_.incompressible) force += times(body_.bulk, v);
  if (shift_1_s2_ > 0.0) force += shift_1_s2_ * times(body_.mass, v);
  return std::sqrt(std::max(v.dot(force), 0.0));
}

// Rigid motions bear no stress, which holds without rounding here.
void ReducedSpan::add_rigid_motions() {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(body_.shear.rows());
  for (Eigen::Index i = 0; i < rigid_count(); ++i) {
    Eigen::VectorXd v = body_.rigid.col(i);
    v -= projected(v);
    v /= std::sqrt(shift_1_s2_ * v.dot(times(body_.mass, v)));
    append(v, {none, none, none, times(body_.mass, v)});
  }
}

Eigen::VectorXd ReducedSpan::balanced(const Eigen::VectorXd& load) const {
  const Eigen::Index rigid = rigid_count();
  return load - shift_1_s2_ * (mass_.leftCols(rigid) * (basis_.leftCols(rigid).transpose() * load));
}

Eigen::VectorXd ReducedSpan::projected(const Eigen::VectorXd& v) const {
  return basis_ * (force_.transpose() * v);
}

// Where little of a vector is left, what rounding changed of the volume of an incompressible body counts: the
// next motion (in the energy) that keeps the volume.
Eigen::VectorXd ReducedSpan::keeping_volume(const Eigen::VectorXd& v) const {
  Eigen::VectorXd force = elastic_times(v) + shear_times(body_, v) + bulk_times(body_, v);
  if (shift_1_s2_ > 0.0) force += shift_1_s2_ * times(body_.mass, v);
  return instantaneous_.solve(force);
}

bool ReducedSpan::add(Eigen::VectorXd v) {
  constexpr double kKeepsVolume = 0.1;
  if (count() == basis_.rows()) return false;
  const double before = energy_norm(v);
  // Twice is enough (Parlett, The Symmetric Eigenvalue Problem, 6.9).
  for (int pass = 0; pass < 2; ++pass) v -= projected(v);
  if (body_.incompressible && energy_norm(v) < kKeepsVolume * before) v = keeping_volume(v);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(v.size());
  // An incompressible body's volume does not change.
  Images images{elastic_times(v), shear_times(body_, v),
                body_.incompressible ? none : bulk_times(body_, v),
                has_mass() ? times(body_.mass, v) : none};
  Eigen::VectorXd force = images.elastic + images.shear + images.bulk;
  if (shift_1_s2_ > 0.0) force += shift_1_s2_ * images.mass;
  const double after = std::sqrt(std::max(v.dot(force), 0.0));
  if (!(after > 1e-9 * before) || !std::isfinite(after)) return false;
  v /= after;
  force /= after;
  for (Eigen::VectorXd* image : {&images.elastic, &images.shear, &images.bulk, &images.mass}) {
    *image /= after;
  }
  // Rounding is orthogonal to the basis from one side only: what it adds has no energy of its own.
  constexpr double kMostOverlap = 1e-3;
  if (count() > 0) {
    const Eigen::VectorXd overlap = basis_.transpose() * force;
    if (!(overlap.cwiseAbs().maxCoeff() < kMostOverlap)) return false;
  }
  append(v, images);
  return true;
}

void ReducedSpan::append(const Eigen::VectorXd& v, const Images& images) {
  add_column(basis_, v);
  add_column(elastic_, images.elastic);
  add_column(shear_, images.shear);
  add_column(bulk_, images.bulk);
  add_column(mass_, images.mass);
  add_column(force_, images.elastic + images.shear + images.bulk + shift_1_s2_ * images.mass);
  const Eigen::Index uncoupled = count() > rigid_count() ? rigid_count() : 0;
  border(small_elastic_, basis_, elastic_, uncoupled);
  border(small_shear_, basis_, shear_, uncoupled);
  border(small_bulk_, basis_, bulk_, uncoupled);
  border(small_mass_, basis_, mass_, uncoupled);
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

Eigen::VectorXd ReducedSpan::without_pressures(Eigen::VectorXd residual) const {
  for (int pass = 0; body_.incompressible && pass < 2; ++pass) {
    Eigen::VectorXd source;
    instantaneous_.solve(residual, &source);
    residual -= bulk_times(body_, source);
  }
  return residual;
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
  result.system.rigid = Eigen::MatrixXd::Identity(count(), rigid_count());
  return result;
}

}  // namespace viscard
