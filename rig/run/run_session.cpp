#include "rig/run/run_session.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kProgress_wall_s = 0.1;
constexpr double kNap_wall_s = 0.005;
// An emulated clock in a hurry makes seconds of every stall of the machine.
constexpr double kSilenceEmulated_wall_s = 1.0;
constexpr double kSilence_wall_s = 0.1;
// Of a period: what the device's clock jitters at least. A loop that is now and then late by a
// millisecond spoils no reading.
constexpr double kTimeNoise = 0.02;

}  // namespace

RunSession::RunSession(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                       const RecordSink& sink, const RunControl& control)
    : stage_(stage),
      load_cell_(load_cell),
      rig_(rig),
      sink_(sink),
      control_(control),
      clock_(*control.clock),
      guard_(rig.safety, rig.calibration.capacity_N),
      silence_(clock_.speed() > 1.0 ? kSilenceEmulated_wall_s : kSilence_wall_s) {
  load_cell_.set_listener([this](const LoadSample& sample) { take_sample(sample); });
}

RunSession::~RunSession() {
  load_cell_.set_listener({});
}

void RunSession::connect() {
  const Pump pump = [this] { this->pump(); };
  is_armed_ = true;  // the stop flag counts from here
  load_cell_.connect(pump);
  is_cell_connected_ = true;
  stage_.connect(pump);
  is_stage_connected_ = true;
}

void RunSession::pump() {
  std::vector<const Transport*> transports{&stage_.transport()};
  if (!is_cell_lost_) transports.push_back(&load_cell_.transport());
  // Rig time may run faster than the wall: what is due then must not be slept over.
  wait_readable(transports, kNap_wall_s / std::clamp(clock_.speed() / 10.0, 1.0, 10.0));
  serve_cell();
  serve_stage();
  listen();
  if (is_armed_) {
    if (control_.stop != nullptr && *control_.stop) {
      throw RunInterrupted("the run was interrupted; what was recorded is kept");
    }
    check_stream();
    if (guards_force()) act_on(guard_.silent_until(clock_.now_s()), force_N_);
  }
  report_progress();
}

// Whatever is wrong with the readings, a stage that moves without them is stopped at once. While
// the rig is being made safe they are welcome but not needed.
void RunSession::serve_cell() {
  if (is_cell_lost_) return;
  try {
    load_cell_.service();
  } catch (const LimitReached&) {  // the stage has been told already
    throw;
  } catch (const RigError& error) {
    is_cell_restarted_ =
        is_cell_restarted_ || dynamic_cast<const DeviceRestarted*>(&error) != nullptr;
    is_cell_lost_ = dynamic_cast<const PortHungUp*>(&error) != nullptr;
    if (!is_armed_) return;
    if (stage_.is_moving()) {
      needs_recovery_ = true;
      stage_.stop_hard();
    }
    throw;
  }
}

void RunSession::serve_stage() {
  try {
    stage_.service();
  } catch (const StageAlarm&) {
    needs_recovery_ = true;
    throw;
  } catch (const DeviceRestarted&) {
    needs_recovery_ = true;
    is_place_lost_ = true;
    throw;
  }
}

void RunSession::listen() {
  const double arrival_s = load_cell_.last_arrival_s();
  silence_.pass(monotonic_s(), arrival_s != heard_s_, stage_.is_moving());
  heard_s_ = arrival_s;
}

void RunSession::pump_until(double time_s) {
  while (clock_.now_s() < time_s) pump();
}

void RunSession::hear_until(double time_s) {
  constexpr double kLongest_wall_s = 1.0;
  pump_until(time_s);
  const double deadline_s = monotonic_s() + kLongest_wall_s;
  while (last_made_s_ < time_s - load_cell_.period_s() && monotonic_s() < deadline_s) pump();
}

void RunSession::take_sample(const LoadSample& sample) {
  const std::optional<double> reading_N = force_N_from_sample(sample, rig_);
  const double absolute_N = reading_N.value_or(tare_N_);
  const double force_N = absolute_N - tare_N_;
  const bool is_doubtful =
      sample.is_glitch || sample.is_saturated || !reading_N || !std::isfinite(*reading_N);
  if (!is_doubtful) {
    force_N_ = force_N;
    ++n_forces_;
    peak_force_N_ = std::max(peak_force_N_, force_N);
    if (stop_above_N_ && std::abs(force_N) > *stop_above_N_) has_exceeded_ = true;
    const double made_at_s = load_cell_.made_at_s(sample);
    last_made_s_ = std::max(last_made_s_, made_at_s);
    if (collect_from_s_ && made_at_s >= *collect_from_s_) {
      if (collected_N_.empty()) collected_first_s_ = made_at_s;
      collected_N_.push_back(absolute_N);
      collected_until_s_ = made_at_s;
    }
  }
  watch_spikes(sample, is_doubtful);
  if (!guards_force() && !is_stopping_) return;
  const GuardAction action =
      guard_.take(force_N, is_doubtful, sample.host_time_s, load_cell_.period_s());
  if (is_armed_) return act_on(action, force_N);
  if (action != GuardAction::kHardStop) return;
  is_stopping_ = false;  // the gentle stop was too slow
  needs_recovery_ = true;
  stage_.stop_hard();
  event("limit", "hard",
        "The force still rose to " + text_from_number(force_N, 3) + " N: the stage was reset");
}

