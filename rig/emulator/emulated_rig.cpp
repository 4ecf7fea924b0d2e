#include "rig/emulator/emulated_rig.h"

#include "rig/emulator/emulated_motor.h"
#include "rig/emulator/emulated_parts.h"
#include "rig/emulator/emulated_specimen.h"
#include "rig/emulator/pty_port.h"
#include "rig/emulator/wall_pace.h"
#include "rig/lines/rig_clock.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

namespace viscard {
namespace {

constexpr double kLargestStep_s = 1e-3;    // of the hereditary integral, emulated time
constexpr double kShortestNap_s = 0.2e-3;  // wall
constexpr double kLongestNap_s = 2e-3;     // wall; bounds the delay until an incident is noticed
constexpr double kNever_s = 1e300;
constexpr double kStageStall_s = 0.5;
// In the place of the time at which the fault is due: it has begun.
constexpr double kBegun_s = std::numeric_limits<double>::infinity();
constexpr double kFrame_s = 1e-3;  // a rig that waits exchanges bytes so often, as USB does

}  // namespace

class EmulatedRig::Impl final : public WaitingRig {
 public:
  explicit Impl(const EmulatedRigOptions& options)
      : options_(options),
        clock_(options.is_on_wall_clock ? options.config.clock_speed : 1.0),
        specimen_(options.truth),
        stage_(emulated_controller(options)),
        gauge_(options.truth, options.config.calibration, options.config.load_cell.driver,
               options.gauge),
        amplifier_(options.truth, options.config.calibration,
                   options.config.load_cell.volts_per_count, amplifier_options(options)),
        thermometer_(options.config.thermometer, options.thermometer),
        motor_(options.travel_scale, options.lost_before_m, stage_->bench_position_m(0.0)),
        pace_(options.config.clock_speed) {
    if (options.fault.kind == RigFaultKind::kStagePortBack) stage_port_.name_stably();
    if (options.fault.phase.empty()) enter_phase("");
    if (options.is_on_wall_clock) thread_ = std::thread([this] { run(); });
  }

  ~Impl() override {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
  }

  double now_s() const override { return now_s_; }

  void pass(double longest_s) override {
    const double until_s = now_s_ + std::max(longest_s, 0.5 * kFrame_s);
    bool has_sent = false;
    while (now_s_ < until_s && !has_sent) {
      now_s_ = std::min(until_s, (std::floor(now_s_ / kFrame_s + 1e-6) + 1.0) * kFrame_s);
      const std::size_t n_before = stage_port_.n_sent() + cell_port_.n_sent();
      serve(now_s_);
      has_sent = stage_port_.n_sent() + cell_port_.n_sent() > n_before;
      for (const auto& serve_other : others_) has_sent = serve_other(now_s_) || has_sent;
    }
    pace_.keep(now_s_);
  }

  // The fault is due from here on; it begins with the next service.
  void enter_phase(const std::string& phase) {
    const RigFault& fault = options_.fault;
    if (fault.kind == RigFaultKind::kNone || phase != fault.phase) return;
    const double from_s = options_.is_on_wall_clock ? clock_.now_s() : now_s_;
    if (fault_due_s_ == kNever_s) fault_due_s_ = from_s + fault.after_s;
  }

  bool awaits_fault() const {
    return options_.fault.kind != RigFaultKind::kNone && fault_due_s_ != kBegun_s;
  }

  EmulatedOutcome outcome() const {
    const std::lock_guard lock(outcome_mutex_);
    return outcome_;
  }

  EmulatedRigOptions options_;
  RigClock clock_;  // read only by a rig on the wall clock
  PtyPort stage_port_;
  PtyPort cell_port_;
  PtyPort thermometer_port_;
  std::vector<std::function<bool(double)>> others_;
  std::atomic<bool> is_ending_{false};
  std::atomic<unsigned> incidents_{0};
  std::atomic<double> stall_wall_s_{0.0};
  std::atomic<double> weight_N_{0.0};
  std::atomic<double> fault_due_s_{kNever_s};
  mutable std::mutex outcome_mutex_;
  EmulatedOutcome outcome_;
  std::vector<std::string> sent_lines_;

 private:
  void run() {
    while (!is_ending_) {
      serve(clock_.now_s());
      nap(clock_.now_s());
    }
  }

  void serve(double now_s) {
    watch_port(stage_port_, stage_board_, now_s);
    watch_port(cell_port_, cell_board_, now_s);
    happen(now_s);
    if (now_s >= fault_due_s_) begin_fault(now_s);
    if (now_s >= stage_back_at_s_) {
      stage_back_at_s_ = kNever_s;
      stage_port_.come_back();
    }
    // Conversions up to now depend on the motion up to now; bytes from the host act from now on.
    stage_->set_lost_m(motor_.lost_m());
    stage_->tick(now_s);
    serve_cell(now_s);
    serve_thermometer(now_s);
    advance_bench(std::max(bench_s_, now_s));
    {
      // Set before a report of this moment can reach the host.
      const std::lock_guard lock(outcome_mutex_);
      outcome_.final_position_m =
          motor_.position_m(stage_->bench_position_m(now_s), specimen_.force_N());
      outcome_.is_moving = stage_->is_moving(now_s);
      outcome_.lost_m = motor_.lost_m();
      outcome_.counted_m = stage_->bench_position_m(now_s);
    }
    serve_stage(now_s);
  }

