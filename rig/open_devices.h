#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/lines/tcp_line.h"
#include "rig/sensors/thermometer.h"
#include "rig/stages/stage.h"

#include <memory>
#include <string>
#include <vector>

namespace viscard {

// The driver that a rig file names, on an open transport. Throws RigError on an unknown driver; the
// message lists the known ones.
std::unique_ptr<Stage> make_stage(Transport& transport, const StageConfig& config,
                                  const RigClock& clock, const RecordSink& sink);
std::unique_ptr<LoadCell> make_load_cell(Transport& transport, const LoadCellConfig& config,
                                         const RigClock& clock, const RecordSink& sink);

// The words of driver, and a check of all words of a rig file that name devices: throws RigError. No port is opened.
std::vector<std::string> stage_drivers();
std::vector<std::string> load_cell_drivers();
void check_devices(const RigConfig& rig);

// The devices of a rig and their ports, destroyed in the right order.
struct RigDevices {
  std::unique_ptr<Transport> stage_line, cell_line;
  std::unique_ptr<Thermometer> thermometer;  // nullptr if the rig file names none
  std::unique_ptr<Stage> stage;
  std::unique_ptr<LoadCell> load_cell;
};

// The thermometer of a rig, with its own port if it has one; nullptr if the rig file names none. If
// its port cannot be opened, the thermometer reports the trouble and no exception is thrown.
std::unique_ptr<Thermometer> make_thermometer(const RigConfig& rig, const RigClock& clock,
                                              const RecordSink& sink);

// Opens the ports of stage and load cell. Throws RigError on an unknown driver or format, and with the reason why a port
// cannot be opened.
RigDevices open_ports(const RigConfig& rig, const RigClock& clock);
// Adds the drivers to the open ports, and the thermometer.
void add_drivers(RigDevices& devices, const RigConfig& rig, const RigClock& clock,
                 const RecordSink& sink);

}  // namespace viscard
