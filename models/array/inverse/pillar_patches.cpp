#include "models/array/inverse/pillar_patches.h"

#include "models/maths/neighbours.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_map>

namespace viscard {
namespace {

struct PatchMember {
  WholeOffset offset;
  std::uint32_t pillar = 0;
};

// What distinguishes surroundings, as bytes.
void append(std::string& key, std::uint32_t value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

PillarPatches::PillarPatches(const ReadArray& array, double pitch_m, double radius_m) {
  const Neighbours near(array.pillars, radius_m);
  std::unordered_map<std::string, std::uint32_t> known;
  first_.push_back(0);
  for (std::size_t i = 0; i < array.pillars.size(); ++i) {
    std::vector<PatchMember> members;
    near.visit(array.pillars[i].x_m, array.pillars[i].y_m, [&](std::size_t j) {
      members.push_back({whole_offset(array, i, j, pitch_m), static_cast<std::uint32_t>(j)});
    });
    std::sort(members.begin(), members.end(), [](const PatchMember& a, const PatchMember& b) {
      return std::tuple(a.offset.square(), a.offset.x, a.offset.y) <
             std::tuple(b.offset.square(), b.offset.x, b.offset.y);
    });
    std::string key;
    for (const PatchMember& one : members) {
      std::uint32_t works = 0;
      for (Eigen::Index r = 0; r < array.readings; ++r) {
        works = 2 * works + (array.does_work(one.pillar, r) ? 1U : 0U);
      }
      append(key, static_cast<std::uint32_t>(one.offset.x));
      append(key, static_cast<std::uint32_t>(one.offset.y));
      append(key, static_cast<std::uint32_t>(array.pillars[one.pillar].kind));
      append(key, works);
      members_.push_back(one.pillar);
    }
    first_.push_back(members_.size());
    const auto [found, is_new] = known.emplace(key, static_cast<std::uint32_t>(example_.size()));
    if (is_new) {
      example_.push_back(i);
      count_.push_back(0);
    }
    kind_.push_back(found->second);
    ++count_[found->second];
  }
}

std::vector<std::size_t> PillarPatches::commonest() const {
  std::vector<std::size_t> kinds(example_.size());
  std::iota(kinds.begin(), kinds.end(), std::size_t{0});
  std::stable_sort(kinds.begin(), kinds.end(),
                   [&](std::size_t a, std::size_t b) { return count_[a] > count_[b]; });
  return kinds;
}

}  // namespace viscard
