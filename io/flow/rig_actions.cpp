#include "io/flow/rig_actions.h"

#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run/rest_findings.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

// from_m: where its stage stands; the emulator begins at 0.
std::unique_ptr<EmulatedRig> emulated_rig(const RigConfig& rig, double from_m = 0.0) {
  EmulatedRigOptions options = able_rig(demo_truth(10.0, 1), rig);
  options.truth.surface_position_m -= from_m;
  return std::make_unique<EmulatedRig>(options);
}

// What the emulated bench decides is its ports and its clock; what is asked of the stage stays.
RigConfig config_of(const RigConfig& rig, const EmulatedRig* emulated) {
  if (emulated == nullptr) return rig;
  RigConfig config = emulated->config();
  config.stage.home = rig.stage.home;
  return config;
}

// The devices of a rig file with their ports open, or those of an emulated rig in its place, with a
// specimen of 10:1 and the truth of the demo. Keeps no record. Throws RigError for a port that
// cannot be opened, and for wrong words of the rig file.
class OpenRig {
 public:
  enum class Homes { kAsInFile, kNo };
  OpenRig(const RigConfig& rig, bool is_emulated, double emulated_from_m = 0.0,
          Homes homes = Homes::kAsInFile);
  OpenRig(const OpenRig&) = delete;
  OpenRig& operator=(const OpenRig&) = delete;

  const RigConfig& config() const { return config_; }
  const RigClock& clock() const { return clock_; }
  RigDevices& devices() { return devices_; }
  EmulatedRig* emulated() { return emulated_.get(); }  // nullptr: real ports

 private:
  std::unique_ptr<EmulatedRig> emulated_;
  RigConfig config_;
  RigClock clock_;
  RigDevices devices_;
};

OpenRig::OpenRig(const RigConfig& rig, bool is_emulated, double emulated_from_m, Homes homes)
    : emulated_(is_emulated ? emulated_rig(rig, emulated_from_m) : nullptr),
      config_(config_of(rig, emulated_.get())),
      clock_(emulated_ ? emulated_->clock() : RigClock(rig.clock_speed)),
      devices_(open_ports(config_, clock_)) {
  if (homes == Homes::kNo) config_.stage.home = false;
  add_drivers(devices_, config_, clock_, [](const RunRecord&) {});
}

// The load cell alone, of a rig file or of an emulated rig in its place.
class OpenCell {
 public:
  OpenCell(const RigConfig& rig, bool is_emulated)
      : emulated_(is_emulated ? emulated_rig(rig) : nullptr),
        config_(config_of(rig, emulated_.get())),
        clock_(emulated_ ? emulated_->clock() : RigClock(rig.clock_speed)),
        line_(open_line(config_.load_cell.port, config_.load_cell.baud, clock_,
                        config_.load_cell.framing)),
        load_cell_(make_load_cell(*line_, config_.load_cell, clock_, [](const RunRecord&) {})) {}
  OpenCell(const OpenCell&) = delete;
  OpenCell& operator=(const OpenCell&) = delete;

  const RigConfig& config() const { return config_; }
  const RigClock& clock() const { return clock_; }
  LoadCell& load_cell() { return *load_cell_; }
  EmulatedRig* emulated() { return emulated_.get(); }  // nullptr: a real port

 private:
  std::unique_ptr<EmulatedRig> emulated_;
  RigConfig config_;
  RigClock clock_;
  std::unique_ptr<Transport> line_;
  std::unique_ptr<LoadCell> load_cell_;
};

enum class Keep { kYes, kNo, kAsComment };

