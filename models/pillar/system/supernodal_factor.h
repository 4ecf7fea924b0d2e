#pragma once

#include "models/pillar/system/block_order.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <vector>

namespace viscard {

// Multifrontal L D L^T without pivoting of a sparse symmetric matrix that is definite or
// quasi-definite, so that factors exist in any order. Columns with the same rows below them are
// eliminated together as a dense block. Each block passes its update (Schur complement) to its
// parent as one dense matrix. High-order elements give large blocks, so nearly all work is dense.
// `./run bench pillar` compares its time with CHOLMOD and Eigen (models/README.md). A complex matrix is
// symmetric too, not Hermitian; without pivoting its factors lose digits near a resonance of a part of the
// body, so that the caller checks the solutions. Source: Duff &
// Reid, ACM Trans. Math. Softw. 9 (1983) 302; order and blocks: block_order.h.
template <typename Scalar>
class BlockFactor {
 public:
  using Vector = Eigen::Vector<Scalar, Eigen::Dynamic>;  // of unknowns
  using Matrix =
      Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;  // a column for each right-hand side

  // Chooses the order and the blocks from the pattern of the lower triangle.
  void analyse(const Eigen::SparseMatrix<double>& lower);
  // Factors a matrix of the analysed pattern, `lower` its lower triangle; returns false if a pivot is zero or not finite.
  bool factor(const Eigen::SparseMatrix<Scalar>& lower);
  // A^-1 right_side.
  Vector solve(const Vector& right_side) const;

  // L^-1 P B for many right-hand sides at once, with rows in elimination order, as in pivots(). If
  // X comes from B and Y from C, then X' D^-1 Y = B' A^-1 C.
  Matrix forward(const Matrix& right_sides) const;

  const Vector& pivots() const { return pivots_; }
  Eigen::Index entries() const;  // entries of L, including the zeros that merged blocks store

 private:
  struct Block : ColumnBlock {
    int parent = -1;             // block
    std::vector<int> to_parent;  // index of each row in the parent's front
    Matrix L;                    // (count + rows) x count; unit diagonal not stored
    int height() const { return count + static_cast<int>(rows.size()); }  // rows of its front
  };
  struct Entry {
    int value;  // number of the stored value in the matrix
    int place;  // index in the front, column-major
  };

  void find_parents();
  void place_entries(const Eigen::SparseMatrix<double>& lower);

  std::vector<int> position_;             // unknown -> position in the elimination order
  std::vector<Block> blocks_;             // children before parents
  std::vector<Entry> entries_;            // column by column in elimination order
  std::vector<std::size_t> first_entry_;  // start of each column, and one past the last
  Eigen::Index largest_front_ = 0;        // rows
  Vector pivots_;
};

using SupernodalFactor = BlockFactor<double>;                       // of statics and modes
using ComplexSupernodalFactor = BlockFactor<std::complex<double>>;  // of single frequencies

}  // namespace viscard
