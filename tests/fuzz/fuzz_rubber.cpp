// Any bytes are read as a card of a law of rubber or refused by one exception with a text. The
// environment variable VISCARD_FUZZ_TARGET names the reader, else the first byte picks it.
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/hyperelastic/rubber_card.h"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

const std::string& reader(std::uint8_t first) {
  static const char* const name = std::getenv("VISCARD_FUZZ_TARGET");
  const auto& all = viscard::rubber_card_targets();
  static const std::string named = name != nullptr ? name : "";
  return name != nullptr ? named : all[first % all.size()];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  if (size < 1) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const RubberCheck check =
        check_rubber_card(text, nullptr, {.target = reader(data[0]), .units = "mm-t-s"});
    for (const CardFinding& finding : check.findings) {
      if (finding.name.empty() || finding.text.empty()) __builtin_trap();
    }
  } catch (const std::runtime_error& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  } catch (const std::invalid_argument& error) {
    if (std::string(error.what()).empty()) __builtin_trap();
  }
  return 0;
}