  // A board that boots when its port is opened.
  struct Board {
    bool is_open = false;
    bool is_running = false;
    double boots_at_s = 0.0;
  };
  void watch_port(PtyPort& port, Board& board, double now_s) {
    const bool is_open = port.is_open_by_host();
    if (is_open && !board.is_open && (options_.resets_on_open || !board.is_running)) {
      board.is_running = false;
      board.boots_at_s = now_s + clock_.from_wall_s(options_.boot_wall_s);
    }
    board.is_open = is_open;
  }

  // Advances the mechanics to to_s in steps that end where the acceleration changes.
  void advance_bench(double to_s) {
    while (bench_s_ < to_s) {
      const double next_s =
          std::min({to_s, bench_s_ + kLargestStep_s, stage_->next_knot_s(bench_s_)});
      motor_.pass(next_s - bench_s_);
      const double at_m = motor_.position_m(stage_->bench_position_m(next_s), specimen_.force_N());
      const double force_N = specimen_.advance(next_s - bench_s_, at_m);
      bench_s_ = next_s;
      if (!specimen_.is_touched() && !stage_->is_moving(bench_s_) && !motor_.is_sinking()) {
        bench_s_ = to_s;  // nothing can happen until the stage moves
      }
      const std::lock_guard lock(outcome_mutex_);
      outcome_.peak_force_N = std::max(outcome_.peak_force_N, force_N);
      outcome_.peak_depth_m = std::max(outcome_.peak_depth_m, specimen_.depth_m());
      if (options_.truth.overload_N > 0.0 && force_N > options_.truth.overload_N) {
        outcome_.is_cell_broken = true;
      }
    }
  }

  void serve_stage(double now_s) {
    if (now_s < stage_stalls_until_s_) return;
    const std::string bytes = stage_port_.read_available();
    if (!stage_board_.is_running) {
      if (!stage_board_.is_open || now_s < stage_board_.boots_at_s) return;
      stage_board_.is_running = true;
      stage_->reset(now_s);
    } else if (!bytes.empty()) {
      stage_->receive(bytes, now_s);
      stage_->tick(now_s);
    }
    stage_port_.write(stage_->take_output());
  }

  void serve_cell(double now_s) {
    if (is_gauge()) return serve_gauge(now_s);
    cell_port_.read_available();  // the amplifier ignores what the host sends
    if (!cell_board_.is_running && cell_board_.is_open && now_s >= cell_board_.boots_at_s) {
      cell_board_.is_running = true;
      cell_port_.write(amplifier_.reset(now_s));
    }
    if (!cell_board_.is_running) return;
    std::string lines;
    while (amplifier_.next_sample_s() <= now_s) {
      advance_bench(std::max(bench_s_, amplifier_.next_sample_s()));
      const std::string line =
          amplifier_.convert(specimen_.force_N() + weight_N_, outcome().is_cell_broken);
      if (is_cell_silent_) continue;
      lines += line;
      keep_lines(line);
    }
    cell_board_.is_open ? cell_port_.write(lines) : cell_port_.discard();
  }

  void keep_lines(const std::string& lines) {
    if (!options_.keeps_lines || lines.empty()) return;
    const std::lock_guard lock(outcome_mutex_);
    sent_lines_.push_back(lines);
  }

  // For an instrument that takes commands.
  void serve_gauge(double now_s) {
    gauge_.receive(cell_port_.read_available(), now_s);
    while (gauge_.next_sample_s() <= now_s) {
      advance_bench(std::max(bench_s_, gauge_.next_sample_s()));
      gauge_.convert(specimen_.force_N() + weight_N_, outcome().is_cell_broken);
    }
    const std::string answers = gauge_.take_output(now_s);
    if (is_cell_silent_) return;
    cell_port_.write(answers);
    keep_lines(answers);
  }

  void serve_thermometer(double now_s) {
    const bool is_shared = !has_own_port(options_.config.thermometer);
    PtyPort& port = is_shared ? cell_port_ : thermometer_port_;
    if (!has_thermometer(options_.config.thermometer) || !port.is_open_by_host()) return;
    const std::string sent = thermometer_.serve(is_shared ? "" : port.read_available(), now_s);
    if (!is_shared || cell_board_.is_running || is_gauge()) port.write(sent);
  }