void RunSession::watch_spikes(const LoadSample& sample, bool is_doubtful) {
  if (first_period_s_ == 0.0) first_period_s_ = load_cell_.period_s();
  const auto number = static_cast<double>(sample.index);
  std::vector<std::int64_t> values, times;
  if (sample.device_time_s) {
    if (!time_spikes_) time_spikes_.emplace(kTimeNoise * first_period_s_);
    times = time_spikes_->take(sample.index, number, *sample.device_time_s);
  }
  if (!is_doubtful) {
    const double value = sample.counts ? *sample.counts : *force_N_from_sample(sample, rig_);
    values = spikes_.take(sample.index, number, value);
  }
  mark_all(values, times);
}

void RunSession::finish_watching() {
  mark_all(spikes_.finish(), time_spikes_ ? time_spikes_->finish() : std::vector<std::int64_t>());
}

void RunSession::mark_all(const std::vector<std::int64_t>& values,
                          const std::vector<std::int64_t>& times) {
  for (const std::int64_t index : times) {
    mark(index, "came at a time that its neighbours contradict: a garbled digit of its clock");
  }
  for (const std::int64_t index : values) {
    mark(index, "stands out of its neighbours: a garbled digit, or a knock");
  }
}

// Marked, not dropped: what was received stays in the record as it came.
void RunSession::mark(std::int64_t index, const std::string& why) {
  if (!implausible_.insert(index).second) return;
  event("implausible", std::to_string(index),
        "Reading " + std::to_string(index) + " of the load cell " + why);
}

bool RunSession::move(double to_m, double speed_m_s, const std::string& purpose,
                      std::optional<double> stop_above_N) {
  stop_above_N_ = stop_above_N;
  has_exceeded_ = false;
  stage_.begin_move(to_m, speed_m_s, purpose);
  has_moved_ = true;
  bool is_stopping = false;
  while (stage_.is_moving()) {
    pump();
    if (has_exceeded_ && !is_stopping && stage_.is_moving()) {
      stage_.stop_soft();
      is_stopping = true;
    }
  }
  // Readings made before standstill may still be on their way.
  const double stood_s = clock_.now_s();
  const double deadline_s = monotonic_s() + 1.0;
  if (stop_above_N) {
    collect_from_s_ = stood_s;
    collected_N_.clear();
    while (collected_N_.empty() && monotonic_s() < deadline_s) pump();
    collect_from_s_.reset();
  }
  stop_above_N_.reset();
  return has_exceeded_;
}

ForceMean RunSession::mean_force(double duration_s) {
  collect_from_s_ = clock_.now_s();
  collected_until_s_ = *collect_from_s_;
  collected_N_.clear();
  const double end_s = *collect_from_s_ + duration_s;
  const double deadline_s = monotonic_s() + duration_s / clock_.speed() + 3.0;
  while (collected_until_s_ < end_s && monotonic_s() < deadline_s) pump();
  collect_from_s_.reset();
  ForceMean result;
  result.n = static_cast<int>(collected_N_.size());
  if (result.n < 5) {
    throw RigError("only " + counted(static_cast<std::size_t>(result.n), "reading") +
                   " of a force came in " + text_from_number(duration_s, 1) +
                   " s. Check the load cell's rate with: viscard rig check");
  }
  double sum_N = 0.0;
  for (const double force_N : collected_N_) sum_N += force_N;
  const double mean_N = sum_N / result.n;
  double squares_N2 = 0.0;
  for (const double force_N : collected_N_) squares_N2 += (force_N - mean_N) * (force_N - mean_N);
  result.force_N = mean_N - tare_N_;
  result.sd_N = std::sqrt(squares_N2 / (result.n - 1));
  result.rate_Hz = (result.n - 1) / std::max(1e-9, collected_until_s_ - collected_first_s_);
  return result;
}

ForceMean RunSession::tare(double duration_s) {
  const ForceMean mean = mean_force(duration_s);
  tare_N_ += mean.force_N;
  force_N_ -= mean.force_N;
  peak_force_N_ = 0.0;
  event("tare", text_from_number(tare_N_, 6),
        "Zero is at " + text_from_number(tare_N_, 4) + " N of the calibration; noise " +
            text_from_number(mean.sd_N * 1e3, 3) + " mN per reading");
  return mean;
}

void RunSession::begin_phase(const std::string& name, double planned_rest_s,
                             const std::string& text) {
  phase_ = name;
  phase_start_s_ = clock_.now_s();
  planned_rest_s_ = planned_rest_s;
  event("phase", name, text);
}

void RunSession::event(const std::string& name, const std::string& value, const std::string& text) {
  sink_(RunEvent{clock_.now_s(), name, value, text});
}

void RunSession::report_progress() {
  if (!control_.progress || monotonic_s() - last_progress_wall_s_ < kProgress_wall_s) return;
  last_progress_wall_s_ = monotonic_s();
  RunProgress progress;
  const double now_s = clock_.now_s();
  progress.time_s = now_s;
  progress.phase = phase_;
  progress.time_left_s = std::max(0.0, planned_rest_s_ - (now_s - phase_start_s_));
  progress.fraction = now_s / std::max(1e-9, now_s + progress.time_left_s);
  progress.force_N = force_N_;
  if (contact_m_) {
    const double frame_N_m = rig_.frame.stiffness_N_m;
    progress.depth_m = std::max(
        0.0, stage_.position_m() - *contact_m_ - (frame_N_m > 0.0 ? force_N_ / frame_N_m : 0.0));
  }
  control_.progress(progress);
}

}  // namespace viscard
