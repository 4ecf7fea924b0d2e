#include "io/materials/plausible_numbers.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

void refuse_implausible(const std::string& file, const std::string& key, const Quantity& quantity,
                        double value, Plausible judged) {
  const auto doubt = doubt_about(quantity, value, judged);
  if (!doubt) return;
  throw BadNumber(
      file + ": " + key + " " +
      doubt->with_remedy("write \"" + key + "\": " + text_of(doubt->value * doubt->meant_factor),
                         "use --plausible off"));
}

void refuse_implausible(const std::string& file, const Material& material, Plausible judged) {
  refuse_implausible(file, "E0_Pa", quantities::kModulus, material.E0_Pa, judged);
  refuse_implausible(file, "nu", quantities::kPoissonRatio, material.nu, judged);
  refuse_implausible(file, "rho_kg_m3", quantities::kDensity, material.rho_kg_m3, judged);
  if (!material.T_ref_C) return;
  refuse_implausible(file, "T_ref_C", quantities::kTemperature, *material.T_ref_C, judged);
}

bool accepts_implausible(const std::vector<MaterialFlag>& flags) {
  return std::any_of(flags.begin(), flags.end(),
                     [](const MaterialFlag& flag) { return flag.name == kPlausibleOff; });
}

void flag_plausible_off(std::vector<MaterialFlag>& flags) {
  if (!accepts_implausible(flags)) flags.push_back({kPlausibleOff, 0, kPlausibleOffText});
}

}  // namespace viscard
