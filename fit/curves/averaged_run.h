#pragma once

#include "fit/samples/fit_data.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// Readings of a long captured run, averaged where the stage has rested for a while or the punch is out of
// contact. A row of one reading is that reading.
//
// In a hold an average extends over at most 1 % of the time since the last move. The mean of exp(-t/tau)
// over it differs from the value at its mean time by at most 0.54/24 of the square of that share, 2.3e-6,
// of the term's force (t^2/tau^2 exp(-t/tau) is at most 0.54). Out of contact the force is a straight line.
struct AveragedRun {
  IndentationData rows;             // time_s and force_N of the rows; everything else as it was
  std::vector<std::size_t> begins;  // first reading of each row, and one past the last
  // Of each row: mean of (t - mean t)^2, of (F - mean F)^2 and of their product.
  Eigen::VectorXd time_square, force_square, product;

  // True if any row has more than one reading.
  bool has_averages() const { return begins.size() < n_readings() + 1; }
  std::size_t n_readings() const { return begins.empty() ? 0 : begins.back(); }
  // Number of readings of a row.
  double count(Eigen::Index row) const {
    const auto at = static_cast<std::size_t>(row);
    return static_cast<double>(begins[at + 1] - begins[at]);
  }
};

// Readings must be in order of time. Runs of up to kSmallRecord readings, and with full_data all, stay as
// they are.
AveragedRun averaged_run(const IndentationData& data, bool full_data);

}  // namespace viscard
