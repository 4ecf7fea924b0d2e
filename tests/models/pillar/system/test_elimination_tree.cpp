// The pattern of a factor against elimination one column at a time.
#include "models/pillar/system/elimination_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

using namespace viscard;

namespace {

using Sets = std::vector<std::set<int>>;

// The rows below the diagonal of each column of a random symmetric matrix.
Sets random_columns(int n, int per_column, unsigned seed) {
  std::mt19937 random(seed);
  Sets columns(static_cast<std::size_t>(n));
  for (int i = 0; i < n * per_column; ++i) {
    const auto a = static_cast<int>(random() % static_cast<unsigned>(n));
    const auto b = static_cast<int>(random() % static_cast<unsigned>(n));
    if (a != b) columns[static_cast<std::size_t>(std::min(a, b))].insert(std::max(a, b));
  }
  return columns;
}

IndexLists lists_of(const Sets& sets) {
  IndexLists lists;
  for (const std::set<int>& one : sets) {
    lists.number.insert(lists.number.end(), one.begin(), one.end());
    lists.end_item();
  }
  return lists;
}

Sets sets_of(const IndexLists& lists) {
  Sets sets;
  for (int i = 0; i < lists.count(); ++i) sets.emplace_back(lists.of(i).begin(), lists.of(i).end());
  return sets;
}

// Eliminating a column joins all rows below it with each other.
Sets filled(Sets columns) {
  for (const std::set<int>& rows : columns) {
    for (const int row : rows) {
      for (const int other : rows) {
        if (other > row) columns[static_cast<std::size_t>(row)].insert(other);
      }
    }
  }
  return columns;
}

}  // namespace

TEST_CASE("the columns of a factor are those of elimination one column at a time",
          "[models][pillar]") {
  const int per_column = GENERATE(0, 1, 2, 5);
  const unsigned seed = GENERATE(range(1U, 6U));
  const Sets columns = random_columns(60, per_column, seed);
  const IndexLists earlier = transposed(lists_of(columns));
  const std::vector<int> parent = elimination_tree(earlier);
  const Sets exact = filled(columns);
  for (std::size_t j = 0; j < exact.size(); ++j) {
    CAPTURE(per_column, seed, j);
    CHECK(parent[j] == (exact[j].empty() ? -1 : *exact[j].begin()));
  }
  const IndexLists found = factor_columns(earlier, parent);
  CHECK(sets_of(found) == exact);
  for (int j = 0; j < found.count(); ++j) {
    CHECK(std::is_sorted(found.of(j).begin(), found.of(j).end()));
    CHECK(found.of(j).size() == exact[static_cast<std::size_t>(j)].size());
  }
}

TEST_CASE("in postorder a node follows its descendants, which are next to each other",
          "[models][pillar]") {
  const Sets columns = random_columns(80, 1, 7);
  const std::vector<int> parent = elimination_tree(transposed(lists_of(columns)));
  const std::vector<int> place = postorder(parent);
  CHECK(std::set<int>(place.begin(), place.end()).size() == parent.size());
  std::vector<int> descendants(parent.size(), 0), first(place);
  for (std::size_t node = 0; node < parent.size(); ++node) {  // children have lower numbers
    if (parent[node] < 0) continue;
    const auto up = static_cast<std::size_t>(parent[node]);
    CHECK(place[node] < place[up]);
    descendants[up] += descendants[node] + 1;
    first[up] = std::min(first[up], first[node]);
  }
  for (std::size_t node = 0; node < parent.size(); ++node) {
    CHECK(first[node] == place[node] - descendants[node]);
  }
}

TEST_CASE("transposing lists twice sorts them", "[models][pillar]") {
  const IndexLists lists{{0, 3, 3, 4}, {2, 0, 1, 0}};
  const IndexLists back = transposed(transposed(lists));
  CHECK(back.start == lists.start);
  CHECK(back.number == std::vector<int>{0, 1, 2, 0});
}
