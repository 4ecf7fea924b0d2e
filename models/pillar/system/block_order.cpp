#include "models/pillar/system/block_order.h"

#include "models/pillar/system/elimination_tree.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <random>
#include <span>
#include <unordered_map>

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
  std::vector<int> of;    // unknown -> group
  std::vector<int> size;  // unknowns in each
  IndexLists neighbours;  // other groups, ascending
};

// A sum of random keys over each unknown and its neighbours. Two sums are equal if the two
// neighbourhoods are equal, and otherwise only with a probability of 2^-64.
std::vector<std::uint64_t> neighbourhood_sums(const Sparse& lower) {
  std::vector<std::uint64_t> key(static_cast<std::size_t>(lower.rows()));
  std::mt19937_64 random(1);
  for (std::uint64_t& k : key) k = random();
  std::vector<std::uint64_t> sum = key;
  for (int column = 0; column < lower.outerSize(); ++column) {
    const std::uint64_t own_key = key[static_cast<std::size_t>(column)];
    std::uint64_t own_sum = 0;
    for (Sparse::InnerIterator it(lower, column); it; ++it) {
      if (it.row() == column) continue;
      own_sum += key[static_cast<std::size_t>(it.row())];
      sum[static_cast<std::size_t>(it.row())] += own_key;
    }
    sum[static_cast<std::size_t>(column)] += own_sum;
  }
  return sum;
}

// Links every group with the groups of the neighbours of one of its unknowns.
IndexLists neighbours_of(const Sparse& lower, const std::vector<int>& member,
                         const std::vector<int>& group_of) {
  IndexLists below;                          // groups that the column of the unknown meets
  std::vector<int> seen(member.size(), -1);  // the last group that was linked with this one
  for (std::size_t g = 0; g < member.size(); ++g) {
    const auto own = static_cast<int>(g);
    seen[g] = own;
    for (Sparse::InnerIterator it(lower, member[g]); it; ++it) {
      const int other = group_of[static_cast<std::size_t>(it.row())];
      int& mark = seen[static_cast<std::size_t>(other)];
      if (mark == own) continue;
      mark = own;
      below.number.push_back(other);
    }
    below.end_item();
  }
  const IndexLists above = transposed(below);
  below = transposed(above);  // ascending now
  IndexLists both;
  for (int g = 0; g < below.count(); ++g) {
    std::ranges::set_union(above.of(g), below.of(g), std::back_inserter(both.number));
    both.end_item();
  }
  return both;
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
  groups.neighbours = neighbours_of(lower, member, groups.of);
  return groups;
}

// The position of each group in the elimination order.
std::vector<int> minimum_degree_places(const Groups& groups) {
  const int n = groups.neighbours.count();
  IndexLists lower;
  for (int g = 0; g < n; ++g) {
    lower.number.push_back(g);
    const std::span<const int> all = groups.neighbours.of(g);
    lower.number.insert(lower.number.end(), std::ranges::lower_bound(all, g), all.end());
    lower.end_item();
  }
  const std::vector<double> ones(lower.number.size(), 1.0);
  const Eigen::Map<const Sparse> pattern(n, n, static_cast<int>(lower.number.size()),
                                         lower.start.data(), lower.number.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), permutation);
  std::vector<int> place(groups.size.size());
  for (int i = 0; i < n; ++i) place[static_cast<std::size_t>(permutation.indices()[i])] = i;
  return place;
}

// For each position, the positions of its neighbours that are eliminated earlier.
IndexLists earlier_neighbours(const Groups& groups, const std::vector<int>& place) {
  std::vector<int> group_at(place.size());
  for (std::size_t g = 0; g < place.size(); ++g)
    group_at[static_cast<std::size_t>(place[g])] = static_cast<int>(g);
  IndexLists earlier;
  for (int at = 0; at < static_cast<int>(place.size()); ++at) {
    for (const int other : groups.neighbours.of(group_at[static_cast<std::size_t>(at)])) {
      if (place[static_cast<std::size_t>(other)] < at)
        earlier.number.push_back(place[static_cast<std::size_t>(other)]);
    }
    earlier.end_item();
  }
  return earlier;
}

// Consecutive places that are eliminated together.
struct Run {
  int first = 0, count = 0;   // places
  std::span<const int> rows;  // places below
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

// Their rows are in `columns`.
std::vector<Run> runs_of(const IndexLists& columns, const std::vector<int>& size_at) {
  std::vector<Run> runs;
  for (int j = 0; j < columns.count(); ++j) {
    Run run{j,   1,  columns.of(j), static_cast<double>(size_at[static_cast<std::size_t>(j)]),
            0.0, 0.0};
    for (const int row : run.rows) run.below += size_at[static_cast<std::size_t>(row)];
    run.true_entries = entries_of(run.columns, run.below);
    while (!runs.empty() && may_join(runs.back(), run)) {
      const Run& child = runs.back();
      run.first = child.first;
      run.count += child.count;
      run.columns += child.columns;
      run.true_entries += child.true_entries;
      runs.pop_back();
    }
    runs.push_back(run);
  }
  return runs;
}

}  // namespace

BlockOrder block_order(const Sparse& lower) {
  BlockOrder order;
  const Groups groups = groups_of(lower);
  std::vector<int> place = minimum_degree_places(groups);
  const std::vector<int> tree = elimination_tree(earlier_neighbours(groups, place));
  const std::vector<int> post = postorder(tree);
  for (int& at : place) at = post[static_cast<std::size_t>(at)];
  std::vector<int> parent(tree.size(), -1);  // the same tree with the new numbers
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i] >= 0)
      parent[static_cast<std::size_t>(post[i])] = post[static_cast<std::size_t>(tree[i])];
  }
  std::vector<int> size_at(place.size());
  for (std::size_t g = 0; g < place.size(); ++g)
    size_at[static_cast<std::size_t>(place[g])] = groups.size[g];
  std::vector<int> first(place.size() + 1, 0);  // unknown of each place
  std::partial_sum(size_at.begin(), size_at.end(), first.begin() + 1);
  const IndexLists columns = factor_columns(earlier_neighbours(groups, place), parent);
  for (const Run& run : runs_of(columns, size_at)) {
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
