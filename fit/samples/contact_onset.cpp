#include "fit/samples/contact_onset.h"

#include "fit/samples/clean_data.h"
#include "fit/samples/median.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// Times and forces of a part of the record.
struct Stretch {
  std::vector<double> time_s, force_N;
  std::size_t size() const { return time_s.size(); }
};

Stretch stretch(const IndentationData& data, double from_s, double to_s) {
  Stretch part;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < from_s || data.time_s[i] > to_s) continue;
    part.time_s.push_back(data.time_s[i]);
    part.force_N.push_back(data.force_N[i]);
  }
  return part;
}

// Sum of squares about the straight line through a stretch.
double scatter_about_line(const Stretch& part) {
  const auto n = static_cast<double>(part.size());
  double mean_t = 0.0, mean_f = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    mean_t += part.time_s[i] / n;
    mean_f += part.force_N[i] / n;
  }
  double tt = 0.0, tf = 0.0, ff = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const double t = part.time_s[i] - mean_t, f = part.force_N[i] - mean_f;
    tt += t * t;
    tf += t * f;
    ff += f * f;
  }
  return tt > 0.0 ? std::max(0.0, ff - tf * tf / tt) : 0.0;
}

// Smallest non-zero difference between neighbours: at most the converter's step.
double smallest_step_N(const std::vector<double>& force_N) {
  double step_N = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < force_N.size(); ++i) {
    const double difference_N = std::abs(force_N[i] - force_N[i - 1]);
    if (difference_N > 0.0) step_N = std::min(step_N, difference_N);
  }
  return std::isfinite(step_N) ? step_N : 0.0;
}

// Samples near the first move, thinned to a few hundred, with the forces as recorded.
Stretch around_first_move(const IndentationData& data, double margin_s) {
  const StageMove& ramp = data.moves.front();
  const double from_s = ramp.start_time_s - data.start_early_s - margin_s;
  double to_s = ramp.start_time_s + duration_s(ramp) + data.start_late_s + margin_s;
  if (data.moves.size() > 1) to_s = std::min(to_s, data.moves[1].start_time_s - data.start_early_s);
  const Stretch all = stretch(data, from_s, std::min(to_s, data.contact_to_s));
  constexpr std::size_t kEnough = 400;
  const std::size_t every = 1 + all.size() / kEnough;
  Stretch part;
  for (std::size_t i = all.size() % every; i < all.size(); i += every) {
    part.time_s.push_back(all.time_s[i]);
    part.force_N.push_back(all.force_N[i]);
  }
  return part;
}

class GapSearch {
 public:
  GapSearch(const StageMove& ramp, Stretch part)
      : ramp_(ramp), part_(std::move(part)), sign_(ramp.to_m >= ramp.from_m ? 1.0 : -1.0) {}

  struct Box {
    double shift_low_s, shift_high_s, gap_low_m, gap_high_m;
  };

  // The best point of a grid over the box, then of ever smaller boxes around it.
  ContactOnset best_in(const Box& whole) {
    Box box = whole;
    for (int round = 0; round < kRounds; ++round) {
      const double shift_step_s = (box.shift_high_s - box.shift_low_s) / kShifts;
      const double gap_step_m = (box.gap_high_m - box.gap_low_m) / kGaps;
      for (int i = 0; i <= kShifts; ++i) set_row(box.shift_low_s + i * shift_step_s, box);
      box = {std::max(whole.shift_low_s, best_shift_s_ - 2.0 * shift_step_s),
             std::min(whole.shift_high_s, best_shift_s_ + 2.0 * shift_step_s),
             std::max(whole.gap_low_m, best_gap_m_ - 2.0 * gap_step_m),
             std::min(whole.gap_high_m, best_gap_m_ + 2.0 * gap_step_m)};
    }
    return {best_shift_s_, ramp_.from_m + sign_ * best_gap_m_};
  }

 private:
  static constexpr int kRounds = 6, kShifts = 24, kGaps = 40;

  void set_row(double shift_s, const Box& box) {
    std::vector<double> way_m;
    way_m.reserve(part_.size());
    for (const double t : part_.time_s) {
      way_m.push_back(sign_ * (position_m(ramp_, t - shift_s) - ramp_.from_m));
    }
    for (int j = 0; j <= kGaps; ++j) {
      const double gap_m = box.gap_low_m + (box.gap_high_m - box.gap_low_m) * j / kGaps;
      double dd = 0.0, df = 0.0;
      for (std::size_t i = 0; i < part_.size(); ++i) {
        const double depth_m = std::max(0.0, way_m[i] - gap_m);
        dd += depth_m * depth_m;
        df += depth_m * part_.force_N[i];
      }
      // Part of the sum of squares that the spring explains.
      const double gain = dd > 0.0 && df > 0.0 ? df * df / dd : 0.0;
      if (!(gain > best_gain_)) continue;
      best_gain_ = gain;
      best_shift_s_ = shift_s;
      best_gap_m_ = gap_m;
    }
  }

