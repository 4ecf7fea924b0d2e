#include "models/pillar/system/dof_map.h"

namespace viscard {
namespace {

constexpr int kFixed = -1;

}  // namespace

DofMap::DofMap(int field_count, int node_count)
    : field_count_(field_count), dof_(static_cast<std::size_t>(field_count * node_count), 0) {}

void DofMap::fix(int field, int node) {
  dof_[index(field, node)] = kFixed;
}

int DofMap::tie(int field, const std::vector<int>& nodes) {
  const int handle = static_cast<int>(tied_.size());
  tied_.push_back(kFixed);
  for (const int node : nodes) dof_[index(field, node)] = kFixed - 1 - handle;
  return handle;
}

void DofMap::number() {
  for (int& dof : dof_) {
    if (dof == kFixed) continue;
    if (dof < kFixed) {
      int& tied = tied_[static_cast<std::size_t>(kFixed - 1 - dof)];
      if (tied == kFixed) tied = count_++;
      dof = tied;
    } else {
      dof = count_++;
    }
  }
}

}  // namespace viscard
