#include "rig/run/spike_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {
namespace {

constexpr std::size_t kSide = 5;    // readings to which a line is fitted
constexpr std::size_t kFirst = 32;  // readings judged together
constexpr std::size_t kRing = 256;  // distances kept
constexpr std::size_t kRenew = 16;  // new distances before the median is computed again
constexpr double kSpikeSigmas = 6.3;
constexpr double kFewMore = 40.0;  // over the number of known distances: added to kSpikeSigmas
// Added for each decade of known distances above kMany: of 2.9 million readings in ten hours noise
// alone would reach 6.3 in one of 50 runs, and 7.0 in one of 1400.
constexpr double kMany = 1e5, kManyMore = 0.5;
constexpr double kPerMedian = 1.4826;  // standard deviation over median of |normal|
// Standard deviation of the distance between a reading and its prediction, over that of one
// reading: for the mean of ten neighbours sqrt(1 + 1/10), for one line sqrt(1 + 1/5 + 9/10).
constexpr double kOfBoth = 1.049;
constexpr double kOfOne = 1.449;
constexpr double kRounded = 0.5;
constexpr double kEarlyOrLate = 0.25;
constexpr double kLikely = 3.0;      // times the noise: neighbours further away are left out
constexpr double kNoisySlope = 1.0;  // per reading, in units of one reading's noise
constexpr double kStaircase = 2.0;   // times the scatter of the neighbours about their line
constexpr double kAtTheEnd = 1.5;    // if only one side is known
constexpr double kTurned = 2.5;      // times the slope, for a corner that may lie between

// Smallest jitter assumed of the device's clock, as a share of the period: a device whose loop is
// a millisecond late now and then has not spoilt a reading.
constexpr double kTimeNoise = 0.02;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

std::vector<std::int64_t> SpikeWatch::take(std::int64_t index, double place, double value) {
  if (!readings_.empty()) {
    const double step = std::abs(value - readings_.back().value);
    if (step > 0.0 && (least_step_ == 0.0 || step < least_step_)) least_step_ = step;
  }
  readings_.push_back({index, place, value, false});
  if (n_learnt_ == 0) {
    if (readings_.size() < kFirst) return {};
    learn_first();
  }
  std::vector<std::int64_t> found = judge_until(readings_.size() - kSide);
  while (next_ > kSide) {
    readings_.pop_front();
    --next_;
  }
  return found;
}

std::vector<std::int64_t> SpikeWatch::finish() {
  if (n_learnt_ == 0 && readings_.size() > 2 * kSide) learn_first();
  return n_learnt_ == 0 ? std::vector<std::int64_t>() : judge_until(readings_.size());
}

std::vector<std::int64_t> SpikeWatch::judge_until(std::size_t end) {
  std::vector<std::int64_t> found;
  for (; next_ < end; ++next_) {
    readings_[next_].is_spike = judge(next_);
    if (readings_[next_].is_spike) found.push_back(readings_[next_].index);
  }
  return found;
}

// The prediction from the readings on one side for the reading at `at`; spikes found before are
// left out. On the side after, readings that depart from the line before are left out, if three
// others do not.
SpikeWatch::Line SpikeWatch::predicted(std::size_t at, int direction, const Line* before) const {
  std::array<std::size_t, kSide> side{};
  std::size_t n = 0;
  for (std::size_t k = 1; k <= kSide; ++k) {
    if (direction < 0 ? k > at : at + k >= readings_.size()) break;
    const std::size_t i = direction < 0 ? at - k : at + k;
    if (!readings_[i].is_spike) side[n++] = i;
  }
  if (before != nullptr && before->is_known && before->scatter <= kLikely * noise()) {
    const auto end = side.begin() + static_cast<std::ptrdiff_t>(n);
    const auto kept = std::stable_partition(
        side.begin(), end, [&](std::size_t i) { return !departs(*before, i, at); });
    if (kept - side.begin() >= 3) n = static_cast<std::size_t>(kept - side.begin());
  }
  if (n < 3) return {};
  std::vector<double> numbers;
  numbers.reserve(kSide * (kSide - 1) / 2);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      const double places = readings_[side[b]].place - readings_[side[a]].place;
      if (places == 0.0) continue;
      numbers.push_back((readings_[side[b]].value - readings_[side[a]].value) / places);
    }
  }
  if (numbers.empty()) return {};
  Line line;
  line.slope = median(numbers);
  numbers.clear();
  for (std::size_t a = 0; a < n; ++a) {
    const Reading& reading = readings_[side[a]];
    numbers.push_back(reading.value + line.slope * (readings_[at].place - reading.place));
  }
  line.value = median(numbers);
  for (double& number : numbers) number = std::abs(number - line.value);
  // The second largest, so that one bad reading does not count.
  std::nth_element(numbers.begin(), numbers.end() - 2, numbers.end());
  line.scatter = *(numbers.end() - 2);
  line.is_known = true;
  return line;
}

