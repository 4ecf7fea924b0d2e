#include "models/pillar/system/discrete_system.h"

#include "models/maths/dense.h"
#include "models/maths/usable_machine.h"
#include "models/pillar/system/kronecker_form.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// block += kron(z, x) with x fastest.
void add_kronecker(const Eigen::MatrixXd& z, const Eigen::MatrixXd& x,
                   Eigen::Ref<Eigen::MatrixXd> block) {
  const Eigen::Index n = x.rows();
  for (Eigen::Index jz = 0; jz < n; ++jz) {
    for (Eigen::Index jx = 0; jx < n; ++jx) {
      double* column = block.col(jz * n + jx).data();
      const double* of_x = x.col(jx).data();
      for (Eigen::Index iz = 0; iz < n; ++iz) {
        const double factor = z(iz, jz);
        for (Eigen::Index ix = 0; ix < n; ++ix) column[iz * n + ix] += factor * of_x[ix];
      }
    }
  }
}

// What the matrices of a system and the factors of one need, B. An unknown meets those of its element and,
// on an edge, of its neighbour; an analysis holds half a dozen matrices of one pattern. Factors in an order of
// least degree add as much for the insides of elements, and 31 n log2(n)/4 entries for the n unknowns
// on their edges (George, SIAM J. Numer. Anal. 10 (1973) 345).
double memory_of(const Section& section, const Kinematics& kinematics, int unknowns) {
  constexpr double kMatrices = 6.0, kEntry_B = 12.0, kNumber_B = 8.0;
  const double p = section.degree(), n = unknowns;
  const double row = 0.5 * kinematics.field_count * (p + 2.0) * (p + 2.0);
  const double on_edges = n * (2.0 * p - 1.0) / (p * p);
  return n * row * (kMatrices * kEntry_B + 2.0 * kNumber_B) +
         kNumber_B * 7.75 * kinematics.field_count * on_edges * std::log2(on_edges + 2.0);
}

}  // namespace

DiscreteSystem::DiscreteSystem(const Section& section, Kinematics kinematics, DofMap dofs)
    : section_(&section), kinematics_(std::move(kinematics)), dofs_(std::move(dofs)) {
  if (dofs_.count() == 0) throw std::invalid_argument("every unknown is held; nothing can move");
  require_memory(dofs_.count(), memory_of(section, kinematics_, dofs_.count()));
  const auto structure = std::make_shared<Structure>();
  order_elements(*structure);
  build_pattern(*structure);
  structure_ = structure;
}

DiscreteSystem::DiscreteSystem(const Section& section, Kinematics kinematics,
                               const DiscreteSystem& like)
    : section_(&section),
      kinematics_(std::move(kinematics)),
      dofs_(like.dofs_),
      structure_(like.structure_) {}

std::vector<int> DiscreteSystem::element_dofs(const SectionElement& element) const {
  std::vector<int> dofs;
  dofs.reserve(element.nodes.size() * static_cast<std::size_t>(kinematics_.field_count));
  for (int field = 0; field < kinematics_.field_count; ++field) {
    for (const int node : element.nodes) dofs.push_back(dofs_.dof(field, node));
  }
  return dofs;
}

void DiscreteSystem::order_elements(Structure& structure) const {
  std::vector<std::pair<int, int>> found;  // unknown, local number
  for (const SectionElement& element : section_->elements()) {
    found.clear();
    for (const int dof : element_dofs(element)) {
      found.emplace_back(dof, static_cast<int>(found.size()));
    }
    std::sort(found.begin(), found.end());
    LocalOrder order;
    for (const auto& [dof, local] : found) {
      if (dof < 0) continue;
      order.dofs.push_back(dof);
      order.local.push_back(local);
    }
    structure.local.push_back(std::move(order));
  }
}

void DiscreteSystem::build_pattern(Structure& structure) const {
  const std::vector<LocalOrder>& local = structure.local;
  std::vector<std::vector<int>> elements_of(static_cast<std::size_t>(size()));
  std::size_t most = 0;  // entries of all elements; shared ones count repeatedly
  for (std::size_t e = 0; e < local.size(); ++e) {
    most += local[e].dofs.size() * (local[e].dofs.size() + 1) / 2;
    int last = -1;
    for (const int dof : local[e].dofs) {
      if (dof != last) elements_of[static_cast<std::size_t>(dof)].push_back(static_cast<int>(e));
      last = dof;
    }
  }
  structure.column_start.assign(1, 0);
  structure.row.reserve(most);
  std::vector<int> seen(elements_of.size(), -1);
  std::vector<int> rows;
  for (int column = 0; column < size(); ++column) {
    // Unknowns with consecutive numbers mostly belong to the same elements (fields of a node, nodes
    // of an edge), so their columns differ only in the first row.
    const auto own = elements_of.begin() + column;
    if (column == 0 || *own != *(own - 1)) {
      rows.clear();
      for (const int e : *own) {
        for (const int row : local[static_cast<std::size_t>(e)].dofs) {
          if (row < column || seen[static_cast<std::size_t>(row)] == column) continue;
          seen[static_cast<std::size_t>(row)] = column;
          rows.push_back(row);
        }
      }
      std::sort(rows.begin(), rows.end());
    }
    const auto first = std::lower_bound(rows.begin(), rows.end(), column);
    structure.row.insert(structure.row.end(), first, rows.end());
    structure.column_start.push_back(static_cast<int>(structure.row.size()));
  }
}

