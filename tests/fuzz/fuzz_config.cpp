// The first byte chooses the kind of file. A file that can be read must be written and read again
// unchanged.
#include "io/config/config_file.h"

#include <cstdint>
#include <stdexcept>

namespace {

template <typename Config>
void round_trip(const std::string& text,
                Config (*from)(const std::string&, const std::string&, viscard::Plausible),
                std::string (*to)(const Config&)) {
  constexpr viscard::Plausible kJudged = viscard::Plausible::kOff;  // any number must be read again
  std::string written;
  try {
    written = to(from(text, "fuzz", kJudged));
  } catch (const std::runtime_error&) {
    return;
  }
  if (to(from(written, "written", kJudged)) != written) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace viscard;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      round_trip<RigConfig>(text, rig_from_toml, toml_from_rig);
      break;
    case 1:
      round_trip<TestPlan>(text, test_from_toml, toml_from_test);
      break;
    case 2:
      round_trip<Specimen>(text, specimen_from_toml, toml_from_specimen);
      break;
    default:
      try {
        truth_from_toml(text, "fuzz");  // no function writes a truth
      } catch (const std::runtime_error&) {
      }
      break;
  }
  return 0;
}
