#include "io/flow/design/required_values.h"
#include "io/flow/design/single_bodies.h"
#include "models/array/layer/layer_scene.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/sensor/sensor_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr const char* kNoPillars = "a layer has no pillars";
constexpr const char* kNoLattice =
    "needs the area of one pillar: a full square or hexagonal lattice (model = \"space\")";

RequiredValue unanswered(const std::string& why) {
  return {.how = why};
}

RequiredValue answered(double value, double error, const std::string& how) {
  if (!std::isfinite(value) || !std::isfinite(error)) return unanswered("the value is not finite");
  return {true, value, error, how};
}

// Throws std::runtime_error if the answer has none.
const SceneResult& named(const SceneAnswer& answer, const std::string& name) {
  if (const SceneResult* found = result_in(answer, name)) return *found;
  throw std::runtime_error("the scene gives no " + name);
}

const SceneCurve& curve_named(const SceneAnswer& answer, const std::string& name) {
  if (const SceneCurve* found = curve_in(answer, name)) return *found;
  throw std::runtime_error("the scene gives no curve " + name);
}

// Of an answer that nobody keeps: a copy, or nothing.
SceneResult named(SceneAnswer&& answer, const std::string& name) {
  return named(std::as_const(answer), name);
}
const SceneCurve& curve_named(SceneAnswer&&, const std::string&) = delete;

bool relaxes(const PillarScene& one) {
  return !one.pillar.terms.empty();
}

// Pressure on the top at which one pillar buckles, with its long-term moduli: a load may stay. A strip
// has the formula of eq. E6, whose error is taken as its correction for shear.
RequiredValue buckling_of(PillarScene one, bool has_plate, const SceneSolver& solve) {
  one = long_term_scene(one);
  one.drive = BucklingDrive{has_plate};
  const std::string how = std::string(has_plate ? "under a level plate" : "with a free top") +
                          (relaxes(one) ? ", long-term moduli" : "");
  if (one.plane) {
    const double engesser_Pa = engesser_pressure_Pa(one);
    const double nu = one.pillar.nu;
    const double stiffer = *one.plane == PlaneState::kStrain ? 1.0 / (1.0 - nu * nu) : 1.0;
    const double euler_Pa = stiffer * euler_pressure_Pa(one, top_end(one));
    return answered(engesser_Pa, std::abs(euler_Pa - engesser_Pa), how + "; strip, eq. E6");
  }
  const SceneResult found = named(solve(one), "buckling_pressure");
  return answered(found.value, found.error_estimate, how);
}

}  // namespace

RequiredValue required_pillars_per_tactel(const Scene& scene, const Requirements& requirements,
                                          const SceneSolver&) {
  if (std::isnan(requirements.tactel_area_m2)) return unanswered("needs require.tactel_area");
  const auto cell_m2 = cell_area_m2(scene);
  if (!cell_m2) {
    return unanswered(std::holds_alternative<LayerScene>(scene) ? kNoPillars : kNoLattice);
  }
  return answered(requirements.tactel_area_m2 / *cell_m2, 0.0, "area over that of a cell, exact");
}

RequiredValue required_wavelength(const Scene& scene, const Requirements&,
                                  const SceneSolver& solve) {
  if (const auto* given = std::get_if<LayerScene>(&scene)) {
    LayerScene layer = *given;
    layer.wanted = {"half_wavelength"};
    const SceneResult found = named(solve(layer), "half_wavelength");
    return answered(found.value, found.error_estimate, "at half of the response to long waves");
  }
  const auto pitch_m = pitch_of(scene);
  if (!pitch_m) return unanswered("one pillar reads no pattern; it needs neighbours");
  return answered(2.0 * *pitch_m, 0.0, "two pitches (Nyquist), exact");
}

RequiredValue required_pressure(const Scene& scene, const Requirements& requirements,
                                const SceneSolver& solve) {
  const auto one = single_body(scene);
  if (!one) return unanswered("a layer does not buckle");
  const auto share = pressure_share(scene);
  if (!share) return unanswered(kNoLattice);
  RequiredValue found = buckling_of(*one, requirements.top == "plate", solve);
  found.value /= *share;
  found.error_estimate /= *share;
  if (*share != 1.0) found.how += fmt::format("; pillars bear {:.4g} times as much", *share);
  return found;
}

RequiredValue required_force(const Scene& scene, const Requirements& requirements,
                             const SceneSolver& solve) {
  if (std::isnan(requirements.tactel_area_m2)) return unanswered("needs require.tactel_area");
  if (single_body(scene) && !cell_area_m2(scene)) return unanswered(kNoLattice);
  RequiredValue found = required_pressure(scene, requirements, solve);
  found.value *= requirements.tactel_area_m2;
  found.error_estimate *= requirements.tactel_area_m2;
  return found;
}

RequiredValue required_bandwidth(const Scene& scene, const Requirements& requirements,
                                 const SceneSolver& solve) {
  auto one = single_body(scene);
  if (!one) return unanswered("the vibration of a layer is not computed");
  one->drive = ModalDrive{.modes = 1};
  const SceneAnswer answer = solve(*one);
  const SceneMode* lowest = nullptr;
  for (const SceneMode& mode : answer.modes) {
    if (lowest == nullptr || mode.frequency_Hz < lowest->frequency_Hz) lowest = &mode;
  }
  if (lowest == nullptr) return unanswered("no mode vibrates");
  // An oscillator without damping rises by 1/(1 - (f/f_1)^2) - 1: the most that it may.
  const double rise = requirements.bandwidth_error;
  const double share = std::sqrt(rise / (1.0 + rise));
  return answered(share * lowest->frequency_Hz, share * lowest->error_estimate,
                  fmt::format("{:.3g} % rise below {} {:.4g} Hz", 100.0 * rise, lowest->family,
                              lowest->frequency_Hz));
}

