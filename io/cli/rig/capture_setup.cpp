#include "io/flow/capture_setup.h"

#include "io/cli/rig/capture_words.h"
#include "io/cli/words/streams.h"

#include <fmt/format.h>

namespace viscard {
void check_words(const CaptureWords& words) {
  if (words.out_file.empty()) {
    throw UsageError("capture needs --out FILE, the capture file to write");
  }
  if (words.resumes && words.overwrite) {
    throw UsageError("--resume keeps what is there and --force replaces it: give one of them");
  }
  if (!(words.speed > 0.0) || words.speed > kFastestEmulation) {
    throw UsageError(fmt::format("--speed is {}; it must be above 0 and at most {}", words.speed,
                                 kFastestEmulation));
  }
  if (words.is_emulated) return;
  if (words.truth_file || words.seed || words.speed != 1.0) {
    throw UsageError("--truth, --seed and --speed are for an emulated rig: add --emulate");
  }
  if (!words.rig_file || !words.test_file || words.specimen_files.empty()) {
    throw UsageError(
        "capture needs --rig, --test and --specimen (or --emulate to try it without hardware)");
  }
}

CaptureSetup capture_setup(const CaptureWords& words, const std::string& specimen_file) {
  return setup_from_files({words.rig_file, words.test_file, words.truth_file, specimen_file,
                           words.is_emulated, words.seed, words.speed});
}

}  // namespace viscard
