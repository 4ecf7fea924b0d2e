#include "rig/open_devices.h"

#include "models/maths/text_of_number.h"
#include "rig/cells/frame_load_cell.h"
#include "rig/cells/gauge_load_cell.h"
#include "rig/cells/hx711_load_cell.h"
#include "rig/cells/mark10_stream.h"
#include "rig/lines/port_probe.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/tcp_port.h"
#include "rig/stages/apt_stage.h"
#include "rig/stages/grbl_stage.h"
#include "rig/stages/marlin_stage.h"
#include "rig/stages/pi_stage.h"
#include "rig/stages/smc_stage.h"
#include "rig/stages/zaber_stage.h"

#include <cstddef>
#include <string>
#include <utility>

namespace viscard {
namespace {

template <class Device, class Config>
using Make = std::unique_ptr<Device> (*)(Transport&, const Config&, const RigClock&,
                                         const RecordSink&);

template <class Device, class Driver, class Config>
std::unique_ptr<Device> made(Transport& transport, const Config& config, const RigClock& clock,
                             const RecordSink& sink) {
  return std::make_unique<Driver>(transport, config, clock, sink);
}

// One row per value of driver. check throws RigError on words that the driver does not know, before
// a port is opened.
template <class Device, class Config>
struct DriverRow {
  const char* name;
  Make<Device, Config> make;
  void (*check)(const Config&);
  // The device sends text lines by itself, so a thermometer can share its port.
  bool sends_lines = false;
};

// The length of a count or microstep decides how far the stage goes. 0: the driver asks for it.
void check_microstep(const StageConfig& stage) {
  constexpr double kLongest_m = 100e-6;
  if (stage.microstep_m <= kLongest_m) return;
  throw RigError(
      "microstep under [stage] of the rig file is " + text_from_number(stage.microstep_m * 1e3, 4) +
      " mm, and no stage has steps so long. Give its unit, such as microstep = \"0.05 um\"");
}

constexpr DriverRow<Stage, StageConfig> kStages[] = {
    {"grbl", made<Stage, GrblStage, StageConfig>, check_microstep},
    {"zaber", made<Stage, ZaberStage, StageConfig>, check_microstep},
    {"apt", made<Stage, AptStage, StageConfig>, check_microstep},
    {"marlin", made<Stage, MarlinStage, StageConfig>, check_microstep},
    {"pi-gcs2", made<Stage, PiStage, StageConfig>, check_microstep},
    {"smc100", made<Stage, SmcStage, StageConfig>, check_microstep}};

constexpr DriverRow<LoadCell, LoadCellConfig> kCells[] = {
    {"hx711", made<LoadCell, Hx711LoadCell, LoadCellConfig>,
     [](const LoadCellConfig& cell) { declared_hx711_format(cell); }, true},
    {"adc", made<LoadCell, Hx711LoadCell, LoadCellConfig>,
     [](const LoadCellConfig& cell) { declared_hx711_format(cell); }, true},
    {"adc-frames", made<LoadCell, FrameLoadCell, LoadCellConfig>, check_frame_words},
    {"scpi", made<LoadCell, GaugeLoadCell, LoadCellConfig>, check_gauge_words},
    {"mark10", made<LoadCell, GaugeLoadCell, LoadCellConfig>, check_gauge_words},
    {"mark10-continuous", made<LoadCell, Mark10Stream, LoadCellConfig>, check_mark10_words, true},
    {"sauter", made<LoadCell, GaugeLoadCell, LoadCellConfig>, check_gauge_words},
    {"mt-sics", made<LoadCell, GaugeLoadCell, LoadCellConfig>, check_gauge_words},
    {"sartorius", made<LoadCell, GaugeLoadCell, LoadCellConfig>, check_gauge_words}};

template <class Row, std::size_t n>
const Row& row_of(const Row (&rows)[n], const std::string& name, const std::string& section) {
  std::string known;
  for (const Row& row : rows) {
    if (name == row.name) return row;
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw RigError("driver '" + name + "' under [" + section +
                 "] of the rig file is unknown; known are " + known);
}

template <class Row, std::size_t n>
std::vector<std::string> names_of(const Row (&rows)[n]) {
  std::vector<std::string> names;
  for (const Row& row : rows) names.emplace_back(row.name);
  return names;
}

// "bench.toml:7: port under [stage]".
template <class Config>
std::string port_of(const char* section, const Config& device) {
  const std::string key = std::string("port under [") + section + "]";
  return device.port_place.empty() ? key + " of the rig file" : device.port_place + ": " + key;
}

// The port of a device; a port that cannot be opened is named with its place.
template <class Config, class... Framing>
std::unique_ptr<Transport> line_of(const char* section, const Config& device, const RigClock& clock,
                                   const Framing&... framing) {
  try {
    return open_line(device.port, device.baud, clock, framing...);
  } catch (const PortUnavailable& error) {
    throw PortUnavailable(port_of(section, device) + ": " + error.what());
  }
}

// Two names of one port, such as a link under /dev/serial/by-id and its device, are found, too.
void check_own_ports(const RigConfig& rig) {
  const auto refuse_same = [](const char* first, const auto& one, const char* second,
                              const auto& other) {
    if (one.port.empty() || real_port(one.port) != real_port(other.port)) return;
    throw RigError(port_of(second, other) + " '" + other.port + "' is the same port as that of [" +
                   first + "], '" + one.port +
                   "'. Each device has its own; those present are listed by: viscard rig list");
  };
  refuse_same("stage", rig.stage, "load_cell", rig.load_cell);
  if (!has_own_port(rig.thermometer)) return;
  refuse_same("stage", rig.stage, "thermometer", rig.thermometer);
  refuse_same("load_cell", rig.load_cell, "thermometer", rig.thermometer);
}

}  // namespace

std::vector<std::string> stage_drivers() {
  return names_of(kStages);
}

std::vector<std::string> load_cell_drivers() {
  return names_of(kCells);
}

// A wrong word of the rig file is reported before a missing port, because the word must be
// corrected in any case.
void check_devices(const RigConfig& rig) {
  const auto check_port = [](const char* section, const auto& device) {
    if (!is_tcp_port(device.port) || tcp_address(device.port)) return;
    throw RigError(port_of(section, device) + " '" + device.port + "' " +
                   trouble_of_tcp_port(device.port));
  };
  check_port("stage", rig.stage);
  check_port("load_cell", rig.load_cell);
  const auto check_messages = [](const char* section, const auto& device) {
    if (is_usbtmc_port(device.port) && device.driver != "scpi") {
      throw RigError(port_of(section, device) + " '" + device.port +
                     "' is USB-TMC, which carries SCPI. Use it with driver = \"scpi\", or give '" +
                     device.driver + "' its own port");
    }
  };
  check_messages("stage", rig.stage);
  check_messages("load_cell", rig.load_cell);
  if (has_own_port(rig.thermometer)) check_messages("thermometer", rig.thermometer);
  row_of(kStages, rig.stage.driver, "stage").check(rig.stage);
  const auto& cell = row_of(kCells, rig.load_cell.driver, "load_cell");
  cell.check(rig.load_cell);
  check_thermometer_words(rig.thermometer);
  if (rig.thermometer.driver == "load-cell" && !cell.sends_lines) {
    throw RigError(
        "driver = \"load-cell\" under [thermometer] of the rig file needs a load cell that "
        "sends lines by itself; '" +
        rig.load_cell.driver + "' is polled. Give the thermometer a port of its own");
  }
  check_own_ports(rig);
}

std::unique_ptr<Stage> make_stage(Transport& transport, const StageConfig& config,
                                  const RigClock& clock, const RecordSink& sink) {
  return row_of(kStages, config.driver, "stage").make(transport, config, clock, sink);
}

std::unique_ptr<LoadCell> make_load_cell(Transport& transport, const LoadCellConfig& config,
                                         const RigClock& clock, const RecordSink& sink) {
  return row_of(kCells, config.driver, "load_cell").make(transport, config, clock, sink);
}

std::unique_ptr<Thermometer> make_thermometer(const RigConfig& rig, const RigClock& clock,
                                              const RecordSink& sink) {
  const ThermometerConfig& config = rig.thermometer;
  check_thermometer_words(config);
  if (!has_thermometer(config)) return nullptr;
  std::unique_ptr<Transport> line;
  std::string trouble;
  try {
    if (has_own_port(config)) {
      line = line_of("thermometer", config, clock, config.framing);
    }
  } catch (const RigError& error) {
    trouble = std::string("the thermometer is missing: ") + error.what();
  }
  return std::make_unique<Thermometer>(std::move(line), trouble, config, clock, sink);
}

RigDevices open_ports(const RigConfig& rig, const RigClock& clock) {
  check_devices(rig);
  RigDevices devices;
  devices.stage_line = line_of("stage", rig.stage, clock);
  devices.cell_line = line_of("load_cell", rig.load_cell, clock, rig.load_cell.framing);
  return devices;
}

void add_drivers(RigDevices& devices, const RigConfig& rig, const RigClock& clock,
                 const RecordSink& sink) {
  devices.stage = make_stage(*devices.stage_line, rig.stage, clock, sink);
  devices.load_cell = make_load_cell(*devices.cell_line, rig.load_cell, clock, sink);
  devices.thermometer = make_thermometer(rig, clock, sink);
  Thermometer* shared = devices.thermometer.get();
  if (shared == nullptr || !shared->is_shared()) return;
  devices.load_cell->set_other_lines(
      [shared](const ReceivedLine& line) { return shared->take_shared_line(line); });
}

}  // namespace viscard
