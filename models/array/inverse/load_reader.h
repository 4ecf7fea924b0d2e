#pragma once

#include "models/array/inverse/choose_weight.h"
#include "models/array/inverse/read_array.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace viscard {

// Voltages of frames x places x readings, where a place may be without a pillar.
struct VoltageFrames {
  const double* voltages_V = nullptr;
  std::size_t count = 0;
};

// Loads of the pillars of an array from frames of voltages, each with its 95 % interval.
class LoadReader {
 public:
  // place_of: the place of each pillar in a frame; examples: frames for the choice of the weight.
  LoadReader(ReadArray array, std::vector<std::size_t> place_of, std::size_t places,
             const ReadingErrors& errors, const ReadingChoice& choice,
             const VoltageFrames& examples);
  LoadReader(LoadReader&&) noexcept;
  LoadReader& operator=(LoadReader&&) noexcept;
  ~LoadReader();

  // Loads and half widths of their intervals (eq. I2, I3), frames x places x loads, NaN where no pillar stands.
  // Readings that do not work are not looked at; the others must be finite.
  void read(const VoltageFrames& frames, double* loads_Pa, double* half_widths_Pa) const;

  const ReadArray& array() const;
  const std::vector<std::size_t>& place_of() const;
  std::size_t places() const;
  const Regularisation& regularisation() const;
  double pitch_m() const;
  // Largest singular value of the readings over the smallest one, of the commonest surroundings.
  double condition() const;
  // By pillar, then load: the share of its own load in an estimate, and how far away a load counts half as much
  // (eq. I6); infinite where another load counts more than its own.
  const std::vector<double>& own_share() const;
  const std::vector<double>& resolution_m() const;
  // Whether an estimate is that of its own load rather than of its neighbours' or of the penalty.
  bool is_resolved(std::size_t pillar, Eigen::Index load) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace viscard
