#pragma once

#include "rig/protocols/gauge_protocol.h"

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// A multimeter on RS-232 that reads the amplifier's output. Sources: HP 34401A User's Guide, ch. 4;
// libsigrok, src/hardware/scpi-dmm/api.c; SCPI-1999.
//
// dialect: "34401a" (HP, Agilent, Keysight and most bench meters), "gdm" (GW-Instek GDM-82xx, asked
// by VAL1?), "owon" (XDM, asked by MEAS1?). Throws RigError on another word.
GaugeProtocol scpi_protocol(const std::string& dialect);

// "+1.77900000E+00", one or several separated by commas: the last is the newest. 9.9E37 and above
// means out of range (SCPI-1999, 7.2.1.4).
std::optional<GaugeAnswer> parse_scpi_reading(std::string_view line);

// "+0,\"No error\"" of SYST:ERR?.
struct ScpiError {
  int code = 0;
  std::string text;
};
std::optional<ScpiError> parse_scpi_error(std::string_view line);

}  // namespace viscard
