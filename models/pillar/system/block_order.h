#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace viscard {

// Consecutive columns of L that share the rows below them. Small blocks are merged with their
// parents, although this stores some zeros.
struct ColumnBlock {
  int first = 0;          // column
  int count = 0;          // columns
  std::vector<int> rows;  // below the block's own columns, ascending
};

// The elimination order of a sparse symmetric matrix, and the column blocks of its factor, children
// before parents. Unknowns with the same neighbours (the fields of a node, the interior of an
// element or of an edge) form a group. Approximate minimum degree runs on the groups, which are
// about ten times fewer than the unknowns.
// Sources: Amestoy, Davis & Duff, SIAM J. Matrix Anal. 17 (1996) 886; groups: Ashcraft, SIAM J.
// Sci. Comput. 16 (1995) 1404; merging: Ashcraft & Grimes, ACM Trans. Math. Softw. 15 (1989) 291.
struct BlockOrder {
  std::vector<int> position;  // unknown -> place in the order
  std::vector<ColumnBlock> blocks;
};
// The order for a matrix whose lower triangle is `lower`.
BlockOrder block_order(const Eigen::SparseMatrix<double>& lower);

}  // namespace viscard
