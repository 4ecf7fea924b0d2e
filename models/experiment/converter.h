#pragma once

#include "models/experiment/rig_config.h"

namespace viscard {

// Volts at the input of a 24-bit converter for one count, from its name, gain and reference:
//   ads1256   2 V_ref/(gain (2^23 - 1))      TI ADS1256 data sheet (SBAS288), "Data Format"
//   ads1232   0.5 V_ref/(gain (2^23 - 1))    TI ADS1232 data sheet (SBAS350), "Data Format"
//   nau7802   V_ref/(gain 2^24)              Nuvoton NAU7802 data sheet, "ADC Output": +-0.5 V_ref/gain
//   hx711     V_ref/(gain 2^24)              Avia HX711 data sheet: full scale +-0.5 AVDD/gain
// V_ref of the last three is usually the excitation of the bridge. Throws std::invalid_argument on an
// unknown name, a gain that the converter does not have, or a reference outside 0.1 to 6 V.
double volts_per_count_of(const LoadCellConfig& cell);

}  // namespace viscard
