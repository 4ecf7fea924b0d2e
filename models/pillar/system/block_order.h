#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace viscard {

// Consecutive columns of L that have the same rows below them, or nearly: small ones are merged at
// the price of some zeros.
struct ColumnBlock {
  int first = 0;          // column
  int count = 0;          // columns
  std::vector<int> rows;  // below the block's own columns, ascending
};

// In which order the unknowns of a sparse symmetric matrix are eliminated, and the blocks of the
// factor, children before parents. Minimum degree on groups of unknowns with the same neighbours
// (the fields of a node, the inside of an element or of an edge), which are ten times fewer.
// Sources: Amestoy, Davis & Duff, SIAM J. Matrix Anal. 17 (1996) 886; groups: Ashcraft, SIAM J.
// Sci. Comput. 16 (1995) 1404; merging: Ashcraft & Grimes, ACM Trans. Math. Softw. 15 (1989) 291.
struct BlockOrder {
  std::vector<int> position;  // unknown -> place in the order
  std::vector<ColumnBlock> blocks;
};
BlockOrder block_order(const Eigen::SparseMatrix<double>& lower);

}  // namespace viscard
