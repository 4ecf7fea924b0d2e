#include "models/pillar/system/block_order.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <unordered_map>
#include <utility>

namespace viscard {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Largest fraction of zeros in a merged block. It is higher for small blocks, whose overhead costs
// more than their arithmetic.
constexpr int kSmallBlock = 12;
constexpr double kZerosInSmall = 0.4;
constexpr double kZerosInLarge = 0.08;

// Groups of unknowns with the same neighbours; each is eliminated as a whole.
struct Groups {
  std::vector<int> of;                       // unknown -> group
  std::vector<int> size;                     // unknowns in each
  std::vector<std::vector<int>> neighbours;  // other groups
};

// A sum of random keys over each unknown and its neighbours. Two sums are equal if the two
// neighbourhoods are equal, and otherwise only with a probability of 2^-64.
std::vector<std::uint64_t> neighbourhood_sums(const Sparse& lower) {
  std::vector<std::uint64_t> key(static_cast<std::size_t>(lower.rows()));
  std::mt19937_64 random(1);
  for (std::uint64_t& k : key) k = random();
  std::vector<std::uint64_t> sum = key;
  for (int column = 0; column < lower.outerSize(); ++column) {
    for (Sparse::InnerIterator it(lower, column); it; ++it) {
      if (it.row() == column) continue;
      sum[static_cast<std::size_t>(column)] += key[static_cast<std::size_t>(it.row())];
      sum[static_cast<std::size_t>(it.row())] += key[static_cast<std::size_t>(column)];
    }
  }
  return sum;
}

// Links every group with the groups of the neighbours of one of its unknowns.
void find_neighbours(const Sparse& lower, const std::vector<int>& member, Groups& groups) {
  groups.neighbours.resize(member.size());
  std::vector<int> seen(member.size(), -1);  // the last group that was linked with this one
  for (std::size_t g = 0; g < member.size(); ++g) {
    const auto own = static_cast<int>(g);
    for (Sparse::InnerIterator it(lower, member[g]); it; ++it) {
      const int other = groups.of[static_cast<std::size_t>(it.row())];
      int& mark = seen[static_cast<std::size_t>(other)];
      if (mark == own) continue;
      mark = own;
      if (other == own) continue;
      groups.neighbours[g].push_back(other);
      groups.neighbours[static_cast<std::size_t>(other)].push_back(own);
    }
  }
  for (std::vector<int>& list : groups.neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

Groups groups_of(const Sparse& lower) {
  const std::vector<std::uint64_t> sum = neighbourhood_sums(lower);
  Groups groups{std::vector<int>(sum.size()), {}, {}};
  std::unordered_map<std::uint64_t, int> number;
  std::vector<int> member;  // the first unknown of each group
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const auto [at, is_new] = number.try_emplace(sum[i], static_cast<int>(number.size()));
    groups.of[i] = at->second;
    if (is_new) {
      groups.size.push_back(0);
      member.push_back(static_cast<int>(i));
    }
    ++groups.size[static_cast<std::size_t>(at->second)];
  }
  find_neighbours(lower, member, groups);
  return groups;
}

// The position of each group in the elimination order.
std::vector<int> minimum_degree_places(const Groups& groups) {
  const auto n = static_cast<int>(groups.size.size());
  std::vector<int> outer{0};
  std::vector<int> inner;
  for (int g = 0; g < n; ++g) {
    inner.push_back(g);
    const auto& list = groups.neighbours[static_cast<std::size_t>(g)];
    inner.insert(inner.end(), list.begin(), list.end());
    std::sort(inner.begin() + outer.back(), inner.end());  // as Eigen's sparse matrices require
    outer.push_back(static_cast<int>(inner.size()));
  }
  const std::vector<double> ones(inner.size(), 1.0);
  const Sparse pattern = Eigen::Map<const Sparse>(n, n, static_cast<int>(inner.size()),
                                                  outer.data(), inner.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  std::vector<int> place(groups.size.size());
  for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(permutation.indices()[i])] = i;
  return place;
}

// For each position, the positions of its neighbours that are eliminated earlier.
std::vector<std::vector<int>> earlier_neighbours(const Groups& groups,
                                                 const std::vector<int>& place) {
  std::vector<std::vector<int>> earlier(place.size());
  for (std::size_t g = 0; g < place.size(); ++g) {
    for (const int other : groups.neighbours[g]) {
      const int at = place[static_cast<std::size_t>(other)];
      if (at < place[g]) earlier[static_cast<std::size_t>(place[g])].push_back(at);
    }
  }
  return earlier;
}

// Elimination tree (Liu, SIAM J. Matrix Anal. 11 (1990) 134) with path compression.
std::vector<int> elimination_tree(const std::vector<std::vector<int>>& earlier) {
  std::vector<int> parent(earlier.size(), -1);
  std::vector<int> ancestor(earlier.size(), -1);
  for (int column = 0; column < static_cast<int>(earlier.size()); ++column) {
    for (int node : earlier[static_cast<std::size_t>(column)]) {
      while (node != -1 && node != column) {
        const auto at = static_cast<std::size_t>(node);
        const int next = ancestor[at];
        ancestor[at] = column;
        if (next == -1) parent[at] = column;
        node = next;
      }
    }
  }
  return parent;
}

// Postorder: children come before their parents, and every subtree is contiguous.
std::vector<int> postorder(const std::vector<int>& parent) {
  const auto n = static_cast<int>(parent.size());
  std::vector<std::vector<int>> children(parent.size());
  std::vector<int> stack;
  for (int node = n - 1; node >= 0; --node) {
    const int up = parent[static_cast<std::size_t>(node)];
    if (up >= 0)
      children[static_cast<std::size_t>(up)].push_back(node);
    else
      stack.push_back(node);
  }
  std::vector<int> place(parent.size());
  int next = n;
  while (!stack.empty()) {  // parents first, numbered from the end
    const int node = stack.back();
    stack.pop_back();
    place[static_cast<std::size_t>(node)] = --next;
    const auto& below = children[static_cast<std::size_t>(node)];
    stack.insert(stack.end(), below.begin(), below.end());
  }
  return place;
}

// Positions below the diagonal of each column of L: the matrix's own and those from its children.
std::vector<std::vector<int>> factor_columns(const std::vector<std::vector<int>>& earlier,
                                             const std::vector<int>& parent) {
  const std::size_t n = earlier.size();
  std::vector<std::vector<int>> columns(n);
  for (std::size_t row = 0; row < n; ++row) {
    for (const int column : earlier[row])
      columns[static_cast<std::size_t>(column)].push_back(static_cast<int>(row));
  }
  std::vector<std::vector<int>> children(n);
  std::vector<int> seen(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    const int own = static_cast<int>(j);
    std::vector<int> rows;
    const auto add = [&](int row) {
      int& mark = seen[static_cast<std::size_t>(row)];
      if (row == own || mark == own) return;
      mark = own;
      rows.push_back(row);
    };
    for (const int row : columns[j]) add(row);
    for (const int child : children[j]) {
      for (const int row : columns[static_cast<std::size_t>(child)]) add(row);
    }
    std::sort(rows.begin(), rows.end());
    columns[j] = std::move(rows);
    if (parent[j] >= 0) children[static_cast<std::size_t>(parent[j])].push_back(own);
  }
  return columns;
}

// Consecutive places that are eliminated together.
struct Run {
  int first = 0, count = 0;   // places
  std::vector<int> rows;      // places below
  double columns = 0.0;       // unknowns in it
  double below = 0.0;         // unknowns below it
  double true_entries = 0.0;  // of L, without the zeros that merging stores
};

double entries_of(double columns, double below) {
  return columns * (0.5 * (columns + 1.0) + below);
}

// Whether a child block may be merged with the parent block that follows it.
bool may_join(const Run& child, const Run& up) {
  const bool is_child = !child.rows.empty() && child.rows.front() >= up.first &&
                        child.rows.front() < up.first + up.count;
  if (!is_child) return false;
  const double columns = child.columns + up.columns;
  const double zeros = 1.0 - (child.true_entries + up.true_entries) / entries_of(columns, up.below);
  const bool is_small = std::min(child.columns, up.columns) <= kSmallBlock;
  return zeros <= (is_small ? kZerosInSmall : kZerosInLarge);
}

std::vector<Run> runs_of(const std::vector<std::vector<int>>& columns,
                         const std::vector<int>& size_at) {
  std::vector<Run> runs;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    Run run{static_cast<int>(j), 1, columns[j], static_cast<double>(size_at[j]), 0.0, 0.0};
    for (const int row : columns[j]) run.below += size_at[static_cast<std::size_t>(row)];
    run.true_entries = entries_of(run.columns, run.below);
    while (!runs.empty() && may_join(runs.back(), run)) {
      const Run& child = runs.back();
      run.first = child.first;
      run.count += child.count;
      run.columns += child.columns;
      run.true_entries += child.true_entries;
      runs.pop_back();
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

BlockOrder block_order(const Sparse& lower) {
  BlockOrder order;
  const Groups groups = groups_of(lower);
  std::vector<int> place = minimum_degree_places(groups);
  const std::vector<int> post = postorder(elimination_tree(earlier_neighbours(groups, place)));
  for (int& at : place) at = post[static_cast<std::size_t>(at)];
  const auto earlier = earlier_neighbours(groups, place);
  std::vector<int> size_at(place.size());
  for (std::size_t g = 0; g < place.size(); ++g)
    size_at[static_cast<std::size_t>(place[g])] = groups.size[g];
  std::vector<int> first(place.size() + 1, 0);  // unknown of each place
  std::partial_sum(size_at.begin(), size_at.end(), first.begin() + 1);
  for (const Run& run : runs_of(factor_columns(earlier, elimination_tree(earlier)), size_at)) {
    ColumnBlock block;
    block.first = first[static_cast<std::size_t>(run.first)];
    block.count = first[static_cast<std::size_t>(run.first + run.count)] - block.first;
    for (const int row : run.rows) {
      const auto at = static_cast<std::size_t>(row);
      for (int i = first[at]; i < first[at + 1]; ++i) block.rows.push_back(i);
    }
    order.blocks.push_back(std::move(block));
  }
  order.position.resize(groups.of.size());
  for (std::size_t i = 0; i < order.position.size(); ++i)
    order.position[i] =
        first[static_cast<std::size_t>(place[static_cast<std::size_t>(groups.of[i])])]++;
  return order;
}

}  // namespace viscard
