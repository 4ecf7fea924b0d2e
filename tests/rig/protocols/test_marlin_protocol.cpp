#include "rig/protocols/marlin_protocol.h"

#include <catch2/catch.hpp>

#include <map>
#include <string>

namespace viscard {

TEST_CASE("lines to Marlin have the documented checksums", "[rig]") {
  CHECK(format_marlin_line(0, "M110 N0") == "N0 M110 N0*125\n");
  CHECK(format_marlin_line(1, "G91") == "N1 G91*16\n");
  CHECK(format_marlin_line(2, "G1 Z-0.25 F3") == "N2 G1 Z-0.25 F3*49\n");
  CHECK(format_marlin_line(3, "M400") == "N3 M400*36\n");
  CHECK(format_marlin_line(4, "M114") == "N4 M114*35\n");
  CHECK(format_marlin_move('Z', -0.02, 12.0) == "G1 Z-0.02000 F12.000");
}

TEST_CASE("answers of Marlin are distinguished from all it says besides", "[rig]") {
  for (const char* line : {"ok", "ok\r", "ok N5 P15 B3", "ok T:20.1 /0.0"}) {
    INFO(line);
    CHECK(is_marlin_ok(line));
  }
  for (const char* line : {"okay", "echo:ok", "wait", "", "Resend: 3", "// ok", "T:20.1 /0.0"}) {
    INFO(line);
    CHECK_FALSE(is_marlin_ok(line));
  }
  CHECK(parse_marlin_resend("Resend: 12") == 12);
  CHECK(parse_marlin_resend("Resend:7\r") == 7);
  CHECK_FALSE(parse_marlin_resend("Resend: x"));
  CHECK_FALSE(parse_marlin_resend("Resend: -1"));
  CHECK(is_marlin_start("start"));
  CHECK(is_marlin_start("echo:Marlin 2.1.2"));
  CHECK(is_marlin_start("Marlin 1.1.0-RCBugFix"));
  CHECK_FALSE(is_marlin_start("FIRMWARE_NAME:Marlin 2.1.2"));
  CHECK(is_marlin_busy("echo:busy: processing"));
  CHECK(is_marlin_endstop("echo:endstops hit:  Z:1.00"));
  CHECK(parse_marlin_error("Error:Printer halted. kill() called!") ==
        "Printer halted. kill() called!");
  CHECK_FALSE(parse_marlin_error("Error:checksum mismatch, Last Line: 3"));
  CHECK(parse_marlin_echo("echo:Unknown command: \"M999 S\"") == "Unknown command: \"M999 S\"");
  CHECK(parse_marlin_echo("// action:cancel") == "action:cancel");
}

TEST_CASE("the steps of an axis are read behind Count", "[rig]") {
  const std::string line = "X:0.00 Y:127.00 Z:145.00 E:0.00 Count X: 0 Y:10160 Z:116000";
  CHECK(parse_marlin_count(line, 'X') == 0);
  CHECK(parse_marlin_count(line, 'Y') == 10160);
  CHECK(parse_marlin_count(line, 'Z') == 116000);
  CHECK(parse_marlin_count("X:0 Count X:-5 Y:0 Z:-42\r", 'Z') == -42);
  CHECK_FALSE(parse_marlin_count(line, 'A'));
  CHECK_FALSE(parse_marlin_count("X:0.00 Y:127.00 Z:145.00 E:0.00", 'Z'));
  CHECK_FALSE(parse_marlin_count("Count X: 0 Y:1 Z:12x", 'Z'));
}

TEST_CASE("Marlin names its firmware, its capabilities and its settings", "[rig]") {
  CHECK(parse_marlin_firmware("FIRMWARE_NAME:Marlin 2.1.2 (Feb  1 2023) SOURCE_CODE_URL:github.com/"
                              "MarlinFirmware/Marlin PROTOCOL_VERSION:1.0") ==
        "Marlin 2.1.2 (Feb  1 2023)");
  CHECK(parse_marlin_firmware("FIRMWARE_NAME:Prusa-Firmware 3.9 based on Marlin FIRMWARE_URL:x") ==
        "Prusa-Firmware 3.9 based on Marlin");
  CHECK_FALSE(parse_marlin_firmware("echo:Marlin 2.1.2"));
  CHECK(has_marlin_emergency_parser("Cap:EMERGENCY_PARSER:1"));
  CHECK_FALSE(has_marlin_emergency_parser("Cap:EMERGENCY_PARSER:0"));
  std::map<std::string, double> settings;
  for (const char* line : {"echo:  M92 X80.00 Y80.00 Z800.00 E385.00", "echo: M203 X150.00 Z6.00",
                           " M201 X750 Y750 Z100 E3000", "echo:; M92 Z1 is a comment",
                           "echo:  M204 P750.00 R3000.00 T750.00 ; accelerations",
                           "M205 Z0.40 E5.00", "echo:  M92 Zx"}) {
    add_marlin_settings(line, settings);
  }
  CHECK(settings.at("M92Z") == 800.0);
  CHECK(settings.at("M203Z") == 6.0);
  CHECK(settings.at("M201Z") == 100.0);
  CHECK(settings.at("M204T") == 750.0);
  CHECK(settings.count("M205Z") == 0);
}

}  // namespace viscard
