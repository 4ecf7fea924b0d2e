#include "fit/curves/averaged_run.h"

#include "fit/samples/clean_data.h"
#include "fit/samples/log_bins.h"

#include <algorithm>
#include <limits>

namespace viscard {
namespace {

// When the next average may begin and how long it may be, by the moves of the run.
class RestingTimes {
 public:
  RestingTimes(const IndentationData& data, double step_s) : data_(data) {
    // A move may start as early and as late as the clocks allow, and its start is searched within ten
    // readings about the first guess.
    early_s_ = data.start_early_s + kSearched * step_s;
    late_s_ = data.start_late_s + kSearched * step_s;
    const auto first_s = data.time_s.front(), last_s = data.time_s.back();
    before_s_ = kShareOutside * std::max(0.0, data.contact_from_s - first_s);
    after_s_ = kShareOutside * std::max(0.0, last_s - data.contact_to_s);
  }

  // The latest time of a reading in the same row as one at t; t if that stays alone.
  double end_s(double t) const {
    if (t > data_.contact_to_s) return t + after_s_;
    double end_s = t < data_.contact_from_s ? t + before_s_ : data_.contact_to_s;
    double rested_s = -1.0;
    for (const StageMove& move : data_.moves) {
      const double from_s = move.start_time_s - early_s_;
      const double to_s = move.start_time_s + duration_s(move) + late_s_;
      if (t >= to_s) {
        rested_s = t - to_s;
      } else if (t >= from_s) {
        return t;
      } else {
        end_s = std::min(end_s, from_s);
        break;
      }
    }
    if (t < data_.contact_from_s) return end_s;
    return rested_s > 0.0 ? std::min(end_s, t + kShare * rested_s) : t;
  }

 private:
  static constexpr double kSearched = 10.0, kShare = 0.01;
  static constexpr double kShareOutside = 0.02;  // of all time out of contact before, or after
  const IndentationData& data_;
  double early_s_ = 0.0, late_s_ = 0.0, before_s_ = 0.0, after_s_ = 0.0;
};

}  // namespace

AveragedRun averaged_run(const IndentationData& data, bool full_data) {
  const std::size_t n = data.time_s.size();
  const bool is_small = n <= kSmallRecord || full_data || data.moves.empty();
  std::vector<std::size_t> begins;
  if (is_small) {
    for (std::size_t i = 0; i <= n; ++i) begins.push_back(i);
  } else {
    const RestingTimes resting(data, usual_step_s(data.time_s));
    for (std::size_t begin = 0; begin < n;) {
      begins.push_back(begin);
      const double end_s = resting.end_s(data.time_s[begin]);
      std::size_t end = begin + 1;
      const bool is_before = data.time_s[begin] < data.contact_from_s;
      const bool is_after = data.time_s[begin] > data.contact_to_s;
      while (end < n && data.time_s[end] < end_s &&
             (data.time_s[end] < data.contact_from_s) == is_before &&
             (data.time_s[end] > data.contact_to_s) == is_after) {
        ++end;
      }
      begin = end;
    }
    begins.push_back(n);
  }
  AveragedRun run;
  const auto n_rows = static_cast<Eigen::Index>(begins.size()) - 1;
  run.time_square = run.force_square = run.product = Eigen::VectorXd::Zero(n_rows);
  std::vector<double> time_s, force_N;
  for (Eigen::Index row = 0; row < n_rows; ++row) {
    const std::size_t begin = begins[static_cast<std::size_t>(row)];
    const std::size_t end = begins[static_cast<std::size_t>(row) + 1];
    const auto count = static_cast<double>(end - begin);
    double t = 0.0, f = 0.0, tt = 0.0, ff = 0.0, tf = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double since_s = data.time_s[i] - data.time_s[begin];
      const double above_N = data.force_N[i] - data.force_N[begin];
      t += since_s / count;
      f += above_N / count;
      tt += since_s * since_s / count;
      ff += above_N * above_N / count;
      tf += since_s * above_N / count;
    }
    time_s.push_back(data.time_s[begin] + t);
    force_N.push_back(data.force_N[begin] + f);
    if (end - begin < 2) continue;
    run.time_square[row] = std::max(0.0, tt - t * t);
    run.force_square[row] = std::max(0.0, ff - f * f);
    run.product[row] = tf - t * f;
  }
  run.begins = std::move(begins);
  // The other members, without a second copy of the readings.
  run.rows = data;
  run.rows.time_s = std::move(time_s);
  run.rows.force_N = std::move(force_N);
  return run;
}

}  // namespace viscard
