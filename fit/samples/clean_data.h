#pragma once

#include "fit/samples/sample_passes.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace viscard {

// Columns ready for a fit: rows with a non-finite value are removed and the others sorted by time,
// the first column (rows of equal time keep their order). A finite and sorted record, as most long
// ones are, is not copied. The input and this object must outlive the views.
class CleanViews {
 public:
  // wrong: rows that are left out as well, ascending. Throws std::invalid_argument if the columns
  // differ in length, and std::runtime_error if fewer than `least` usable rows remain.
  CleanViews(const std::vector<std::span<const double>>& columns, std::size_t least,
             const std::vector<std::size_t>& wrong = {});
  CleanViews(const CleanViews&) = delete;
  CleanViews& operator=(const CleanViews&) = delete;

  std::span<const double> column(std::size_t i) const { return views_[i]; }
  std::size_t n_left_out() const { return n_left_out_; }  // without a number
  const StepRange& steps() const { return steps_; }       // of the first column, s
  void drop_first(std::size_t rows);
  void drop(const std::vector<std::size_t>& rows);  // ascending
  // Replaces the first column by other times of the same rows, in ascending order.
  void set_times(std::vector<double> time_s);
  // Row of the input that has become row i, from 0.
  std::size_t origin(std::size_t i) const { return origin_.empty() ? i + n_first_ : origin_[i]; }

 private:
  std::vector<std::span<const double>> views_;
  std::vector<std::vector<double>> copies_;
  std::vector<double> time_s_;       // of set_times()
  std::vector<std::size_t> origin_;  // empty: the rows of the input from n_first_ on
  std::size_t n_first_ = 0;
  std::size_t n_left_out_ = 0;
  StepRange steps_;
};

// Throws std::runtime_error if the sum of the values is not positive; the message explains how to
// flip the sign of the column. `what` names the quantity that must be positive ("a relaxation
// modulus"), `column` is its name in a table.
void check_sign(std::span<const double> values, const std::string& what, const std::string& column);
// The same for loss moduli, which may be noise about zero: throws if the negative ones outweigh the others three
// times.
void check_loss_sign(std::span<const double> loss_Pa);

// Shortest positive difference of sorted times, apart from single wrong stamps (a step less than a
// fifth of both its neighbours), and their median difference, which a gap does not change. Both
// return 0 if there is none.
double shortest_step_s(std::span<const double> time_s);
double usual_step_s(std::span<const double> time_s);

}  // namespace viscard
