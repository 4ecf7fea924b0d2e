#pragma once

#include "models/array/inverse/pillar_patches.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace viscard {

// Sums over the readings around each pillar, with the same coefficients for all pillars of a kind, for kLanes frames
// at a time (models/maths/wide_loops.h): values stand by pillar, then reading or output, then frame.
class StencilSums {
 public:
  // Coefficients by kind: outputs x (readings of the patch, pillar by pillar); empty: left out. Far pillars whose
  // coefficients together are at most `left_out` of all are not summed. The patches must outlive this.
  StencilSums(const PillarPatches& patches, Eigen::Index readings, Eigen::Index outputs,
              const std::vector<Eigen::MatrixXd>& of_kind, double left_out);
  StencilSums(const StencilSums&) = delete;
  StencilSums& operator=(const StencilSums&) = delete;
  StencilSums(StencilSums&&) = default;
  StencilSums& operator=(StencilSums&&) = default;
  ~StencilSums() = default;

  // Leaves outputs of kinds without coefficients as they are.
  void apply(const double* values, double* sums) const;

  struct Row {
    const double* numbers = nullptr;  // by pillar of the patch, then output, then reading
    const std::uint32_t* around = nullptr;
    std::size_t pillars = 0;
  };

 private:
  Eigen::Index readings_, outputs_;
  std::vector<double> numbers_;
  std::vector<Row> rows_;  // by pillar
};

}  // namespace viscard
