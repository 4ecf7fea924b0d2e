#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// One answer of an instrument that is polled.
struct GaugeAnswer {
  std::optional<double> volts;    // reading of a multimeter ...
  std::optional<double> force_N;  // ... or of a force gauge, positive in compression
  bool is_overload = false;       // the instrument reports that its range is exceeded
  std::string unit;               // as sent; empty if none was sent
  std::string error;              // the text of a refusal; empty otherwise
};

// How to poll one kind of instrument; knows no port. There is one such row per instrument.
struct GaugeProtocol {
  std::string name;
  std::vector<std::string> opening;  // sent one by one when connecting; none is answered
  std::string identity_query;        // empty: the instrument has no identity
  std::string query;                 // asks for one reading
  std::string error_query;           // sent once after the opening; empty: none
  std::string closing;               // sent at the end
  std::string zero;  // makes the force that acts its zero; empty: the driver has no such command
  std::vector<std::string> zeroed;  // how its answer then begins; empty: it is not answered
  // How its answer begins if it is refused, in capitals. A late answer to `query` begins
  // otherwise.
  std::vector<std::string> zero_refused;
  // Length of answers without a terminator, bytes; 0: answers are lines.
  std::size_t fixed_length = 0;
  // Returns nothing for text that is no answer.
  std::function<std::optional<GaugeAnswer>(std::string_view)> parse;
};

// A multimeter on RS-232 that measures the amplifier's output. Sources: HP 34401A User's Guide, ch.
// 4; libsigrok, src/hardware/scpi-dmm/api.c; SCPI-1999.
//
// dialect: "34401a" (HP, Agilent, Keysight and most bench meters), "gdm" (GW-Instek GDM-82xx, query
// VAL1?), "owon" (XDM, query MEAS1?). Throws RigError on another word.
GaugeProtocol scpi_protocol(const std::string& dialect);

// "+1.77900000E+00", or several readings separated by commas, of which the last is the
// newest. 9.9E37 and above means out of range (SCPI-1999, 7.2.1.4).
std::optional<GaugeAnswer> parse_scpi_reading(std::string_view line);

// The answer to SYST:ERR?, such as "+0,\"No error\"".
struct ScpiError {
  int code = 0;
  std::string text;
};
std::optional<ScpiError> parse_scpi_error(std::string_view line);

// Mark-10 series 4, 5 and 7. The query is "?" and CR. The answer is "-18.78 lbF" or, with the unit
// switched off in the gauge's menu, a number alone, to which `unit` applies. Answers such as "*10"
// are errors, as is that of series 3 and 4 to Z, which zeroes a series 5 or 7. Source: Mark-10 Series
// 4/5/7 user's guides, "Communications". Compression is positive
// unless the gauge's polarity was inverted. Throws RigError on an unknown unit.
GaugeProtocol mark10_protocol(const std::string& unit);
// The continuous mode of series 5 and 7 and of model 7i (rig/cells/mark10_stream.h). The smallest of
// the gauge's rates that is at least expected_Hz, or its largest; and the command that sets it (0:
// stops).
int mark10_stream_rate_Hz(double expected_Hz);
std::string mark10_stream_command(int rate_Hz);
std::optional<GaugeAnswer> parse_mark10_reading(std::string_view line, const std::string& unit);

// Sauter FH and FL. The query is the byte "9". The answer is 7 ASCII bytes without terminator, such
// as "0011.70": the first is 0 in compression and 1 in tension, the rest is the absolute value. The
// unit is not sent. The parser returns compression as positive. Source: Sauter FH interface
// description. Throws RigError on an unknown unit.
GaugeProtocol sauter_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_sauter_reading(std::string_view bytes, const std::string& unit);

// Balances, which weigh the force on their pan; compression is positive. unit: of readings that bear none, g
// unless the rig file names another. Throws RigError on an unknown one. A balance filters for 0.1 to 2 s: its
// readings limit a slow test, and no fast approach.
//
// Mettler Toledo MT-SICS. The query is "SI"; the answer is "S S     100.00 g" at rest, "S D ..." in motion, "S +"
// above and "S -" below the range, "S I" if it is busy; ES, ET, EL and "S S Error 10b" are errors. "@" cancels
// what was begun. "ZI" zeroes it, answered "ZI D" or "ZI S". Source: MT-SICS Reference Manual, "Commands and responses".
GaugeProtocol mt_sics_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_mt_sics_reading(std::string_view line, const std::string& unit);

// Sartorius SBI. The query is ESC P; the answer has 16 characters, "+   123.56 g  ", or 22 with a label of six
// before them; without a unit the balance is not at rest, digits in brackets are not verified. H or High is above
// the range, L or Low below it. ESC V zeroes it without an answer. Source: Sartorius, operating instructions, "Data interface" (SBI).
GaugeProtocol sartorius_protocol(const std::string& unit);
std::optional<GaugeAnswer> parse_sartorius_reading(std::string_view line, const std::string& unit);

// The unit of a gauge that does not send one; N unless the rig file names another. Throws RigError if
// that is unknown.
std::string checked_gauge_unit(const std::string& unit);

// Newtons in one unit of force as balances and force gauges write it: N mN kN gf kgf ozf lbf, p
// (pond), and mg g kg oz lb lbs for the weight of that mass. Case does not matter, except that MN is
// refused. Returns nothing for another word.
// Source: BIPM SI Brochure (standard gravity 9.80665 m/s2); NIST SP 811, B.8 (pound, ounce).
std::optional<double> newtons_per_unit(std::string_view unit);

}  // namespace viscard
