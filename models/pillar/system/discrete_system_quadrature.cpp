// Operations that products of one-dimensional matrices cannot express: varying coefficients,
// stretched elements and values at single points.
#include "models/pillar/system/discrete_system.h"

#include <algorithm>

namespace viscard {
namespace {

// Basis functions of an element at one point, and their derivatives along x and z of the body.
// With x = scale(z) xi: d/dx = (1/scale) d/dxi, d/dz = d/dzeta - xi (slope/scale) d/dxi.
struct PointBasis {
  double x = 0.0;
  Eigen::RowVectorXd value, d_dx, d_dz;
};

template <typename Row>
PointBasis point_basis(double xi, const Stretch& stretch, const Row& bx, const Row& dbx,
                       const Row& bz, const Row& dbz) {
  const Eigen::Index n = bx.size();
  PointBasis basis{stretch.scale * xi, Eigen::RowVectorXd(n * n), Eigen::RowVectorXd(n * n),
                   Eigen::RowVectorXd(n * n)};
  const double shear = xi * stretch.slope_1_m / stretch.scale;
  for (Eigen::Index i = 0; i < n; ++i) {
    basis.value.segment(i * n, n) = bz[i] * bx;
    basis.d_dx.segment(i * n, n) = bz[i] / stretch.scale * dbx;
    basis.d_dz.segment(i * n, n) = dbz[i] * bx - shear * bz[i] * dbx;
  }
  return basis;
}

// Operator rows on all unknowns of an element: rows.size() x (field_count * n).
void fill_rows(const std::vector<OperatorRow>& rows, const PointBasis& at,
               Eigen::Ref<Eigen::MatrixXd> B) {
  const Eigen::Index n = at.value.size();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const OperatorTerm& t : rows[r]) {
      const Eigen::RowVectorXd& basis = t.dx == 1 ? at.d_dx : t.dz == 1 ? at.d_dz : at.value;
      B.block(static_cast<Eigen::Index>(r), t.field * n, 1, n) +=
          (t.inverse_x == 1 ? t.factor / at.x : t.factor) * basis;
    }
  }
}

// Legendre polynomials of degree 0 to p - 2 at points of an element of a line: points x (p - 1).
Eigen::MatrixXd legendre_on(const LineMesh& line, int element, const Eigen::VectorXd& points) {
  std::vector<double> unit;
  for (const double at : points) {
    unit.push_back((at - line.breaks()[static_cast<std::size_t>(element)]) / line.length(element));
  }
  return legendre_values(std::max(line.degree() - 2, 0), unit);
}

// The part of one operator row and one field at all points (`all` has n_rows rows for each), points x nodes;
// empty if it is zero.
Eigen::MatrixXd part_of(const Eigen::MatrixXd& all, Eigen::Index row, Eigen::Index n_rows,
                        Eigen::Index field, Eigen::Index n_nodes) {
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> part(
      all.data() + field * n_nodes * all.rows() + row, all.rows() / n_rows, n_nodes,
      Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>(all.rows(), n_rows));
  if (part.isZero(0.0)) return {};
  return part;
}

// B' DB, where DB = D B with symmetric D at every point. Most rows have terms of one or two fields, so most
// products of a part with another are zero and left out.
Eigen::MatrixXd product_of_parts(const Eigen::MatrixXd& B, const Eigen::MatrixXd& DB,
                                 Eigen::Index n_rows, Eigen::Index n_nodes) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(B.cols(), B.cols());
  const Eigen::Index n_fields = B.cols() / n_nodes;
  for (Eigen::Index row = 0; row < n_rows; ++row) {
    for (Eigen::Index left = 0; left < n_fields; ++left) {
      const Eigen::MatrixXd of_left = part_of(B, row, n_rows, left, n_nodes);
      for (Eigen::Index right = 0; of_left.size() > 0 && right <= left; ++right) {
        const Eigen::MatrixXd of_right = part_of(DB, row, n_rows, right, n_nodes);
        if (of_right.size() == 0) continue;
        product.block(left * n_nodes, right * n_nodes, n_nodes, n_nodes).noalias() +=
            of_left.transpose() * of_right;
      }
    }
  }
  product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
  return product;
}

}  // namespace