  bool is_gauge() const { return !has_converter(options_.config.load_cell); }
  void happen(double now_s) {
    const unsigned incidents = incidents_.exchange(0);
    const auto has = [&](Incident one) { return (incidents & static_cast<unsigned>(one)) != 0; };
    if (has(Incident::kPullStageCable)) stage_port_.hang_up();
    if (has(Incident::kPullLoadCellCable)) cell_port_.hang_up();
    if (has(Incident::kPullThermometerCable)) thermometer_port_.hang_up();
    if (has(Incident::kSilenceLoadCell)) is_cell_silent_ = true;
    if (has(Incident::kRestartLoadCell)) cell_port_.write(amplifier_.reset(now_s));
    if (has(Incident::kRestartStage)) stage_->reset(now_s);
    if (has(Incident::kHitLimitSwitch)) stage_->hit_limit(now_s);
    stage_port_.write(stage_->take_output());
    const double stall_s = stall_wall_s_.exchange(0.0);
    if (stall_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(stall_s));
  }

  void begin_fault(double now_s) {
    fault_due_s_ = kBegun_s;
    const RigFaultKind kind = options_.fault.kind;
    amplifier_.set_fault(kind);
    gauge_.set_fault(kind);
    motor_.set_fault(kind);
    if (kind == RigFaultKind::kLoadCellPort) cell_port_.hang_up();
    if (kind == RigFaultKind::kStageStall) {
      stage_->stall(now_s, kStageStall_s);
      stage_stalls_until_s_ = now_s + kStageStall_s;
    }
    if (kind == RigFaultKind::kStagePort) stage_port_.hang_up();
    if (kind == RigFaultKind::kStagePortBack) {
      stage_port_.hang_up();
      stage_back_at_s_ = now_s + clock_.from_wall_s(1.0);
    }
  }

  // Waits until the next conversion is due or the host sends bytes.
  void nap(double now_s) {
    double wall_s = kLongestNap_s;
    if (cell_board_.is_running || is_gauge()) {
      const double next_s = is_gauge() ? gauge_.next_sample_s() : amplifier_.next_sample_s();
      wall_s = std::clamp((next_s - now_s) / clock_.speed(), kShortestNap_s, kLongestNap_s);
    }
    // A port that no host has open reports a hang-up at once, so poll would return immediately.
    pollfd entry{stage_board_.is_open ? stage_port_.descriptor() : -1, POLLIN, 0};
    timespec timeout{0, static_cast<long>(wall_s * 1e9)};
    ppoll(&entry, 1, &timeout, nullptr);
  }

  double bench_s_ = 0.0;
  EmulatedSpecimen specimen_;
  std::unique_ptr<EmulatedController> stage_;
  EmulatedGauge gauge_;
  EmulatedAmplifier amplifier_;
  EmulatedThermometer thermometer_;
  EmulatedMotor motor_;
  Board stage_board_, cell_board_;
  bool is_cell_silent_ = false;
  double stage_back_at_s_ = kNever_s;
  double stage_stalls_until_s_ = 0.0;
  double now_s_ = 0.0;  // of a rig that waits
  WallPace pace_;
  std::thread thread_;
};

EmulatedRig::EmulatedRig(const EmulatedRigOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

EmulatedRig::~EmulatedRig() = default;

std::string EmulatedRig::stage_port() const {
  return impl_->stage_port_.path();
}
std::string EmulatedRig::load_cell_port() const {
  return impl_->cell_port_.path();
}

RigConfig EmulatedRig::config() const {
  RigConfig config = impl_->options_.config;
  config.stage.port = stage_port();
  config.load_cell.port = load_cell_port();
  if (has_own_port(config.thermometer)) config.thermometer.port = impl_->thermometer_port_.path();
  config.stage.microstep_m = 1.0 / impl_->options_.truth.steps_per_m;
  if (!impl_->options_.is_on_wall_clock) config.clock_speed = 1.0;
  return config;
}

RigClock EmulatedRig::clock() const {
  return impl_->options_.is_on_wall_clock ? RigClock(impl_->clock_.speed()) : RigClock(*impl_);
}

bool EmulatedRig::waits() const {
  return !impl_->options_.is_on_wall_clock;
}

void EmulatedRig::serve_too(std::function<bool(double now_s)> serve) {
  impl_->others_.push_back(std::move(serve));
}

EmulatedOutcome EmulatedRig::outcome() const {
  return impl_->outcome();
}
std::vector<std::string> EmulatedRig::sent_lines() const {
  const std::lock_guard lock(impl_->outcome_mutex_);
  return impl_->sent_lines_;
}

void EmulatedRig::hang_weight(double force_N) {
  impl_->weight_N_ = force_N;
}
void EmulatedRig::cause(Incident incident) {
  impl_->incidents_ |= static_cast<unsigned>(incident);
}
void EmulatedRig::enter_phase(const std::string& phase) {
  impl_->enter_phase(phase);
}
bool EmulatedRig::awaits_fault() const {
  return impl_->awaits_fault();
}
void EmulatedRig::stall(double wall_s) {
  impl_->stall_wall_s_ = wall_s;
}

}  // namespace viscard
