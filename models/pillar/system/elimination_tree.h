#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace viscard {

// The pattern of a symmetric matrix in elimination order, and that of its factor L.

// A list of numbers for each of n items, one behind the other: item i has those from start[i] to start[i + 1].
struct IndexLists {
  std::vector<int> start{0}, number;

  int count() const { return static_cast<int>(start.size()) - 1; }
  std::span<const int> of(int item) const {
    const auto i = static_cast<std::size_t>(item);
    return {number.data() + start[i], number.data() + start[i + 1]};
  }
  void end_item() { start.push_back(static_cast<int>(number.size())); }
};

// For each number the items that list it, ascending.
IndexLists transposed(const IndexLists& lists);

// The parent of each column in the elimination tree, -1 at roots. earlier: for each column, the columns before it that
// it meets. Source: Liu, SIAM J. Matrix Anal. 11 (1990) 134, with path compression.
std::vector<int> elimination_tree(const IndexLists& earlier);

// The place of each node in postorder: children come before their parents, and every subtree is contiguous.
std::vector<int> postorder(const std::vector<int>& parent);

// Rows below the diagonal of each column of L, ascending: the matrix's own and those from its children.
IndexLists factor_columns(const IndexLists& earlier, const std::vector<int>& parent);

}  // namespace viscard
