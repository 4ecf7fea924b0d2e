#include "rig/lines/who_answers.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/line_splitter.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace viscard {
namespace {

constexpr const char* kNeeded =
    ", which this driver cannot use. The stage needs GRBL 1.1, grblHAL, Marlin, Zaber ASCII, "
    "Thorlabs APT, PI GCS 2 or Newport SMC100";
constexpr const char* kController =
    ": set driver and baud under [stage] of the rig file for it, unless the ports of stage and "
    "load cell are swapped";
constexpr const char* kSwapped = ": are the ports of stage and load cell swapped in the rig file?";

struct Speaker {
  const char* sign;  // in lower case, anywhere in a line
  const char* name;
  const char* remedy;
};
// Welcome lines of the firmware: Marlin (MarlinCore.cpp: "start", "echo:Marlin"), TinyG and g2core (JSON
// with "fv", the firmware version), Smoothieware ("Smoothie"), Repetier, RepRapFirmware, GRBL (report.c:
// "Grbl 1.1f ['$' for help]", "<Idle|MPos:"), Zaber ASCII replies ("@01 0 OK IDLE"),
// PI GCS 2 ("*IDN?"), Newport SMC100 ("VE": "1VE SMC_CC").
constexpr std::array<Speaker, 14> kSpeakers{{{"marlin", "Marlin", kController},
                                             {"tinyg", "TinyG", kNeeded},
                                             {"g2core", "g2core", kNeeded},
                                             {"\"fv\":", "TinyG or g2core", kNeeded},
                                             {"{\"r\":", "TinyG or g2core", kNeeded},
                                             {"smoothie", "Smoothieware", kNeeded},
                                             {"repetier", "Repetier", kNeeded},
                                             {"reprapfirmware", "RepRapFirmware", kNeeded},
                                             {"echo:", "the firmware of a 3-D printer", kNeeded},
                                             {"grbl ", "a GRBL controller", kController},
                                             {"|mpos:", "a GRBL controller", kController},
                                             {" ok idle ", "a Zaber controller", kController},
                                             {"physik instrumente", "a PI controller", kController},
                                             {"smc_", "a Newport controller", kController}}};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Numbers with separators and a short unit at most, such as "8388607", "12.5 g" or "1042,-31".
bool is_reading(const std::string& line) {
  const auto n_digits =
      std::count_if(line.begin(), line.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto n_letters =
      std::count_if(line.begin(), line.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  return n_digits >= 1 && n_digits > n_letters &&
         line.find_first_of("<>[]{}@$") == std::string::npos;
}

}  // namespace

std::string who_answers(const std::vector<std::string>& lines) {
  std::size_t n = 0, n_readings = 0, n_ok = 0;
  for (const std::string& line : lines) {
    const std::string text = lower(std::string(trimmed(line)));
    if (text.empty()) continue;
    for (const Speaker& one : kSpeakers) {
      if (text.find(one.sign) != std::string::npos) {
        return std::string("This is ") + one.name + one.remedy;
      }
    }
    ++n;
    n_readings += is_reading(text) ? 1 : 0;
    n_ok += text == "ok" || text == "start" ? 1 : 0;
  }
  if (n == 0) return "";
  if (n_ok == n)
    return std::string("This is a G-code controller that does not speak as GRBL") + kNeeded;
  if (2 * n_readings > n) return std::string("These are readings, as of a load cell") + kSwapped;
  return "";
}

std::string quoted_lines(const std::vector<std::string>& lines) {
  constexpr std::size_t kMost = 3;
  std::string quoted;
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i) {
    quoted += (i == 0 ? "It sent '" : ", '") + shown_bytes(lines[i]) + "'";
  }
  return quoted.empty() ? "" : quoted + ". ";
}

}  // namespace viscard