SymmetricSparse DiscreteSystem::zero() const {
  const std::vector<int>&column_start = structure_->column_start, &row = structure_->row;
  SymmetricSparse matrix(size(), size());
  matrix.resizeNonZeros(static_cast<Eigen::Index>(row.size()));
  std::copy(column_start.begin(), column_start.end(), matrix.outerIndexPtr());
  std::copy(row.begin(), row.end(), matrix.innerIndexPtr());
  matrix.coeffs().setZero();
  return matrix;
}

void DiscreteSystem::scatter(std::size_t element, const Eigen::MatrixXd& block,
                             SymmetricSparse& matrix) const {
  const auto& [dofs, local] = structure_->local[element];
  const int* outer = matrix.outerIndexPtr();
  const int* inner = matrix.innerIndexPtr();
  double* values = matrix.valuePtr();
  std::size_t first = 0;  // first of the unknowns tied to the column's unknown
  for (std::size_t j = 0; j < dofs.size(); ++j) {
    if (dofs[j] != dofs[first]) first = j;
    int at = outer[dofs[j]];
    for (std::size_t i = first; i < dofs.size(); ++i) {
      while (inner[at] < dofs[i]) ++at;  // rows ascend: one pass finds them all
      values[at] += block(std::max(local[i], local[j]), std::min(local[i], local[j]));
    }
  }
}

SymmetricSparse DiscreteSystem::form(const std::vector<OperatorRow>& rows,
                                     const std::vector<Eigen::MatrixXd>& per_region) const {
  const int fields = kinematics_.field_count;
  const Eigen::Index n1 = section_->degree() + 1;
  const Eigen::Index nn = n1 * n1;
  const KroneckerForm products(*section_, kinematics_, rows, per_region);
  SymmetricSparse matrix = zero();
  Eigen::MatrixXd block(fields * nn, fields * nn);
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    if (products.is_empty(element.region)) continue;
    if (section_->is_stretched(element.region)) {
      const Eigen::MatrixXd& D = per_region[static_cast<std::size_t>(element.region)];
      scatter(e, quadrature_form(rows, element, [&](double, double) { return D; }), matrix);
      continue;
    }
    block.setZero();
    products.each(element, [&](int f, int g, const Eigen::MatrixXd& z, const Eigen::MatrixXd& x) {
      add_kronecker(z, x, block.block(f * nn, g * nn, nn, nn));
    });
    scatter(e, block, matrix);
  }
  return matrix;
}

SymmetricSparse DiscreteSystem::volume_form(const std::vector<double>& per_region,
                                            bool projected) const {
  if (!projected) {
    std::vector<Eigen::MatrixXd> D;
    for (const double factor : per_region) D.push_back(Eigen::MatrixXd::Constant(1, 1, factor));
    return form({kinematics_.divergence}, D);
  }
  SymmetricSparse matrix = zero();
  for (std::size_t e = 0; e < section_->elements().size(); ++e) {
    const SectionElement& element = section_->elements()[e];
    const double factor =
        per_region.at(static_cast<std::size_t>(element.region)) * kinematics_.measure;
    if (factor == 0.0) continue;
    const Projection p = projection(element);
    scatter(e, factor * (p.divergence.transpose() * SymmetricFactor(p.mass).solve(p.divergence)),
            matrix);
  }
  return matrix;
}

DiscreteSystem::Projection DiscreteSystem::projection(const SectionElement& element) const {
  if (section_->is_stretched(element.region)) return stretched_projection(element);
  const int q = std::max(section_->degree() - 2, 0);
  const Eigen::Index nq = q + 1;
  const Eigen::Index n1 = section_->degree() + 1;
  Projection p{q, Eigen::MatrixXd::Zero(nq * nq, kinematics_.field_count * n1 * n1),
               Eigen::MatrixXd::Zero(nq * nq, nq * nq)};
  for (const OperatorTerm& t : kinematics_.divergence) {
    const Eigen::MatrixXd x =
        t.factor *
        section_->x().legendre_integral(element.column, kinematics_.x_power - t.inverse_x, q, t.dx);
    const Eigen::MatrixXd z = section_->z().legendre_integral(element.row, 0, q, t.dz);
    for (Eigen::Index kz = 0; kz < nq; ++kz) {
      for (Eigen::Index iz = 0; iz < n1; ++iz) {
        p.divergence.block(kz * nq, t.field * n1 * n1 + iz * n1, nq, n1) += z(kz, iz) * x;
      }
    }
  }
  add_kronecker(section_->z().legendre_mass(element.row, 0, q),
                section_->x().legendre_mass(element.column, kinematics_.x_power, q), p.mass);
  return p;
}

}  // namespace viscard
