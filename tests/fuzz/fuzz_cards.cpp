// Any bytes are read as a card or refused by one exception with a text. The environment variable
// VISCARD_FUZZ_TARGET names the reader, else the first byte picks it; the second byte decides whether
// the card is compared with a material.
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

const viscard::Material& reference() {
  static const viscard::Material material = [] {
    viscard::Material out;
    out.name = "PDMS";
    out.E0_Pa = 1.88e6;
    out.nu = 0.495;
    out.rho_kg_m3 = 965.0;
    out.terms = {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}};
    return out;
  }();
  return material;
}

const viscard::CardTarget& reader(std::uint8_t first) {
  static const char* const name = std::getenv("VISCARD_FUZZ_TARGET");
  const auto& all = viscard::card_targets();
  return name != nullptr ? viscard::card_target(name) : all[first % all.size()];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  if (size < 2) return 0;
  const CardTarget& target = reader(data[0]);
  const std::string text(reinterpret_cast<const char*>(data) + 2, size - 2);
  try {
    const CardCheck check =
        check_card(text, target, {.units = "mm-t-s"}, data[1] % 2 == 0 ? &reference() : nullptr);
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
