// Outputs of a film's potentials, whose dual solutions a basis is to hold.
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/reduced_span.h"

#include <cmath>
#include <utility>
#include <vector>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The form of the potentials is negative, and only a film has them.
bool is_potential(const ViscoelasticSystem& system, int i) {
  return system.shear.coeff(i, i) == 0.0 && system.elastic.coeff(i, i) < 0.0;
}

// The potentials that an output causes, as a charge, while nothing moves; zero in all other unknowns, and
// empty if it reads none.
VectorXd potentials_at_rest(const ViscoelasticSystem& system, const VectorXd& output) {
  std::vector<int> place(static_cast<std::size_t>(output.size()), -1);
  std::vector<int> potentials;
  bool reads_potential = false;
  for (int i = 0; i < output.size(); ++i) {
    if (!is_potential(system, i)) continue;
    place[static_cast<std::size_t>(i)] = static_cast<int>(potentials.size());
    potentials.push_back(i);
    reads_potential = reads_potential || output[i] != 0.0;
  }
  if (!reads_potential) return {};
  const auto count = static_cast<Index>(potentials.size());
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd side(count);
  for (const int i : potentials) {
    const int column = place[static_cast<std::size_t>(i)];
    side[column] = output[i];
    for (SymmetricSparse::InnerIterator entry(system.elastic, i); entry; ++entry) {
      const int row = place[static_cast<std::size_t>(entry.row())];
      if (row >= 0) entries.emplace_back(row, column, -entry.value());
    }
  }
  SymmetricSparse form(count, count);
  form.setFromTriplets(entries.begin(), entries.end());
  StiffnessFactor factor;
  factor.factor(form);
  const VectorXd potential = factor.solve(side);
  VectorXd charged = VectorXd::Zero(output.size());
  for (const int i : potentials) charged[i] = -potential[place[static_cast<std::size_t>(i)]];
  return charged;
}

// A matrix times many vectors, which reads each of its entries once.
Eigen::MatrixXd times_all(const SymmetricSparse& lower, const Eigen::MatrixXd& vectors) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Rows x = vectors;
  Rows y = Rows::Zero(x.rows(), x.cols());
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (SymmetricSparse::InnerIterator entry(lower, column); entry; ++entry) {
      if (entry.value() == 0.0) continue;  // the pillar's matrices have the film's pattern too
      y.row(entry.row()) += entry.value() * x.row(column);
      if (entry.row() != column) y.row(column) += entry.value() * x.row(entry.row());
    }
  }
  return y;
}

}  // namespace

VectorXd output_of_motion(const ViscoelasticSystem& system, const VectorXd& output) {
  const VectorXd charged = potentials_at_rest(system, output);
  if (charged.size() == 0) return output;
  VectorXd of_motion = output - times(system.elastic, charged);
  for (int i = 0; i < output.size(); ++i) {
    if (is_potential(system, i)) of_motion[i] = 0.0;  // to rounding
  }
  return of_motion;
}

Eigen::MatrixXd nearby_basis(const ViscoelasticSystem& system, const Eigen::MatrixXd& solutions,
                             const std::vector<VectorXd>& outputs) {
  Eigen::MatrixXd basis = solutions;
  for (const VectorXd& output : outputs) {
    const VectorXd charged = potentials_at_rest(system, output);
    if (charged.size() == 0) continue;
    const double energy = std::abs(charged.dot(times(system.elastic, charged)));
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.col(basis.cols() - 1) = charged / std::sqrt(energy);
  }
  return basis;
}

ReducedBody restricted_to(const ViscoelasticSystem& system, Eigen::MatrixXd basis) {
  const auto small = [&basis](const SymmetricSparse& matrix) {
    return full_lower(basis.transpose() * times_all(matrix, basis));
  };
  ReducedBody result;
  result.system.terms = system.terms;
  result.system.elastic = small(system.elastic);
  result.system.shear = small(system.shear);
  // An incompressible body's volume does not change.
  result.system.bulk = system.incompressible
                           ? full_lower(Eigen::MatrixXd::Zero(basis.cols(), basis.cols()))
                           : small(system.bulk);
  if (system.mass.size() > 0) result.system.mass = small(system.mass);
  if (system.load.size() > 0) result.system.load = basis.transpose() * system.load;
  result.basis = std::move(basis);
  return result;
}

}  // namespace viscard
