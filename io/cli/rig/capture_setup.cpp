#include "io/cli/rig/capture_words.h"
#include "io/cli/words/streams.h"
#include "io/config/config_file.h"
#include "models/maths/text_of_number.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_touch.h"

#include <fmt/format.h>

#include <algorithm>

namespace viscard {
namespace {

constexpr double kFastest = 500.0;

// An emulated specimen with the geometry of the specimen file. The material is PDMS of the
// demonstration if the mixing ratio is one of its three, otherwise its relaxation with the guessed
// modulus.
EmulatedTruth truth_like(const Specimen& specimen, std::uint64_t seed) {
  const bool is_known = specimen.mixing_ratio == 13.0 || specimen.mixing_ratio == 20.0;
  EmulatedTruth truth = demo_truth(is_known ? specimen.mixing_ratio : 10.0, seed);
  if (!is_known && specimen.mixing_ratio != 10.0 && specimen.modulus_guess_Pa > 0.0) {
    truth.material.name = specimen.material;
    truth.material.E0_Pa = specimen.modulus_guess_Pa;
  }
  truth.contact = specimen.contact;
  truth.material.nu = specimen.contact.poisson_ratio;
  return truth;
}

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

}  // namespace

void check_words(const CaptureWords& words) {
  if (words.out_file.empty()) {
    throw UsageError("capture needs --out FILE, the capture file to write");
  }
  if (words.resumes && words.overwrite) {
    throw UsageError("--resume keeps what is there and --force replaces it: give one of them");
  }
  if (!(words.speed > 0.0) || words.speed > kFastest) {
    throw UsageError(
        fmt::format("--speed is {}; it must be above 0 and at most {}", words.speed, kFastest));
  }
  check_repeats(words);
  const std::size_t n_truths = words.truth_files.size();
  if (n_truths > 1 && n_truths != words.specimen_files.size()) {
    throw UsageError(fmt::format("there are {} and {} --truth; give one for all, or one for each",
                                 counted(words.specimen_files.size(), "specimen"), n_truths));
  }
  if (words.is_emulated) return;
  if (n_truths > 0 || words.seed || words.speed != 1.0) {
    throw UsageError("--truth, --seed and --speed are for an emulated rig: add --emulate");
  }
  if (!words.rig_file || !words.test_file || words.specimen_files.empty()) {
    throw UsageError(
        "capture needs --rig, --test and --specimen (or --emulate to try it without hardware)");
  }
}

CaptureSetup capture_setup(const CaptureWords& words, const SeriesStep& step) {
  const std::string& specimen_file = step.specimen_file;
  CaptureSetup setup;
  setup.rig = words.rig_file ? read_rig(*words.rig_file) : demo_rig();
  setup.plan = words.test_file ? read_test(*words.test_file) : TestPlan{};
  setup.specimen = specimen_file.empty() ? demo_specimen(10.0) : read_specimen(specimen_file);
  if (!words.is_emulated) return setup;
  const bool is_shared = words.truth_files.size() == 1;
  setup.truth = words.truth_files.empty()
                    ? truth_like(setup.specimen, words.seed.value_or(1))
                    : read_truth(words.truth_files[is_shared ? 0 : step.specimen]);
  if (words.seed) setup.truth->seed = *words.seed;
  setup.truth = truth_of_touch(*setup.truth, setup.specimen.id, std::max(1, step.touch));
  setup.rig.load_cell.expected_rate_Hz = setup.truth->sample_rate_Hz;
  if (setup.rig.load_cell.volts_per_count == 0.0) {
    setup.rig.load_cell.volts_per_count = demo_rig().load_cell.volts_per_count;
  }
  setup.rig.clock_speed = words.speed;
  return setup;
}

}  // namespace viscard
