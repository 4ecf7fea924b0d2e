// Any bytes are read as the medium of a film or refused by one exception with a text. A medium that
// can be read is finite and stays so in what the readers of scenes make of it.
#include "io/materials/piezo_file.h"
#include "models/pillar/system/rotated_medium.h"

#include <cstdint>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  MediumFile file;
  try {
    file = medium_from_json({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const std::runtime_error&) {
    return 0;
  }
  const auto is_finite = [](const Medium& medium) {
    return medium.stiffness_Pa.allFinite() && medium.piezo_C_m2.allFinite() &&
           medium.permittivity_F_m.allFinite() && medium.rho_kg_m3 >= 0.0;
  };
  for (const Medium& medium : {file.medium, averaged_about_z(file.medium)}) {
    if (!is_finite(medium) || !is_finite(with_reversed_poling(medium))) __builtin_trap();
  }
  is_isotropic_about_z(file.medium);
  return 0;
}
