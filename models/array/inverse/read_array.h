#pragma once

#include "models/maths/offset_sums.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace viscard {

// Pillars whose loads are to be found from the voltages that are read under them.
struct ReadArray {
  std::vector<SourcePoint> pillars;  // their kind is the class
  int classes = 1;
  Eigen::Index readings = 1;  // under each pillar
  Eigen::Index loads = 1;     // on each top, to be found
  double reach_m = 0.0;       // between axes, beyond which a load is not read
  // Readings at an offset from a loaded pillar, V/Pa: readings x loads, first those to be found, then those that
  // disturb them.
  OffsetSums::Kernel kernel;
  // By pillar, then reading; empty: all work.
  std::vector<std::uint8_t> works;

  bool does_work(std::size_t pillar, Eigen::Index reading) const {
    return works.empty() ||
           works[pillar * static_cast<std::size_t>(readings) + static_cast<std::size_t>(reading)] !=
               0;
  }
};

// Typical distance of a pillar from its nearest one, the median; the reach for a single pillar.
double usual_pitch_m(const ReadArray& array);

// An offset in units that only rounding does not tell apart, along x and y.
struct WholeOffset {
  std::int32_t x = 0, y = 0;
  std::uint64_t key() const {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) |
           static_cast<std::uint32_t>(y);
  }
  std::int64_t square() const {
    return static_cast<std::int64_t>(x) * x + static_cast<std::int64_t>(y) * y;
  }
};
WholeOffset whole_offset(const ReadArray& array, std::size_t from, std::size_t to, double pitch_m);

// The kernels of an array by offset, each asked for once. The array must outlive them.
class OffsetKernels {
 public:
  explicit OffsetKernels(const ReadArray& array);

  // Readings of the pillar `to` per load on the pillar `from`; null beyond the reach.
  const Eigen::MatrixXd* between(std::size_t from, std::size_t to);
  // Mean square of the gains of a lone pillar of the first class, (V/Pa)^2: the unit of weights (eq. I1).
  double scale_V2_Pa2() const { return scale_V2_Pa2_; }
  double pitch_m() const { return pitch_m_; }
  const ReadArray& array() const { return *array_; }

 private:
  const ReadArray* array_;
  double pitch_m_ = 0.0, scale_V2_Pa2_ = 0.0;
  std::vector<std::unordered_map<std::uint64_t, Eigen::MatrixXd>> of_class_;
};

}  // namespace viscard
