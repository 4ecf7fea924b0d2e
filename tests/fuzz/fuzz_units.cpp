// Any text is read as a quantity or refused by one exception with a text.
#include "io/basics/units.h"

#include <cstdint>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* unit : {"m", "N", "degC", "Hz", "1", "V/N"}) {
    try {
      (void)si_from_text(text, unit);
    } catch (const std::invalid_argument&) {
    }
  }
  return 0;
}
