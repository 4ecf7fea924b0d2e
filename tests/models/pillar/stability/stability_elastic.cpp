#include "models/pillar/body/pillar_modes.h"
#include "tests/models/pillar/stability/stability_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard::test {
namespace {

constexpr double kModulus_Pa = 1.8e6;
constexpr double kPressure_Pa = 1e3;
const Discretisation kCoarse{.degree = 5, .layers = 2};
const Discretisation kFine{.degree = 8, .layers = 4};

PillarMedia media(double nu, const std::optional<FilmGeometry>& film, double contrast = 1111.0) {
  PillarMedia out{isotropic_medium(kModulus_Pa, nu, 965.0), std::nullopt};
  if (film) out.film = isotropic_medium(contrast * kModulus_Pa, 0.29, 1780.0);
  return out;
}

double top_m(const PillarModel& model, PillarState* state = nullptr) {
  const Eigen::VectorXd traction = model.top_traction();
  PillarState answer = model.solve(-kPressure_Pa * traction);
  const double top = traction.dot(answer.unknowns) / traction.sum();
  if (state != nullptr) *state = std::move(answer);
  return top;
}

double mesh_error(const PillarGeometry& geometry, const PillarMedia& of, Discretisation coarse,
                  Discretisation fine) {
  const PillarModel a(geometry, coarse, of, {});
  const PillarModel b(geometry, fine, of, {});
  return std::abs(top_m(a) / top_m(b) - 1.0);
}

// Largest difference of the pressure on a lattice of points that includes neighbours within each
// element, over the pressure applied; a checkerboard shows here and nowhere in the displacement.
// The rim, where the exact stress is infinite, is left out.
double pressure_error(double nu) {
  const PillarModel coarse({}, kCoarse, media(nu, {}), {});
  const PillarModel fine({}, kFine, media(nu, {}), {});
  PillarState a, b;
  top_m(coarse, &a);
  top_m(fine, &b);
  double worst = 0.0;
  for (int i = 1; i <= 9; ++i) {
    for (int j = 0; j <= 12; ++j) {
      const double x = 0.098 * i * coarse.radius_m();
      const double z = (0.004 + 0.0779 * j) * coarse.geometry().length_m;
      const auto pressure = [&](const PillarModel& model, const PillarState& state) {
        const SectionElement& e = model.element_at(x, z, kPillarRegion);
        return -model.stress_at(state, e, x, z).head(3).sum() / 3.0;
      };
      worst = std::max(worst, std::abs(pressure(coarse, a) - pressure(fine, b)));
    }
  }
  return worst / kPressure_Pa;
}

double buckled_error() {
  const auto share = [](const Discretisation& mesh) {
    const PillarModel axial({}, mesh, media(.33, {}), {.motion = Motion::kLongitudinal});
    const PillarModel lateral({}, mesh, media(.33, {}), {.motion = Motion::kLateral});
    const double critical_Pa = buckling(axial, lateral).pressure_Pa;
    return modes_under_pressure(axial, lateral, 0.999 * critical_Pa, 1).front().frequency_Hz;
  };
  return std::abs(share(kCoarse) / share({.degree = 7, .layers = 3}) - 1.0);
}

double slender_buckling_error() {
  const PillarGeometry geometry{.diameter_m = 40e-6, .length_m = 4e-3};
  const Discretisation mesh{.degree = 6, .layers = 2, .shaft_elements = 6};
  const PillarModel axial(geometry, mesh, media(.33, {}), {.motion = Motion::kLongitudinal});
  const PillarModel lateral(geometry, mesh, media(.33, {}), {.motion = Motion::kLateral});
  const double pi = std::acos(-1.0);
  return std::abs(buckling(axial, lateral).pressure_Pa / (pi * pi * kModulus_Pa / (64.0 * 1e4)) -
                  1.0);
}

}  // namespace

std::vector<StabilityCase> elastic_stability_cases() {
  std::vector<StabilityCase> cases;
  for (const char* nu : {"0.33", "0.45", "0.49", "0.499", "0.4999", "0.499999", "0.5"}) {
    const double value = std::stod(nu);
    cases.push_back({fmt::format("Poisson ratio {}: displacement", nu),
                     [=] { return mesh_error({}, media(value, {}), kCoarse, kFine); }, 9e-5});
    cases.push_back({fmt::format("Poisson ratio {}: pressure at 117 points", nu),
                     [=] { return pressure_error(value); }, 1e-2});
  }
  for (const double ratio : {1e-3, 1e-1, 1.0, 10.0}) {
    cases.push_back({fmt::format("film {:g} diameters thick", ratio),
                     [=] {
                       PillarGeometry geometry;
                       geometry.film = FilmGeometry{ratio * geometry.diameter_m, 60e-6};
                       return mesh_error(geometry, media(.4, geometry.film), kCoarse, kFine);
                     },
                     3e-4});
  }
  for (const auto& [aspect, bound] :
       {std::pair{0.1, 3e-3}, {1.0, 1.5e-3}, {10.0, 1.5e-4}, {100.0, 1.5e-5}}) {
    cases.push_back({fmt::format("pillar {:g} diameters long", aspect),
                     [=, aspect = aspect] {
                       Discretisation coarse = kCoarse;
                       Discretisation fine = kFine;
                       coarse.shaft_elements = fine.shaft_elements = aspect > 5.0 ? 6 : 2;
                       return mesh_error({.length_m = aspect * 40e-6}, media(.4, {}), coarse, fine);
                     },
                     bound});
  }
  for (const double contrast : {1.0, 1e3, 1e5, 1e7}) {
    cases.push_back({fmt::format("film {:g} times as stiff as the pillar", contrast),
                     [=] {
                       PillarGeometry geometry;
                       geometry.film = FilmGeometry{25e-6, 60e-6};
                       return mesh_error(geometry, media(.4, geometry.film, contrast), kCoarse,
                                         kFine);
                     },
                     6e-4});
  }
  cases.push_back({"film 1e7 times as stiff is a rigid base",
                   [] {
                     PillarGeometry geometry;
                     geometry.film = FilmGeometry{25e-6, 60e-6};
                     const PillarModel film(geometry, kCoarse, media(.4, geometry.film, 1e7), {});
                     const PillarModel rigid({}, kCoarse, media(.4, {}), {});
                     return std::abs(top_m(film) / top_m(rigid) - 1.0);
                   },
                   5e-8});
  cases.push_back({"frequency at 99.9 % of the buckling load", buckled_error, 5e-4});
  cases.push_back(
      {"buckling of a pillar 100 diameters long: Euler", slender_buckling_error, 1.9e-3});
  return cases;
}

}  // namespace viscard::test
