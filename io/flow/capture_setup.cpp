#include "io/flow/capture_setup.h"

#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/config/config_file.h"
#include "io/flow/command_error.h"
#include "models/experiment/test_phases.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_touch.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

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

// How long the plan lets a phase last; nothing for one that lasts as long as it needs.
std::optional<double> planned_duration_s(const TestPhase& phase) {
  using Kind = TestPhase::Kind;
  if (phase.kind == Kind::kWait || phase.kind == Kind::kHoldForce) return phase.duration_s;
  if (phase.kind == Kind::kMove && phase.move_s > 0.0) return phase.move_s;
  return std::nullopt;
}

}  // namespace

CaptureSetup setup_from_files(const SetupRequest& request) {
  CaptureSetup setup;
  setup.rig = request.rig_file ? read_rig(*request.rig_file, request.plausible) : demo_rig();
  setup.plan = request.test_file ? read_test(*request.test_file, request.plausible) : TestPlan{};
  setup.specimen = request.specimen_file.empty()
                       ? demo_specimen(10.0)
                       : read_specimen(request.specimen_file, request.plausible);
  if (!request.is_emulated) return setup;
  setup.truth = request.truth_file ? read_truth(*request.truth_file)
                                   : truth_like(setup.specimen, request.seed.value_or(1));
  setup.fault = request.fault;
  if (request.seed) setup.truth->seed = *request.seed;
  setup.truth = truth_of_touch(*setup.truth, setup.specimen.id, request.touch);
  setup.rig.load_cell.expected_rate_Hz = setup.truth->sample_rate_Hz;
  if (setup.rig.load_cell.volts_per_count == 0.0) {
    setup.rig.load_cell.volts_per_count = demo_rig().load_cell.volts_per_count;
  }
  setup.rig.clock_speed = request.speed;
  return setup;
}

void check_fault(const RigFault& fault, const TestPlan& plan) {
  if (fault.kind == RigFaultKind::kNone || fault.phase.empty()) return;
  std::vector<std::string> names{"connect"};
  if (fault.phase == names.front()) return;
  for (const TestPhase& phase : phases_from_plan(plan)) {
    names.push_back(phase.name);
    if (phase.name != fault.phase) continue;
    const auto lasts_s = planned_duration_s(phase);
    if (!lasts_s || fault.after_s <= *lasts_s) return;
    throw std::invalid_argument(fmt::format(
        "fault '{}@{}+{:g}' comes too late: the phase '{}' of this test lasts {:g} s; give "
        "fewer seconds, or a later phase",
        name_of(fault.kind), fault.phase, fault.after_s, fault.phase, *lasts_s));
  }
  throw std::invalid_argument("fault '" + name_of(fault.kind) + "@" + fault.phase +
                              "': this test has no phase '" + fault.phase + "'" +
                              did_you_mean(fault.phase, names) + " It has " + listed(names));
}

Preflight safe_preflight(const CaptureSetup& setup) {
  Preflight expected = preflight(setup.rig, setup.plan, setup.specimen);
  if (!expected.problems.empty()) throw CodedError("preflight", expected.problems.front());
  return expected;
}

std::string refuse_expired_calibration(const LoadCellCalibration& calibration) {
  std::string trouble = calibration_trouble(calibration, today());
  if (!trouble.empty() && !last_valid_day(calibration).empty()) {
    throw CodedError("calibration", trouble + "; or add --uncalibrated to capture without one");
  }
  return trouble;
}

}  // namespace viscard
