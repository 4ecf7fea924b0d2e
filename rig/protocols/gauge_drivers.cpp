#include "rig/protocols/gauge_drivers.h"

#include "rig/lines/rig_error.h"
#include "rig/protocols/force_gauge_protocols.h"
#include "rig/protocols/scpi_protocol.h"

namespace viscard {
namespace {

struct GaugeDriver {
  const char* name;
  GaugeProtocol (*protocol)(const LoadCellConfig&);
};

// One row per value of driver under [load_cell], apart from "hx711".
constexpr GaugeDriver kDrivers[] = {
    {"scpi", [](const LoadCellConfig& config) { return scpi_protocol(config.dialect); }},
    {"mark10", [](const LoadCellConfig& config) { return mark10_protocol(config.unit); }},
    {"sauter", [](const LoadCellConfig& config) { return sauter_protocol(config.unit); }}};

}  // namespace

GaugeProtocol gauge_protocol(const LoadCellConfig& config) {
  std::string known = "hx711";
  for (const GaugeDriver& driver : kDrivers) {
    if (config.driver == driver.name) return driver.protocol(config);
    known += std::string(", ") + driver.name;
  }
  throw RigError("driver '" + config.driver +
                 "' under [load_cell] of the rig file is unknown; known are " + known);
}

}  // namespace viscard