  StageMove ramp_;
  Stretch part_;
  double sign_ = 1.0;
  double best_gain_ = -1.0;
  double best_shift_s_ = 0.0, best_gap_m_ = 0.0;
};

}  // namespace

QuietForce quiet_force(const IndentationData& data) {
  constexpr std::size_t kLeast = 5;
  QuietForce quiet;
  const Stretch before = stretch(data, -1e300, data.contact_from_s);
  const Stretch after = stretch(data, data.contact_to_s, 1e300);
  double squares = 0.0, freedom = 0.0;
  for (const Stretch* part : {&before, &after}) {
    if (part->size() < kLeast) continue;
    squares += scatter_about_line(*part);
    freedom += static_cast<double>(part->size()) - 2.0;
    quiet.n += part->size();
  }
  if (before.size() > 0) quiet.before_N = median(before.force_N);
  quiet.after_N = after.size() >= kLeast ? median(after.force_N) : quiet.before_N;
  if (freedom > 0.0) quiet.sigma_N = std::sqrt(squares / freedom);
  quiet.sigma_N = std::max(quiet.sigma_N, smallest_step_N(data.force_N) / std::sqrt(12.0));
  return quiet;
}

ContactOnset contact_onset(const IndentationData& data) {
  const StageMove& ramp = data.moves.front();
  const double margin_s = std::max(5.0 * usual_step_s(data.time_s), 0.02 * duration_s(ramp));
  Stretch part = around_first_move(data, margin_s);
  const QuietForce quiet = quiet_force(data);
  for (double& force_N : part.force_N) force_N -= quiet.before_N;
  const double end_s = ramp.start_time_s + duration_s(ramp) + data.start_late_s;
  const Stretch peak = stretch(data, end_s, end_s + margin_s);
  const double peak_N = peak.size() > 0 ? median(peak.force_N) - quiet.before_N : 0.0;
  if (!(peak_N > 3.0 * quiet.sigma_N)) {
    throw std::runtime_error("the force does not rise with the ramp (peak " + text_of(peak_N) +
                             " N). Check the sign of the load cell and that the punch touched");
  }
  const double way_m = std::abs(ramp.to_m - ramp.from_m);
  constexpr double kLatest = 0.99;  // share of the move; contact at its end leaves no ramp
  GapSearch search(ramp, std::move(part));
  return search.best_in(
      {-data.start_early_s - margin_s, data.start_late_s + margin_s, 0.0, kLatest * way_m});
}

std::optional<std::size_t> first_lifting_move(const IndentationData& data) {
  constexpr std::size_t kBlock = 8;      // readings; enough for a mean to compare
  constexpr double kSigmas = 3.0;        // standard errors of that mean
  constexpr double kShareOfPeak = 5e-3;  // allowance for drift and creep of the load cell
  const QuietForce quiet = quiet_force(data);
  if (quiet.n == 0) return std::nullopt;
  double peak_N = 0.0;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    peak_N = std::max(peak_N, data.force_N[i] - quiet.before_N);
  }
  const double low_N = std::min(quiet.before_N, quiet.after_N);
  const double high_N = std::max(quiet.before_N, quiet.after_N);
  const double margin_N = std::max(kSigmas * quiet.sigma_N / std::sqrt(static_cast<double>(kBlock)),
                                   kShareOfPeak * peak_N);
  for (std::size_t m = 1; m < data.moves.size(); ++m) {
    const double from_s =
        data.moves[m].start_time_s + duration_s(data.moves[m]) + data.start_late_s;
    const double to_s = m + 1 < data.moves.size()
                            ? data.moves[m + 1].start_time_s - data.start_early_s
                            : data.contact_to_s;
    const Stretch rest = stretch(data, from_s, to_s);
    for (std::size_t i = 0; i + kBlock <= rest.size(); i += kBlock) {
      double mean_N = 0.0;
      for (std::size_t j = i; j < i + kBlock; ++j) mean_N += rest.force_N[j] / kBlock;
      if (mean_N > low_N - margin_N && mean_N < high_N + margin_N) return m;
    }
  }
  return std::nullopt;
}

IndentationData before_move(IndentationData data, std::size_t move) {
  const double cut_s = data.moves[move].start_time_s - data.start_early_s;
  std::vector<double> time_s, force_N;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] > cut_s && data.time_s[i] <= data.contact_to_s) continue;
    time_s.push_back(data.time_s[i]);
    force_N.push_back(data.force_N[i]);
  }
  data.time_s = std::move(time_s);
  data.force_N = std::move(force_N);
  data.contact_to_s = cut_s;
  data.moves.resize(move);
  return data;
}

}  // namespace viscard