// Writes a line as the first of a section of a TOML file. keep: what becomes of each other line of the section,
// which it gets without the blanks in front.
void write_in_section(const std::filesystem::path& file, const std::string& section,
                      const std::string& line,
                      const std::function<Keep(const std::string&)>& keep) {
  // Whoever edited it while a calibration was measured keeps the edit.
  std::istringstream lines(read_own_file(file));
  std::string out, old;
  bool is_inside = false, is_written = false;
  while (std::getline(lines, old)) {
    const std::size_t begin = old.find_first_not_of(" \t");
    const std::string rest = begin == std::string::npos ? "" : old.substr(begin);
    const bool is_head = rest.rfind('[', 0) == 0;
    const Keep kept = is_inside && !is_head ? keep(rest) : Keep::kYes;
    if (kept == Keep::kNo) continue;
    out += (kept == Keep::kAsComment ? "# " : "") + old + "\n";
    if (!is_head) continue;
    is_inside = rest.rfind("[" + section + "]", 0) == 0;
    if (!is_inside) continue;
    out += line + "\n";
    is_written = true;
  }
  if (!is_written) {
    throw std::runtime_error(file.string() + ": has no section [" + section + "]; write " + line +
                             " there yourself");
  }
  rewrite_file(file, out);
}

}  // namespace

RigCheck check_rig_config(const RigConfig& rig, bool is_emulated, double seconds) {
  OpenRig open(rig, is_emulated, 0.0, OpenRig::Homes::kNo);  // a check moves nothing
  RigDevices& devices = open.devices();
  devices.stage->keep_locked();
  RigCheck found = check_rig(*devices.stage, *devices.load_cell, open.config(), open.clock(),
                             seconds, devices.thermometer.get());
  if (!is_emulated && found.is_proven && rig.load_cell.answered_on.empty()) {
    found.advice.push_back(kUnanswered);
  }
  if (!rig.stage.home) return found;
  const std::string trouble = devices.stage->trouble_with_count_check([&] {
    wait_readable({devices.stage_line.get()}, open.clock(), 0.005);
    devices.stage->service();
  });
  if (trouble.empty()) return found;
  found.advice.push_back(trouble);
  found.is_usable = false;
  return found;
}

void add_calibration(const RigConfig& rig, RigCheck& found) {
  if (rig.calibration.largest_force_N == 0.0) {
    found.advice.push_back(
        "the load cell's calibration does not state the range of force in which it was made "
        "(largest_force), so a force beyond it is not noticed. A new record of viscard calibrate "
        "states it");
  }
  const std::string trouble = calibration_trouble(rig.calibration, today());
  if (trouble.empty()) return;
  found.advice.push_back(trouble);
  if (!last_valid_day(rig.calibration).empty()) found.is_usable = false;
}

double touch_rig(const RigConfig& rig, bool is_emulated, const TouchOptions& asked) {
  OpenRig open(rig, is_emulated);
  TouchOptions options = asked;
  const auto hang = [&](double share) {
    if (open.emulated() == nullptr) return;
    open.emulated()->hang_weight(share * open.config().calibration.capacity_N);
  };
  options.ready = [&] {
    if (asked.ready) asked.ready();
    hang(0.1);
  };
  options.felt = [&] {
    if (asked.felt) asked.felt();
    hang(0.0);
  };
  return await_touch(*open.devices().load_cell, open.config(), open.clock(), options);
}

namespace {

// Writes the line under the section in place of those that begin with its key.
void write_key(const std::filesystem::path& rig_file, const std::string& section,
               const std::string& key, const std::string& value) {
  write_in_section(rig_file, section, key + " = " + value, [&](const std::string& text) {
    const std::size_t end = text.find_first_of(" \t=");
    return text.substr(0, end) == key ? Keep::kNo : Keep::kYes;
  });
}

}  // namespace

void write_answer(const std::filesystem::path& rig_file, const std::string& day) {
  write_key(rig_file, "load_cell", "answered_on", day);
}

void write_zero(const std::filesystem::path& rig_file, double position_m) {
  write_key(rig_file, "stage", "zero", fmt::format("\"{:.6f} mm\"", position_m * 1e3));
}

