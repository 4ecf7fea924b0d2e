#include "rig/open_devices.h"

#include "rig/cells/gauge_load_cell.h"
#include "rig/cells/hx711_load_cell.h"
#include "rig/lines/rig_error.h"
#include "rig/stages/grbl_stage.h"
#include "rig/stages/zaber_stage.h"

#include <string>

namespace viscard {

namespace {

using MakeStage = std::unique_ptr<Stage> (*)(Transport&, const StageConfig&, const RigClock&,
                                             const RecordSink&);

template <class Driver>
std::unique_ptr<Stage> made(Transport& transport, const StageConfig& config, const RigClock& clock,
                            const RecordSink& sink) {
  return std::make_unique<Driver>(transport, config, clock, sink);
}

struct StageDriver {
  const char* name;
  MakeStage make;
};

// One row per value of driver under [stage].
constexpr StageDriver kStages[] = {{"grbl", made<GrblStage>}, {"zaber", made<ZaberStage>}};

const StageDriver& stage_driver(const std::string& name) {
  std::string known;
  for (const StageDriver& driver : kStages) {
    if (name == driver.name) return driver;
    known += (known.empty() ? "" : ", ") + std::string(driver.name);
  }
  throw RigError("driver '" + name + "' under [stage] of the rig file is unknown; known are " +
                 known);
}

// A wrong word of the rig file is reported before a port that is missing: it is in any case wrong.
void check_words(const RigConfig& rig) {
  stage_driver(rig.stage.driver);
  if (rig.load_cell.driver == "hx711") {
    declared_hx711_format(rig.load_cell);
  } else {
    check_gauge_words(rig.load_cell);
  }
}

}  // namespace

std::unique_ptr<Stage> make_stage(Transport& transport, const StageConfig& config,
                                  const RigClock& clock, const RecordSink& sink) {
  return stage_driver(config.driver).make(transport, config, clock, sink);
}

std::unique_ptr<LoadCell> make_load_cell(Transport& transport, const LoadCellConfig& config,
                                         const RigClock& clock, const RecordSink& sink) {
  if (config.driver == "hx711") {
    return std::make_unique<Hx711LoadCell>(transport, config, clock, sink);
  }
  return std::make_unique<GaugeLoadCell>(transport, config, clock, sink);
}

RigDevices open_ports(const RigConfig& rig, const RigClock& clock) {
  check_words(rig);
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
