#include "rig/emulator/emulated_controllers.h"

namespace viscard {
namespace {

std::unique_ptr<EmulatedController> emulated_grbl(const EmulatedRigOptions& options) {
  const StageConfig& stage = options.config.stage;
  return std::make_unique<EmulatedGrbl>(options.truth, stage.axis, stage.toward_specimen,
                                        options.grbl);
}

std::unique_ptr<EmulatedController> emulated_zaber(const EmulatedRigOptions& options) {
  const StageConfig& stage = options.config.stage;
  return std::make_unique<EmulatedZaber>(options.truth, stage.toward_specimen, stage.device,
                                         options.zaber);
}

struct Controller {
  const char* driver;
  std::unique_ptr<EmulatedController> (*make)(const EmulatedRigOptions&);
};

// One row per value of driver under [stage] (rig/open_devices.cpp).
constexpr Controller kControllers[] = {{"grbl", emulated_grbl}, {"zaber", emulated_zaber}};

}  // namespace

std::unique_ptr<EmulatedController> emulated_controller(const EmulatedRigOptions& options) {
  for (const Controller& controller : kControllers) {
    if (options.config.stage.driver == controller.driver) return controller.make(options);
  }
  return emulated_grbl(options);  // the driver then refuses the rig file
}

}  // namespace viscard
