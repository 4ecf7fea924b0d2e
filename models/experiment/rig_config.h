#pragma once

#include "models/experiment/calibration.h"

#include <string>

namespace viscard {

// The contents of rig.toml (data/demo/01_rig.toml is the commented example). SI.

// Relative standard uncertainty of a travel much shorter than a turn of an ordinary screw
// (rig/stages/README.md).
inline constexpr double kScrewDepth_u = 0.005;

// The stage and how it is connected.
struct StageConfig {
  // "grbl" | "zaber" | "apt" | "marlin" | "pi-gcs2" | "smc100"
  std::string driver = "grbl";
  std::string port;  // path; prefer /dev/serial/by-id/...
  int baud = 115200;
  char axis = 'Z';
  int toward_specimen = -1;  // sign of machine motion that presses into the specimen
  double travel_m = 10e-3;   // largest travel toward the specimen from the position at connection
  double backlash_m = 0.0;   // a note of the file: a warning, no effect
  // Standard uncertainty of the depth that an open-loop stage counts, relative: pitch of the screw,
  // and steps that the motor lags or loses unnoticed. A rig file that does not state it gets
  // kScrewDepth_u; 0: the depth is exact.
  double depth_relative_u = 0.0;
  // The controller's position from which `viscard rig` counts for a person; a test does not use it.
  double zero_m = 0.0;
  // The axis is homed before a run or a series, and again after its lift, to compare the count.
  bool home = false;
  // Length of the controller's smallest step, from the maker's page of the stage: of a microstep of
  // a Zaber or SMC100PP motor, of an encoder count or a microstep of an APT unit, which no controller
  // knows, or of an encoder count that a PI does not report.
  double microstep_m = 0.0;
  int device = 1;  // address on the chain
  int axis_number = 1;
  std::string port_place;  // "bench.toml:7", where a file states the port; for messages
};

// The load cell and how it is connected.
struct LoadCellConfig {
  // "hx711" | "adc" | "adc-frames" | "scpi" | "mark10" | "mark10-continuous" | "sauter" |
  // "mt-sics" | "sartorius"
  std::string driver = "hx711";
  std::string port;
  int baud = 115200;
  // "counts" | "micros,counts" | "millis,counts" | "volts" | "auto"
  std::string line_format = "auto";
  double expected_rate_Hz = 80.0;
  double volts_per_count = 0.0;  // of the converter
  // Instead of volts_per_count: the converter's name (models/experiment/converter.h), its gain and
  // its reference.
  std::string converter;
  double gain = 0.0;  // of the converter, a pure number
  double reference_V = 0.0;
  double span_V = 0.0;  // largest reading of either sign; 0: 2^23 counts, or 10 V for volts
  std::string frame;    // of "adc-frames": the fields of a frame (rig/protocols/binary_frame.h)
  bool compression_is_positive = true;
  std::string dialect = "34401a";  // of a SCPI multimeter (rig/protocols/gauge_protocols.h)
  // Unit of forces that are sent without one: "N", "mN", "gf" ... Empty: numbers of an hx711 are
  // counts or volts, and gauges are set to N.
  std::string unit;
  std::string framing = "8N1";  // data bits, parity (N E O), stop bits
  // ISO 8601: the day on which it answered a finger or a weight. Without it a run warns; required
  // if the last digit of its readings hides their noise, because equal readings then prove nothing.
  std::string answered_on;
  std::string port_place;  // as of the stage
};

// True for a converter behind a board that sends counts, or volts made of them.
inline bool has_converter(const LoadCellConfig& cell) {
  return cell.driver == "hx711" || cell.driver == "adc" || cell.driver == "adc-frames";
}

// True for an instrument that sends forces; its gain is then 1 unless dead weights give another.
inline bool measures_force(const LoadCellConfig& cell) {
  return cell.driver == "mark10" || cell.driver == "mark10-continuous" || cell.driver == "sauter" ||
         cell.driver == "mt-sics" || cell.driver == "sartorius" || !cell.unit.empty();
}

// What measures the temperature beside the specimen (rig/sensors/thermometer.h).
struct ThermometerConfig {
  // "none"; "text": sends lines on its own port; "scpi": is asked on its own port; "load-cell": its
  // lines, such as "T=23.4", come between those of the load cell.
  std::string driver = "none";
  std::string port;
  int baud = 9600;
  std::string framing = "8N1";
  std::string query = "MEAS:TEMP?";  // of "scpi"; "READ?" for one that is set up by hand
  double period_s = 1.0;             // between its lines, or between questions
  std::string unit = "degC";         // of numbers without one; or "degF", "K"
  double drift_limit_K = 1.0;        // a run that spans more is flagged
  std::string port_place;            // as of the stage
};

// True if anything measures the temperature.
inline bool has_thermometer(const ThermometerConfig& config) {
  return config.driver != "none" && !config.driver.empty();
}
// True for a thermometer that is connected by itself.
inline bool has_own_port(const ThermometerConfig& config) {
  return has_thermometer(config) && config.driver != "load-cell";
}

// Without a reading for so long it counts as silent, rig time.
inline double silent_after_s(const ThermometerConfig& config) {
  return config.period_s > 1.0 ? 5.0 * config.period_s : 5.0;
}

// Compliance of everything between the stage and the punch tip, including the load cell:
//   depth = stage position - contact position - force/stiffness.
struct FrameConfig {
  double stiffness_N_m = 0.0;         // 0: rigid
  double stiffness_relative_u = 0.0;  // standard uncertainty, relative
  std::string id;                     // name of the record
  std::string date;                   // ISO 8601
  std::string file;                   // of the record; empty after it has been read
};

// Forces at which a run is stopped, as shares of the capacity of the cell.
struct SafetyConfig {
  double warn_fraction = 0.70;  // of the cell's capacity
  double soft_fraction = 0.80;  // decelerating stop
  double hard_fraction = 0.95;  // immediate stop
};

// The whole rig.
struct RigConfig {
  std::string name;
  StageConfig stage;
  LoadCellConfig load_cell;
  ThermometerConfig thermometer;
  LoadCellCalibration calibration;
  FrameConfig frame;
  SafetyConfig safety;
  double clock_speed = 1.0;          // > 1 only for an emulated rig: its clock over the wall clock
  bool accepts_implausible = false;  // of values that no bench can have (plausible = "off")
};

}  // namespace viscard