RequiredValue required_hysteresis(const Scene& scene, const Requirements& requirements,
                                  const SceneSolver& solve) {
  auto one = single_body(scene);
  if (!one) return unanswered("the hysteresis of a layer is not computed");
  if (!relaxes(*one)) {
    return unanswered("the pillars' material is elastic; name the file of a fit");
  }
  if (std::isnan(requirements.bandwidth_Hz) && std::isnan(requirements.lowest_frequency_Hz)) {
    return unanswered("needs require.bandwidth or require.lowest_frequency");
  }
  const double to_Hz = std::isnan(requirements.bandwidth_Hz) ? requirements.lowest_frequency_Hz
                                                             : requirements.bandwidth_Hz;
  const double from_Hz = std::isnan(requirements.lowest_frequency_Hz)
                             ? 1e-3 * to_Hz
                             : requirements.lowest_frequency_Hz;
  HarmonicDrive drive{.pressure_Pa = 1.0};
  constexpr int kPerDecade = 8;
  const int n = std::max(1, static_cast<int>(std::ceil(kPerDecade * std::log10(to_Hz / from_Hz))));
  for (int i = 0; i <= n && to_Hz > from_Hz; ++i) {
    drive.frequencies_Hz.push_back(from_Hz * std::pow(to_Hz / from_Hz, static_cast<double>(i) / n));
  }
  if (drive.frequencies_Hz.empty()) drive.frequencies_Hz = {to_Hz};
  one->drive = drive;
  const SceneAnswer answer = solve(*one);
  const SceneCurve& real = curve_named(answer, "top_displacement_real");
  const SceneCurve& imaginary = curve_named(answer, "top_displacement_imaginary");
  double largest = 0.0, error = 0.0, at_Hz = 0.0;
  for (std::size_t i = 0; i < real.x.size(); ++i) {
    const double tangent = std::abs(imaginary.value[i] / real.value[i]);
    if (tangent < largest) continue;
    largest = tangent;
    at_Hz = real.x[i];
    error = (imaginary.error.at(i) + tangent * real.error.at(i)) / std::abs(real.value[i]);
  }
  std::string how = fmt::format("pi tan d, largest at {:.3g} Hz", at_Hz);
  const std::size_t i_at =
      static_cast<std::size_t>(std::find(real.x.begin(), real.x.end(), at_Hz) - real.x.begin());
  // A peak may lie between two frequencies: the difference of the neighbours bounds the error.
  if (i_at > 0 && i_at + 1 < real.x.size()) {
    const double before = std::abs(imaginary.value[i_at - 1] / real.value[i_at - 1]);
    const double after = std::abs(imaginary.value[i_at + 1] / real.value[i_at + 1]);
    error += 0.25 * (largest - std::min(before, after));
  }
  return answered(std::numbers::pi * largest, std::numbers::pi * error, how);
}

RequiredValue required_nonlinearity(const Scene& scene, const Requirements& requirements,
                                    const SceneSolver& solve) {
  if (std::isnan(requirements.linear_to_Pa)) return unanswered("needs require.linear_to");
  auto one = single_body(scene);
  if (!one) return unanswered("a layer's large strains are not computed");
  const auto share = pressure_share(scene);
  if (!share) return unanswered(kNoLattice);
  one->drive = StaticDrive{.pressure_Pa = 1.0};
  const SceneResult found = named(solve(*one), "top_displacement");
  const double top_Pa = *share * requirements.linear_to_Pa;
  const double strain = std::abs(found.value) * top_Pa / one->geometry.length_m;
  const double own_error = found.error_estimate * top_Pa / one->geometry.length_m;
  // 1 (neo-Hookean) to 2.3 (St Venant-Kirchhoff) times the strain, depending on the law of the
  // rubber.
  constexpr double kLeast = 1.0, kMost = 2.3;
  return answered(0.5 * (kLeast + kMost) * strain,
                  0.5 * (kMost - kLeast) * strain + kMost * own_error,
                  fmt::format("1 to 2.3 times the strain of {:.3g} %", 100.0 * strain));
}

RequiredValue required_collapse_margin(const Scene& scene, const Requirements&,
                                       const SceneSolver&) {
  const auto one = single_body(scene);
  if (!one) return unanswered(kNoPillars);
  SensorMaterial material;
  material.young_modulus_Pa = long_term_scene(*one).pillar.E0_Pa;
  material.poisson_ratio = one->pillar.nu;
  const double d_m = one->geometry.diameter_m;
  double stands_m = std::numeric_limits<double>::infinity();
  std::string how = "eq. D4, formula";
  if (const auto* row = std::get_if<ArrayScene>(&scene)) {
    material.surface_energy_J_m2 = row->surface_energy_J_m2;
    stands_m = longest_unmatted_m(d_m, row->geometry.spacing_m, material);
    how = "eq. D3 and D4, formulas";
  } else if (const auto* array = std::get_if<SpaceScene>(&scene)) {
    material.surface_energy_J_m2 = array->surface_energy_J_m2;
    if (array->pillars.size() > 1) {
      stands_m = longest_unmatted_m(d_m, smallest_gap_m(*array), material);
      how = "eq. D3 and D4, formulas";
    }
  }
  stands_m = std::min(stands_m, longest_upright_m(d_m, material));
  const double margin = stands_m / one->geometry.length_m;
  // From gamma, 0.0198 to 0.022 J/m2 of PDMS, to the power 1/3 to 2/3.
  return answered(margin, 0.04 * margin, how);
}

}  // namespace viscard