// True if a reading is further from the line than noise explains. This includes the uncertainty of
// a line through kSide readings that end beside `from`: their mean lies (kSide + 1)/2 before it.
bool SpikeWatch::departs(const Line& before, std::size_t at, std::size_t from) const {
  constexpr double kMiddle = 0.5 * (kSide + 1), kSpread = kSide * (kSide * kSide - 1) / 12.0;
  const double away = readings_[at].place - readings_[from].place;
  const double unsure =
      std::sqrt(1.0 + 1.0 / kSide + (away + kMiddle) * (away + kMiddle) / kSpread);
  const double distance = std::abs(readings_[at].value - before.value - before.slope * away);
  return distance > kSpikeSigmas * unsure * noise() + kEarlyOrLate * std::abs(before.slope);
}

double SpikeWatch::noise() const {
  return std::max(usual_, least_ > 0.0 ? least_ : 0.5 * least_step_);
}

// The one behind is the first that continues the line before, so that a second bad reading beside
// this one does not hide it; if none does (a corner, a staircase), the next one.
bool SpikeWatch::lies_between(std::size_t at, const Line& line, double slack) const {
  std::size_t next = at + 1;
  if (line.scatter <= kLikely * noise()) {
    const std::size_t end = std::min(at + 1 + kSide, readings_.size());
    while (next < end && departs(line, next, at)) ++next;
    if (next == end) next = at + 1;
  }
  const double before = readings_[at - 1].value, behind = readings_[next].value;
  const double value = readings_[at].value;
  return value > std::min(before, behind) - slack && value < std::max(before, behind) + slack;
}

bool SpikeWatch::judge(std::size_t at) {
  const Line before = predicted(at, -1);
  const Line behind = predicted(at, 1, &before);
  if (!before.is_known && !behind.is_known) return false;
  const double n_known = static_cast<double>(std::max(n_learnt_, std::size_t{1}));
  const double sigmas =
      kSpikeSigmas + kFewMore / n_known + kManyMore * std::log10(std::max(1.0, n_known / kMany));
  const double one = sigmas * kOfOne * noise();
  const double value = readings_[at].value;
  if (!before.is_known || !behind.is_known) {
    const Line& line = before.is_known ? before : behind;
    return std::abs(value - line.value) > kAtTheEnd * one + kTurned * std::abs(line.slope);
  }
  const double slope = std::max(std::abs(before.slope), std::abs(behind.slope));
  // Slopes that noise alone can cause need no allowance.
  const double corner =
      std::max(0.0, std::abs(before.slope - behind.slope) - kNoisySlope * noise());
  const double ramp = std::max(0.0, slope - kNoisySlope * noise());
  // The single steps of a coarse stage turn a ramp into a staircase.
  const double scatter =
      std::max(0.0, std::max(before.scatter, behind.scatter) - kLikely * noise());
  const double slack = kRounded * corner + kEarlyOrLate * ramp + kStaircase * scatter;
  // On a ramp the force turns back only by what a specimen relaxes between two steps of the stage.
  const double outside = std::max(kLikely * noise(), step_);
  if (slope > kLikely * noise() && lies_between(at, before, outside)) return false;
  const double apart = std::abs(before.value - behind.value);
  const double middle = 0.5 * (before.value + behind.value);
  // Two lines through pure noise seldom differ by more than this.
  const bool do_agree = apart < 4.0 * noise();
  const double distance = std::abs(
      value - (do_agree ? mean_around(at, middle, 0.5 * (before.slope + behind.slope)) : middle));
  const bool is_spike = do_agree ? distance > sigmas * kOfBoth * noise() + slack
                                 : distance > 0.5 * apart + one + slack;
  if (do_agree && !is_spike) learn(distance / kOfBoth);
  return is_spike;
}

