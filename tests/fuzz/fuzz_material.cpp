// Any bytes are read as a material or refused by one exception with a text; a material is written
// and read again unchanged.
#include "io/materials/material_file.h"

#include <cstdint>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  std::string written;
  try {
    written =
        json_from_material(material_from_json({reinterpret_cast<const char*>(data), size}, "fuzz"));
  } catch (const std::runtime_error&) {
    return 0;
  }
  if (json_from_material(material_from_json(written, "written")) != written) __builtin_trap();
  return 0;
}
