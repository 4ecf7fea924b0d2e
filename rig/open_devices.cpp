#include "rig/open_devices.h"

#include "rig/cells/gauge_load_cell.h"
#include "rig/cells/hx711_load_cell.h"
#include "rig/lines/rig_error.h"
#include "rig/stages/grbl_stage.h"
#include "rig/stages/zaber_stage.h"

namespace viscard {

std::unique_ptr<Stage> make_stage(Transport& transport, const StageConfig& config,
                                  const RigClock& clock, const RecordSink& sink) {
  if (config.driver == "grbl") return std::make_unique<GrblStage>(transport, config, clock, sink);
  if (config.driver == "zaber") return std::make_unique<ZaberStage>(transport, config, clock, sink);
  throw RigError("driver '" + config.driver +
                 "' under [stage] of the rig file is unknown; there are grbl, zaber");
}

std::unique_ptr<LoadCell> make_load_cell(Transport& transport, const LoadCellConfig& config,
                                         const RigClock& clock, const RecordSink& sink) {
  if (config.driver == "hx711") {
    return std::make_unique<Hx711LoadCell>(transport, config, clock, sink);
  }
  return std::make_unique<GaugeLoadCell>(transport, config, clock, sink);
}

RigDevices open_ports(const RigConfig& rig, const RigClock& clock) {
  RigDevices devices;
  devices.stage_line = std::make_unique<SerialLine>(rig.stage.port, rig.stage.baud, clock);
  devices.cell_line = std::make_unique<SerialLine>(rig.load_cell.port, rig.load_cell.baud, clock,
                                                   rig.load_cell.framing);
  return devices;
}

void add_drivers(RigDevices& devices, const RigConfig& rig, const RigClock& clock,
                 const RecordSink& sink) {
  devices.stage = make_stage(*devices.stage_line, rig.stage, clock, sink);
  devices.load_cell = make_load_cell(*devices.cell_line, rig.load_cell, clock, sink);
}

}  // namespace viscard
