#include "io/flow/rig_actions.h"

#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/touch_cell.h"

#include <memory>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

std::unique_ptr<EmulatedRig> emulated_rig(const RigConfig& rig) {
  return std::make_unique<EmulatedRig>(
      EmulatedRigOptions{.truth = demo_truth(10.0, 1), .config = rig});
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
  OpenRig(const RigConfig& rig, bool is_emulated);
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

OpenRig::OpenRig(const RigConfig& rig, bool is_emulated)
    : emulated_(is_emulated ? emulated_rig(rig) : nullptr),
      config_(config_of(rig, emulated_.get())),
      clock_(emulated_ ? emulated_->clock() : RigClock(rig.clock_speed)),
      devices_(open_ports(config_, clock_)) {
  add_drivers(devices_, config_, clock_, [](const RunRecord&) {});
}

}  // namespace

RigCheck check_rig_config(RigConfig rig, bool is_emulated, double seconds) {
  rig.stage.home = false;  // a check moves nothing
  OpenRig open(rig, is_emulated);
  RigDevices& devices = open.devices();
  return check_rig(*devices.stage, *devices.load_cell, open.config(), open.clock(), seconds,
                   devices.thermometer.get());
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

double touch_rig(const RigConfig& rig, bool is_emulated, double wait_s,
                 const std::function<void()>& ready, const std::atomic<bool>* stop) {
  OpenRig open(rig, is_emulated);
  TouchOptions options;
  options.wait_s = wait_s;
  options.stop = stop;
  options.ready = [&] {
    if (ready) ready();
    if (open.emulated() != nullptr)
      open.emulated()->hang_weight(0.1 * open.config().calibration.capacity_N);
  };
  return await_touch(*open.devices().load_cell, open.config(), open.clock(), options);
}

void write_answer(const std::filesystem::path& rig_file, const std::string& day) {
  std::istringstream lines(read_file(rig_file));
  std::string out, line;
  bool is_inside = false, is_written = false;
  while (std::getline(lines, line)) {
    const std::size_t begin = line.find_first_not_of(" \t");
    const std::string rest = begin == std::string::npos ? "" : line.substr(begin);
    if (is_inside && rest.rfind("answered_on", 0) == 0) continue;
    out += line + "\n";
    if (rest.rfind('[', 0) != 0) continue;
    is_inside = rest.rfind("[load_cell]", 0) == 0;
    if (!is_inside) continue;
    out += "answered_on = " + day + "\n";
    is_written = true;
  }
  if (!is_written) {
    throw std::runtime_error(rig_file.string() +
                             ": has no section [load_cell]; write answered_on = " + day +
                             " where its load cell is described");
  }
  write_file(rig_file, out, true);
}

StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          const std::atomic<bool>* stop) {
  rig.stage.home = order.is_home;
  OpenRig open(rig, is_emulated);
  RunControl control;
  control.clock = &open.clock();
  control.stop = stop;
  return move_stage(
      *open.devices().stage, *open.devices().load_cell, open.config(), [](const RunRecord&) {},
      control, order);
}

}  // namespace viscard
