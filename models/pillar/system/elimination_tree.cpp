#include "models/pillar/system/elimination_tree.h"

#include <algorithm>
#include <numeric>

namespace viscard {
namespace {

// The children of each node, descending.
class Children {
 public:
  explicit Children(const std::vector<int>& parent)
      : last_(parent.size(), -1), before_(parent.size(), -1) {
    for (std::size_t node = 0; node < parent.size(); ++node) {
      if (parent[node] < 0) continue;
      int& last = last_[static_cast<std::size_t>(parent[node])];
      before_[node] = last;
      last = static_cast<int>(node);
    }
  }
  int last(int node) const { return last_[static_cast<std::size_t>(node)]; }  // -1: none
  int before(int child) const { return before_[static_cast<std::size_t>(child)]; }

 private:
  std::vector<int> last_, before_;
};

}  // namespace

IndexLists transposed(const IndexLists& lists) {
  IndexLists result;
  result.start.assign(lists.start.size(), 0);
  for (const int number : lists.number) ++result.start[static_cast<std::size_t>(number) + 1];
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<int> next(result.start.begin(), result.start.end() - 1);
  result.number.resize(lists.number.size());
  for (int item = 0; item < lists.count(); ++item) {
    for (const int number : lists.of(item)) {
      int& at = next[static_cast<std::size_t>(number)];
      result.number[static_cast<std::size_t>(at++)] = item;
    }
  }
  return result;
}

std::vector<int> elimination_tree(const IndexLists& earlier) {
  std::vector<int> parent(static_cast<std::size_t>(earlier.count()), -1);
  std::vector<int> ancestor(parent.size(), -1);
  for (int column = 0; column < earlier.count(); ++column) {
    for (int node : earlier.of(column)) {
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

std::vector<int> postorder(const std::vector<int>& parent) {
  const auto n = static_cast<int>(parent.size());
  const Children children(parent);
  std::vector<int> stack;
  for (int node = n - 1; node >= 0; --node) {
    if (parent[static_cast<std::size_t>(node)] < 0) stack.push_back(node);
  }
  std::vector<int> place(parent.size());
  int next = n;
  while (!stack.empty()) {  // parents first, numbered from the end
    const int node = stack.back();
    stack.pop_back();
    place[static_cast<std::size_t>(node)] = --next;
    for (int child = children.last(node); child >= 0; child = children.before(child))
      stack.push_back(child);
  }
  return place;
}

IndexLists factor_columns(const IndexLists& earlier, const std::vector<int>& parent) {
  const IndexLists own_rows = transposed(earlier);
  const Children children(parent);
  IndexLists columns;
  std::vector<int> seen(parent.size(), -1);
  for (int j = 0; j < earlier.count(); ++j) {
    seen[static_cast<std::size_t>(j)] = j;
    const auto add = [&](int row) {
      int& mark = seen[static_cast<std::size_t>(row)];
      if (mark == j) return;
      mark = j;
      columns.number.push_back(row);
    };
    for (int child = children.last(j); child >= 0; child = children.before(child)) {
      const auto at = static_cast<std::size_t>(child);
      for (int i = columns.start[at]; i < columns.start[at + 1]; ++i)
        add(columns.number[static_cast<std::size_t>(i)]);
    }
    for (const int row : own_rows.of(j)) add(row);
    const auto first = columns.number.begin() + columns.start.back();
    if (!std::is_sorted(first, columns.number.end())) std::sort(first, columns.number.end());
    columns.end_item();
  }
  return columns;
}

}  // namespace viscard
