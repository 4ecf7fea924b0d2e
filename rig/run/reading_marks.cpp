#include "rig/run/reading_marks.h"

namespace viscard {
namespace {

// Smallest jitter assumed of the device's clock, as a share of the period: a device whose loop is
// a millisecond late now and then has not spoilt a reading.
constexpr double kTimeNoise = 0.02;

}  // namespace

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
