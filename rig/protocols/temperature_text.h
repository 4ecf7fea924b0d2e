#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// The temperature in one line of a thermometer, in degrees Celsius; nothing for another line.
//
// A line is a number ("23.4", "+2.34000000E+01"), or a name and a number ("T=23.4", "temp: 23.4",
// "Temperature (C): 23.4 C"), of which the first number behind the name is taken. A unit may follow
// ("23.4 C", "74.1 degF", "296.6 K", a degree sign in UTF-8 or Latin 1). unit: of numbers without
// one, "degC", "degF" or "K".
//
// Numbers that mean "no reading" are none: 9.9E37 and above (SCPI-1999, 7.2.1.4), -127 (a DS18B20
// that is not connected; DallasTemperature, DEVICE_DISCONNECTED_C), nan, and anything outside -200 to
// 1000 degC.
std::optional<double> temperature_C_from_text(std::string_view line, const std::string& unit);

// True for a line that begins with the name of a temperature: between the readings of a load cell
// only such a line is one.
bool names_temperature(std::string_view line);

// True for "degC", "degF" and "K".
bool is_temperature_unit(std::string_view unit);

}  // namespace viscard
