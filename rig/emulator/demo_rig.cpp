#include "rig/emulator/demo_rig.h"

#include "models/maths/text_of_number.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

constexpr double kCapacity_N = 0.250 * 9.80665;

struct RatioRow {
  double ratio;
  double E0_Pa;
  std::vector<MaterialTerm> terms;
};

// Instantaneous modulus and relative Prony terms (g, k = g, tau) of PDMS, base to curing agent.
const std::vector<RatioRow>& ratio_rows() {
  static const std::vector<RatioRow> rows{
      {10.0, 1.88e6, {{0.008206, 0.008206, 0.1945}, {0.01386, 0.01386, 2.403}}},
      {13.0, 1.65e6, {{0.01251, 0.01251, 0.1588}, {0.01355, 0.01355, 1.686}}},
      {20.0, 1.45e6, {{0.01219, 0.01219, 0.2247}, {0.01913, 0.01913, 2.581}}}};
  return rows;
}

const RatioRow& row_of(double mixing_ratio) {
  for (const RatioRow& row : ratio_rows()) {
    if (row.ratio == mixing_ratio) return row;
  }
  throw std::invalid_argument("no emulated PDMS of mixing ratio " + text_of(mixing_ratio) +
                              ":1; choose 10, 13 or 20, or give a truth file");
}

PunchContact demo_contact() {
  return {.punch_radius_m = 2.2e-3, .layer_thickness_m = 11e-3, .poisson_ratio = 0.495};
}

}  // namespace

RigConfig demo_rig() {
  RigConfig rig;
  rig.name = "emulated";
  rig.stage.depth_relative_u = 0.0;  // the emulated stage moves as far as it counts
  rig.load_cell.line_format = "micros,counts";
  rig.load_cell.volts_per_count = 20.0 / 16777216.0;  // 24 bits over -10 V to +10 V
  rig.calibration.volts_per_newton = 0.7255;
  rig.calibration.capacity_N = kCapacity_N;
  rig.calibration.id = "emulated";
  rig.frame.stiffness_N_m = 10e3;
  rig.frame.stiffness_relative_u = 0.02;
  return rig;
}

EmulatedTruth demo_truth(double mixing_ratio, std::uint64_t seed) {
  const RatioRow& row = row_of(mixing_ratio);
  EmulatedTruth truth;
  truth.material.name = "PDMS 1:" + std::to_string(static_cast<int>(mixing_ratio));
  truth.material.E0_Pa = row.E0_Pa;
  truth.material.nu = 0.495;
  truth.material.rho_kg_m3 = 965.0;
  truth.material.terms = row.terms;
  truth.contact = demo_contact();
  truth.surface_position_m = 1.0e-3 + 0.1e-6 * static_cast<double>((seed * 37) % 101);
  truth.force_noise_N = 0.0002 * kCapacity_N;
  truth.force_offset_N = 0.02;
  truth.drift_relative_per_s = 1e-6;
  truth.overload_N = 1.5 * kCapacity_N;
  truth.seed = seed;
  return truth;
}

Specimen demo_specimen(double mixing_ratio) {
  Specimen specimen;
  specimen.id = "pdms_1to" + std::to_string(static_cast<int>(mixing_ratio));
  specimen.material = "PDMS";
  specimen.mixing_ratio = mixing_ratio;
  specimen.contact = demo_contact();
  specimen.modulus_guess_Pa = row_of(mixing_ratio).E0_Pa;
  specimen.rho_kg_m3 = 965.0;
  return specimen;
}

}  // namespace viscard
