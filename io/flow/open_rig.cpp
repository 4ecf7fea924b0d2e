#include "io/flow/open_rig.h"

#include "rig/emulator/demo_rig.h"

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

}  // namespace

OpenRig::OpenRig(const RigConfig& rig, bool is_emulated)
    : emulated_(is_emulated ? emulated_rig(rig) : nullptr),
      config_(config_of(rig, emulated_.get())),
      clock_(emulated_ ? emulated_->clock() : RigClock(rig.clock_speed)),
      devices_(open_ports(config_, clock_)) {
  add_drivers(devices_, config_, clock_, [](const RunRecord&) {});
}

}  // namespace viscard
