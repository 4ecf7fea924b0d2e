#include "models/experiment/converter.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

constexpr double kLargestCode = 8388607.0;  // 2^23 - 1
constexpr double kCodes = 16777216.0;       // 2^24

struct Converter {
  const char* name;
  double volts_per_count;  // for a reference of 1 V and a gain of 1
  std::span<const double> gains;
};

constexpr std::array<double, 7> kGains1256{1, 2, 4, 8, 16, 32, 64};
constexpr std::array<double, 4> kGains1232{1, 2, 64, 128};
constexpr std::array<double, 8> kGains7802{1, 2, 4, 8, 16, 32, 64, 128};
constexpr std::array<double, 3> kGains711{32, 64, 128};

constexpr std::array<Converter, 4> kConverters{{{"ads1256", 2.0 / kLargestCode, kGains1256},
                                                {"ads1232", 0.5 / kLargestCode, kGains1232},
                                                {"nau7802", 1.0 / kCodes, kGains7802},
                                                {"hx711", 1.0 / kCodes, kGains711}}};

const Converter& converter_of(const std::string& name) {
  std::string known;
  for (const Converter& converter : kConverters) {
    if (name == converter.name) return converter;
    known += (known.empty() ? "" : ", ") + std::string(converter.name);
  }
  throw std::invalid_argument("load_cell.converter is '" + name + "'; known are " + known +
                              ". For another one give volts_per_count");
}

}  // namespace

double volts_per_count_of(const LoadCellConfig& cell) {
  const Converter& converter = converter_of(cell.converter);
  if (std::find(converter.gains.begin(), converter.gains.end(), cell.gain) ==
      converter.gains.end()) {
    std::string gains;
    for (const double gain : converter.gains) {
      gains += (gains.empty() ? "" : ", ") + text_from_number(gain, 0);
    }
    throw std::invalid_argument("load_cell.gain is " + text_of(cell.gain) + "; an " +
                                cell.converter + " has a gain of " + gains);
  }
  if (!(cell.reference_V >= 0.1 && cell.reference_V <= 6.0)) {
    throw std::invalid_argument("load_cell.reference is " + text_of(cell.reference_V) +
                                " V; expected 0.1 to 6 V, the reference of the converter (for "
                                "ads1232, nau7802 and hx711 usually the excitation of the bridge)");
  }
  return converter.volts_per_count * cell.reference_V / cell.gain;
}

}  // namespace viscard
