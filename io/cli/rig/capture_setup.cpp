#include "io/flow/capture_setup.h"

#include "io/cli/rig/capture_words.h"
#include "io/cli/words/streams.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

void check_repeats(const CaptureWords& words) {
  constexpr int kMost = 99;
  constexpr double kLongest_s = 86400.0;
  if (words.repeats < 1 || words.repeats > kMost) {
    throw UsageError(fmt::format("--repeat is {}; it must be from 1 to {}", words.repeats, kMost));
  }
  if (words.repeats > 1 && words.overwrite) {
    throw UsageError("--repeat numbers its captures and replaces none: omit --force");
  }
  if (!words.lift_wait_s) return;
  if (words.repeats == 1) throw UsageError("--lift-wait is between repeats: add --repeat N");
  if (!(*words.lift_wait_s >= 0.0) || *words.lift_wait_s > kLongest_s) {
    throw UsageError(fmt::format("--lift-wait is {} s; it must be from 0 to {} s (a day)",
                                 *words.lift_wait_s, kLongest_s));
  }
}

// Throws UsageError on a fault that is unknown. check_fault() compares its phase with those of the
// test.
RigFault fault_from_words(const CaptureWords& words) {
  if (!words.fault) return {};
  try {
    return rig_fault_from_text(*words.fault);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--") + error.what());
  }
}

}  // namespace

void check_words(const CaptureWords& words) {
  fault_from_words(words);
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
  check_repeats(words);
  const std::size_t n_truths = words.truth_files.size();
  if (n_truths > 1 && n_truths != words.specimen_files.size()) {
    throw UsageError(fmt::format("there are {} and {} --truth; give one for all, or one for each",
                                 counted(words.specimen_files.size(), "specimen"), n_truths));
  }
  if (words.is_emulated) return;
  if (n_truths > 0 || words.seed || words.fault || words.speed != 1.0) {
    throw UsageError("--truth, --seed, --speed and --fault are for an emulated rig: add --emulate");
  }
  if (!words.rig_file || !words.test_file || words.specimen_files.empty()) {
    throw UsageError(
        "capture needs --rig, --test and --specimen (or --emulate to try it without hardware)");
  }
}

CaptureSetup capture_setup(const CaptureWords& words, const SeriesStep& step) {
  SetupRequest request{words.rig_file,     words.test_file,         {},
                       step.specimen_file, words.is_emulated,       words.seed,
                       words.speed,        fault_from_words(words), std::max(1, step.touch),
                       words.plausible};
  const bool is_shared = words.truth_files.size() == 1;
  if (!words.truth_files.empty()) {
    request.truth_file = words.truth_files[is_shared ? 0 : step.specimen];
  }
  return setup_from_files(request);
}

}  // namespace viscard