DiscreteSystem::ElementRows DiscreteSystem::element_rows(const std::vector<OperatorRow>& rows,
                                                         const SectionElement& element) const {
  const auto n_rows = static_cast<Eigen::Index>(rows.size());
  const LineMesh::ElementRule in_x = section_->x().rule(element.column);
  const LineMesh::ElementRule in_z = section_->z().rule(element.row);
  const Eigen::MatrixXd Lx = legendre_on(section_->x(), element.column, in_x.x);
  const Eigen::MatrixXd Lz = legendre_on(section_->z(), element.row, in_z.x);
  const Eigen::Index n1 = section_->degree() + 1;
  const Eigen::Index n_points = in_x.x.size() * in_z.x.size();
  ElementRows out{Eigen::MatrixXd::Zero(n_points * n_rows, kinematics_.field_count * n1 * n1),
                  Eigen::VectorXd(n_points), Eigen::MatrixXd(n_points, Lx.cols() * Lz.cols())};
  Eigen::Index k = 0;
  for (Eigen::Index kz = 0; kz < in_z.x.size(); ++kz) {
    const Stretch stretch = section_->stretch_at(element.region, in_z.x[kz]);
    for (Eigen::Index kx = 0; kx < in_x.x.size(); ++kx, ++k) {
      const PointBasis at = point_basis<Eigen::RowVectorXd>(
          in_x.x[kx], stretch, in_x.value.row(kx), in_x.derivative.row(kx), in_z.value.row(kz),
          in_z.derivative.row(kz));
      fill_rows(rows, at, out.B.middleRows(k * n_rows, n_rows));
      out.weight[k] = kinematics_.measure * in_x.weight[kx] * in_z.weight[kz] * stretch.scale *
                      (kinematics_.x_power == 1 ? at.x : 1.0);
      for (Eigen::Index i = 0; i < Lz.cols(); ++i) {
        out.pressure.row(k).segment(i * Lx.cols(), Lx.cols()) = Lz(kz, i) * Lx.row(kx);
      }
    }
  }
  return out;
}

Eigen::RowVectorXd DiscreteSystem::pressure_basis_at(const SectionElement& element, double x,
                                                     double z) const {
  const double xi = x / section_->stretch_at(element.region, z).scale;
  const Eigen::MatrixXd Lx =
      legendre_on(section_->x(), element.column, Eigen::VectorXd::Constant(1, xi));
  const Eigen::MatrixXd Lz =
      legendre_on(section_->z(), element.row, Eigen::VectorXd::Constant(1, z));
  Eigen::RowVectorXd basis(Lx.cols() * Lz.cols());
  for (Eigen::Index i = 0; i < Lz.cols(); ++i) {
    basis.segment(i * Lx.cols(), Lx.cols()) = Lz(0, i) * Lx;
  }
  return basis;
}

Eigen::MatrixXd DiscreteSystem::quadrature_form(
    const std::vector<OperatorRow>& rows, const SectionElement& element,
    const std::function<Eigen::MatrixXd(double x, double z)>& D) const {
  const ElementRows at = element_rows(rows, element);
  const auto n_rows = static_cast<Eigen::Index>(rows.size());
  const LineMesh::ElementRule in_x = section_->x().rule(element.column);
  const LineMesh::ElementRule in_z = section_->z().rule(element.row);
  Eigen::MatrixXd DB(at.B.rows(), at.B.cols());
  Eigen::Index k = 0;
  for (Eigen::Index kz = 0; kz < in_z.x.size(); ++kz) {
    const double scale = section_->stretch_at(element.region, in_z.x[kz]).scale;
    for (Eigen::Index kx = 0; kx < in_x.x.size(); ++kx, ++k) {
      DB.middleRows(k * n_rows, n_rows).noalias() =
          at.weight[k] * D(scale * in_x.x[kx], in_z.x[kz]) * at.B.middleRows(k * n_rows, n_rows);
    }
  }
  const Eigen::Index n1 = section_->degree() + 1;
  return product_of_parts(at.B, DB, n_rows, n1 * n1);
}

SymmetricSparse DiscreteSystem::varying_form(
    const std::vector<OperatorRow>& rows,
    const std::function<Eigen::MatrixXd(const SectionElement&, double, double)>& D,
    const std::function<bool(const SectionElement&)>& counts) const {
  SymmetricSparse matrix = zero();
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    if (counts && !counts(element)) continue;
    const auto here = [&](double x, double z) { return D(element, x, z); };
    scatter(e, quadrature_form(rows, element, here), matrix);
  }
  return matrix;
}

DiscreteSystem::Projection DiscreteSystem::stretched_projection(
    const SectionElement& element) const {
  const ElementRows at = element_rows({kinematics_.divergence}, element);
  // The measure of the kinematics cancels.
  const Eigen::MatrixXd weighted = (at.weight / kinematics_.measure).asDiagonal() * at.pressure;
  return {std::max(section_->degree() - 2, 0), weighted.transpose() * at.B,
          weighted.transpose() * at.pressure};
}

Eigen::VectorXd DiscreteSystem::rows_at(const std::vector<OperatorRow>& rows,
                                        const Eigen::VectorXd& solution,
                                        const SectionElement& element, double x, double z) const {
  const Stretch stretch = section_->stretch_at(element.region, z);
  const double xi = x / stretch.scale;
  const BasisValues in_x = section_->x().basis_at(element.column, xi);
  const BasisValues in_z = section_->z().basis_at(element.row, z);
  const PointBasis at = point_basis<Eigen::RowVectorXd>(xi, stretch, in_x.value, in_x.derivative,
                                                        in_z.value, in_z.derivative);
  const Eigen::VectorXd local = element_values(element, solution);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), local.size());
  fill_rows(rows, at, B);
  return B * local;
}

}  // namespace viscard
