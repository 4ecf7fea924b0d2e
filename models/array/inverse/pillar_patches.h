#pragma once

#include "models/array/inverse/read_array.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace viscard {

// The pillars around each pillar up to a distance, from near to far, itself first. Pillars whose surroundings are alike,
// working electrodes included, are of one kind, so that what is solved for one of them holds for all.
class PillarPatches {
 public:
  PillarPatches(const ReadArray& array, double pitch_m, double radius_m);

  std::size_t pillars() const { return kind_.size(); }
  std::span<const std::uint32_t> around(std::size_t pillar) const {
    return {members_.data() + first_[pillar], members_.data() + first_[pillar + 1]};
  }
  std::size_t kinds() const { return example_.size(); }
  std::uint32_t kind_of(std::size_t pillar) const { return kind_[pillar]; }
  std::size_t example(std::size_t kind) const { return example_[kind]; }  // a pillar of the kind
  std::size_t count(std::size_t kind) const { return count_[kind]; }      // pillars of the kind
  // Kinds by falling count.
  std::vector<std::size_t> commonest() const;

 private:
  std::vector<std::uint32_t> members_, kind_;
  std::vector<std::size_t> first_, example_, count_;
};

}  // namespace viscard
