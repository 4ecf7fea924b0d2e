#include "models/array/plane/plane_system.h"
#include "models/maths/usable_machine.h"
#include "models/pillar/system/supernodal_factor.h"

#include <stdexcept>

namespace viscard {
namespace {

struct Split {
  std::vector<int> place;  // unknown -> number among the kept (>= 0) or -1 - number inside
  int inside = 0;
};

Split split_of(int size, const std::vector<int>& kept) {
  Split split{std::vector<int>(static_cast<std::size_t>(size), 0), 0};
  std::vector<bool> is_kept(static_cast<std::size_t>(size), false);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] < 0) continue;
    is_kept[static_cast<std::size_t>(kept[k])] = true;
    split.place[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  }
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (!is_kept[i]) split.place[i] = -1 - split.inside++;
  }
  return split;
}

}  // namespace

Eigen::MatrixXd condensed(const SymmetricSparse& A, const std::vector<int>& kept,
                          const Eigen::MatrixXd& F, const Eigen::MatrixXd& B) {
  const Split split = split_of(static_cast<int>(A.rows()), kept);
  const auto n_kept = static_cast<Eigen::Index>(kept.size());
  const Eigen::Index width = n_kept + F.cols();
  constexpr double kCopies = 3.0;  // of the columns that are eliminated
  require_memory(static_cast<double>(A.rows()),
                 8.0 * static_cast<double>(width) *
                     (static_cast<double>(width) + kCopies * static_cast<double>(split.inside)));
  Eigen::MatrixXd corner = Eigen::MatrixXd::Zero(width, width);
  corner.bottomRightCorner(F.cols(), F.cols()) = B;
  Eigen::MatrixXd beside = Eigen::MatrixXd::Zero(split.inside, width);
  std::vector<Eigen::Triplet<double>> inside;
  inside.reserve(static_cast<std::size_t>(A.nonZeros()));
  for (int column = 0; column < A.outerSize(); ++column) {
    const int c = split.place[static_cast<std::size_t>(column)];
    for (SymmetricSparse::InnerIterator it(A, column); it; ++it) {
      const int r = split.place[static_cast<std::size_t>(it.row())];
      if (r >= 0 && c >= 0) {
        corner(r, c) = corner(c, r) = it.value();
      } else if (r < 0 && c < 0) {
        inside.emplace_back(-1 - r, -1 - c, it.value());
      } else {
        beside(r < 0 ? -1 - r : -1 - c, r < 0 ? c : r) = it.value();
      }
    }
  }
  for (Eigen::Index i = 0; i < F.rows(); ++i) {
    const int r = split.place[static_cast<std::size_t>(i)];
    if (r >= 0) {
      corner.row(r).tail(F.cols()) = F.row(i);
      corner.col(r).tail(F.cols()) = F.row(i).transpose();
    } else {
      beside.row(-1 - r).tail(F.cols()) = F.row(i);
    }
  }
  SymmetricSparse A_inside(split.inside, split.inside);
  A_inside.setFromTriplets(inside.begin(), inside.end());
  SupernodalFactor factor;
  factor.analyse(A_inside);
  if (!factor.factor(A_inside)) {
    throw std::runtime_error(
        "a piece of the array is singular: a modulus is zero or not finite; check the materials");
  }
  const Eigen::MatrixXd reduced = factor.forward(beside);
  const Eigen::MatrixXd scaled = factor.pivots().cwiseInverse().asDiagonal() * reduced;
  corner.noalias() -= scaled.transpose() * reduced;
  return corner;
}

}  // namespace viscard
