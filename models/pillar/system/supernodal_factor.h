#pragma once

#include "models/pillar/system/block_order.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace viscard {

// L D L^T of a sparse symmetric matrix whose factors exist in any order of elimination (definite or
// quasi-definite), by dense blocks: columns with the same rows below them are eliminated together,
// and what a block leaves to its ancestors is handed up as one dense matrix. High-order elements
// give large blocks, so that nearly all work is dense. Source: Duff & Reid, ACM Trans. Math. Softw.
// 9 (1983) 302; the order and the blocks are those of block_order.h.
class SupernodalFactor {
 public:
  // Order, blocks and places from the pattern of the lower triangle.
  void analyse(const Eigen::SparseMatrix<double>& lower);
  // A matrix of the analysed pattern; false if a pivot is zero or not finite.
  bool factor(const Eigen::SparseMatrix<double>& lower);
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

  // L^-1 P B for many right sides at once, rows in the order of elimination, that of pivots(): with
  // X from B and Y from C, the sum X' D^-1 Y is B' A^-1 C.
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right_sides) const;

  const Eigen::VectorXd& pivots() const { return pivots_; }
  Eigen::Index entries() const;  // of L, zeros of merged blocks included

 private:
  struct Block : ColumnBlock {
    int parent = -1;             // block
    std::vector<int> to_parent;  // place of each row in the parent's front
    Eigen::MatrixXd L;           // (count + rows) x count; unit diagonal not stored
    int height() const { return count + static_cast<int>(rows.size()); }  // of its front
  };
  struct Entry {
    int value;  // which stored value of the matrix
    int place;  // in the front, column by column
  };

  void find_parents();
  void place_entries(const Eigen::SparseMatrix<double>& lower);

  std::vector<int> position_;             // unknown -> place in the order of elimination
  std::vector<Block> blocks_;             // children before parents
  std::vector<Entry> entries_;            // column by column in the order of elimination
  std::vector<std::size_t> first_entry_;  // of each column, and one past the last
  Eigen::Index largest_front_ = 0;        // rows
  Eigen::VectorXd pivots_;
};

}  // namespace viscard