double lasting_position_m(const RigConfig& rig, bool is_emulated) {
  OpenRig open(rig, is_emulated, 0.0, OpenRig::Homes::kNo);
  RigDevices& devices = open.devices();
  devices.stage
      ->keep_locked();  // unlocked by a command that is refused, the next one would accept it
  devices.stage->connect([&] {
    wait_readable({devices.stage_line.get()}, open.clock(), 0.005);
    devices.stage->service();
  });
  const std::string trouble = devices.stage->trouble_with_zero();
  if (trouble.empty()) return devices.stage->position_m();
  throw RigError("the stage with driver '" + rig.stage.driver +
                 "' cannot keep a zero for the next command: " + trouble);
}

ZeroedForce zero_rig_force(const RigConfig& rig, bool is_emulated, const std::atomic<bool>* stop) {
  OpenCell open(rig, is_emulated);
  return zero_force(open.load_cell(), open.config(), open.clock(), stop);
}

void write_calibration_file(const std::filesystem::path& rig_file, const std::string& record) {
  write_in_section(rig_file, "calibration", "file = \"" + record + "\"",
                   [](const std::string& text) {
                     if (text.rfind("file", 0) == 0) return Keep::kNo;
                     return text.empty() || text.front() == '#' ? Keep::kYes : Keep::kAsComment;
                   });
}

void check_order(const StageOrder& order, const RigConfig& rig, const OrderTexts& typed) {
  if (order.is_home) return;
  constexpr double kFarthest_m = 0.1, kFastest_m_s = 10e-3;
  const auto require = [](bool is_right, const std::string& as_typed, const std::string& in_words,
                          const std::string& expected) {
    if (is_right) return;
    throw std::invalid_argument((as_typed.empty() ? in_words : as_typed) + "; it must be " +
                                expected);
  };
  const double way_m = std::abs(order.toward_m);
  require(way_m > 0.0 && way_m <= kFarthest_m, typed.way,
          fmt::format("the way is {} mm", way_m * 1e3),
          fmt::format("above 0 and at most {} mm", kFarthest_m * 1e3));
  require(order.speed_m_s > 0.0 && order.speed_m_s <= kFastest_m_s, typed.speed,
          fmt::format("the speed is {} mm/s", order.speed_m_s * 1e3),
          fmt::format("above 0 and at most {} mm/s", kFastest_m_s * 1e3));
  const double most_N = rig.safety.soft_fraction * rig.calibration.capacity_N;
  require(order.limit_N > 0.0 && order.limit_N <= most_N, typed.limit,
          fmt::format("the limit is {} N", order.limit_N),
          fmt::format("above 0 and at most {:.3f} N, {} of the capacity (soft_fraction)", most_N,
                      rig.safety.soft_fraction));
}

StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          RunControl control, std::optional<double>* position_m) {
  rig.stage.home = order.is_home;
  const double from_m = is_emulated && position_m != nullptr ? position_m->value_or(0.0) : 0.0;
  OpenRig open(rig, is_emulated, from_m);
  control.clock = &open.clock();
  control.has_answered = is_emulated;
  if (position_m != nullptr && !is_emulated) position_m->reset();  // not known until it is read
  Stage& stage = *open.devices().stage;
  StageMoved moved;
  try {
    moved = move_stage(
        stage, *open.devices().load_cell, open.config(), [](const RunRecord&) {}, control, order);
  } catch (const StageStands& error) {
    if (position_m != nullptr) *position_m = from_m + error.position_m();
    throw;
  }
  const double begin_m = order.is_home ? 0.0 : from_m;
  moved.from_m += begin_m;
  moved.to_m += begin_m;
  if (position_m != nullptr) *position_m = moved.to_m;
  return moved;
}

WeighedLoad weigh_on_rig(const RigConfig& rig, bool is_emulated, double force_N, double largest_N,
                         const std::atomic<bool>* stop) {
  OpenCell open(rig, is_emulated);
  WeighOptions options;
  options.largest_N = largest_N;
  options.stop = stop;
  options.put_on = [&](double load_N) {
    if (open.emulated() != nullptr) open.emulated()->hang_weight(load_N);
    return true;
  };
  return weigh(open.load_cell(), open.config(), open.clock(), {force_N}, options).front();
}

}  // namespace viscard
