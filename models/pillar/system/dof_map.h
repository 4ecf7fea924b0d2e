#pragma once

#include <cstddef>
#include <vector>

namespace viscard {

// Maps each field at each node to its unknown: -1 if it is held at zero, and a shared number if
// several are tied together (a rigid plate, an electrode).
class DofMap {
 public:
  DofMap(int field_count, int node_count);
  // Holds a field at a node at zero.
  void fix(int field, int node);
  // Ties one field at several nodes to one unknown; returns a handle for tied_dof().
  int tie(int field, const std::vector<int>& nodes);
  void number();  // call once, after all other changes

  // Number of the unknown of a field at a node, or -1.
  int dof(int field, int node) const { return dof_[index(field, node)]; }
  // Number of the unknown of tie()'s handle.
  int tied_dof(int handle) const { return tied_[static_cast<std::size_t>(handle)]; }
  int count() const { return count_; }
  int field_count() const { return field_count_; }
  // The same unknowns at the same nodes, so that vectors of one fit the other.
  bool operator==(const DofMap&) const = default;

 private:
  std::size_t index(int field, int node) const {
    return static_cast<std::size_t>(node * field_count_ + field);
  }
  int field_count_;
  int count_ = 0;
  std::vector<int> dof_;   // node slowest; before number(): 0 free, -1 fixed, -2 - handle tied
  std::vector<int> tied_;  // per handle
};

}  // namespace viscard
