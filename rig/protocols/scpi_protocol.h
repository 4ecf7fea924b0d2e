#pragma once

#include "rig/protocols/gauge_protocol.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

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

}  // namespace viscard
