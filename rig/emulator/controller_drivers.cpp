#include "rig/emulator/controller_drivers.h"

namespace viscard {

// One branch per value of driver under [stage] (rig/open_devices.cpp).
std::unique_ptr<EmulatedController> emulated_controller(const StageConfig& config,
                                                        const EmulatedTruth& truth,
                                                        const GrblHabits& grbl,
                                                        const ZaberHabits& zaber) {
  if (config.driver == "zaber") {
    return std::make_unique<EmulatedZaber>(truth, config.toward_specimen, config.device, zaber);
  }
  return std::make_unique<EmulatedGrbl>(truth, config.axis, config.toward_specimen, grbl);
}

}  // namespace viscard
