#include "rig/emulator/emulated_parts.h"

namespace viscard {

// One branch per value of driver under [stage] (rig/open_devices.cpp); a GRBL for an unknown word,
// which the driver refuses.
std::unique_ptr<EmulatedController> emulated_controller(const EmulatedRigOptions& options) {
  const StageConfig& stage = options.config.stage;
  if (stage.driver == "zaber") {
    return std::make_unique<EmulatedZaber>(options.truth, stage.toward_specimen, stage.device,
                                           options.zaber);
  }
  if (stage.driver == "apt") {
    return std::make_unique<EmulatedApt>(options.truth, stage.toward_specimen, options.apt);
  }
  if (stage.driver == "marlin") {
    return std::make_unique<EmulatedMarlin>(options.truth, stage.axis, stage.toward_specimen,
                                            options.marlin);
  }
  if (stage.driver == "pi-gcs2") {
    return std::make_unique<EmulatedPi>(options.truth, stage, options.pi);
  }
  if (stage.driver == "smc100") {
    return std::make_unique<EmulatedSmc>(options.truth, stage, options.smc);
  }
  return std::make_unique<EmulatedGrbl>(options.truth, stage.axis, stage.toward_specimen,
                                        options.grbl);
}

AmplifierOptions amplifier_options(const EmulatedRigOptions& options) {
  AmplifierOptions amplifier = options.amplifier;
  if (options.config.load_cell.driver == "adc-frames") {
    amplifier.format = AmplifierFormat::kFrames;
    amplifier.frame = options.config.load_cell.frame;
  }
  return amplifier;
}

}  // namespace viscard