// Mean of the neighbours on both sides, shifted along the slope to the place of the one at `at`.
double SpikeWatch::mean_around(std::size_t at, double middle, double slope) const {
  double sum = 0.0;
  int n = 0;
  for (std::size_t i = at - std::min(at, kSide); i <= at + kSide && i < readings_.size(); ++i) {
    if (i == at || readings_[i].is_spike) continue;
    const double here = readings_[i].value + slope * (readings_[at].place - readings_[i].place);
    if (std::abs(here - middle) > kLikely * noise()) continue;
    sum += here;
    ++n;
  }
  return n > 0 ? sum / n : middle;
}

// Keeps the last distances and computes their median again after every kRenew of them.
void SpikeWatch::learn(double distance) {
  if (distances_.size() < kRing) {
    distances_.push_back(distance);
  } else {
    distances_[ring_at_] = distance;
    ring_at_ = (ring_at_ + 1) % kRing;
  }
  ++n_learnt_;
  if (n_learnt_ % kRenew != 0) return;
  std::vector<double> sorted = distances_;
  usual_ = kPerMedian * median(sorted);
}

// At first every distance counts, because nothing is known yet; the median ignores the bad ones.
void SpikeWatch::learn_first() {
  for (std::size_t at = kSide; at + kSide < readings_.size(); ++at) {
    const double middle = 0.5 * (predicted(at, -1).value + predicted(at, 1).value);
    distances_.push_back(std::abs(readings_[at].value - middle) / kOfBoth);
  }
  n_learnt_ = distances_.size();
  std::vector<double> sorted = distances_;
  usual_ = kPerMedian * median(sorted);
}

void ReadingMarks::take(const LoadSample& sample, std::optional<double> value, double period_s) {
  if (first_period_s_ == 0.0) first_period_s_ = period_s;
  const auto number = static_cast<double>(sample.index);
  std::vector<std::int64_t> values, times;
  if (sample.device_time_s) {
    if (!times_) times_.emplace(kTimeNoise * first_period_s_);
    times = times_->take(sample.index, number, *sample.device_time_s);
  }
  if (value) values = values_.take(sample.index, number, *value);
  mark_all(values, times);
}

void ReadingMarks::finish() {
  mark_all(values_.finish(), times_ ? times_->finish() : std::vector<std::int64_t>());
}

void ReadingMarks::mark_all(const std::vector<std::int64_t>& values,
                            const std::vector<std::int64_t>& times) {
  for (const std::int64_t index : times) {
    mark(index, "came at a time that its neighbours contradict: a garbled digit of its clock");
  }
  for (const std::int64_t index : values) {
    mark(index, "stands out of its neighbours: a garbled digit, or a knock");
  }
}

void ReadingMarks::mark(std::int64_t index, const std::string& why) {
  if (!marked_.insert(index).second) return;
  sink_(RunEvent{clock_.now_s(), "implausible", std::to_string(index),
                 "Reading " + std::to_string(index) + " of the load cell " + why});
}

}  // namespace viscard
