#include "models/pillar/body/pillar_model.h"
#include "models/pillar/time/harmonic_response.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/readout.h"
#include "models/pillar/time/viscoelastic_pillar.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace viscard;

namespace {

Material soft(bool shear_only) {
  Material material;
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.terms = {{0.5, 0.5, 0.2}, {0.3, 0.3, 2.4}};
  if (shear_only) {
    for (MaterialTerm& term : material.terms) term.k = 0.0;
  }
  return material;
}

ViscoelasticPillar pillar_on_film(const Material& material) {
  PillarGeometry geometry;
  geometry.film = FilmGeometry{25e-6, 60e-6};
  return {geometry,
          {.degree = 4, .layers = 1},
          material,
          TopCondition::kPressure,
          isotropic_medium(2e9, 0.29, 1780.0)};
}

}  // namespace

TEST_CASE("reduced creep with a film and shear relaxation alone is the whole body's to 1e-5",
          "[pillar]") {
  const ViscoelasticPillar pillar = pillar_on_film(soft(true));
  const ReducedBody reduced = reduce_quasi_static(pillar.system(), {.tolerance = 1e-5});
  CHECK(reduced.basis.cols() <= 8);
  const Course history = {{0.0, 1.0}, {3.0, 1.0}, {3.0, 0.0}, {9.0, 0.0}};
  HistoryOptions options;
  options.tolerance = 1e-7;
  const HistoryResult small = run_history(reduced.system, Control::kForce, history, options);
  const HistoryResult whole = run_history(pillar.system(), Control::kForce, history, options);
  REQUIRE(small.time_s == whole.time_s);
  double largest = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < small.time_s.size(); ++i) {
    largest = std::max(largest, std::abs(small.displacement[i] - whole.displacement[i]));
    size = std::max(size, std::abs(whole.displacement[i]));
  }
  CAPTURE(reduced.basis.cols(), reduced.error, largest / size);
  CHECK(largest <= 1e-5 * size);
}

TEST_CASE("with constant Poisson ratio and no film one vector is exact", "[pillar]") {
  const ViscoelasticPillar pillar({}, {.degree = 3, .layers = 1}, soft(false),
                                  TopCondition::kPressure);
  const ReducedBody reduced = reduce_quasi_static(pillar.system(), {.tolerance = 1e-8});
  CHECK(reduced.basis.cols() == 1);
  CHECK(reduced.error <= 1e-8);
}

TEST_CASE("a dynamic basis stopped by its size limit reports that and its error", "[pillar]") {
  const PillarModel model({}, {.degree = 4, .layers = 1},
                          {isotropic_medium(1.8e6, 0.33, 965.0), {}}, {.motion = Motion::kLateral});
  const ViscoelasticSystem system = viscoelastic_system(model, soft(true), true);
  const Eigen::VectorXd load = unit_top_force(model);
  const double highest_rad_s = 2.0 * M_PI * 3e5;  // beyond four resonances
  double last_error = std::numeric_limits<double>::infinity();
  for (const int limit : {12, 24, 36}) {
    const ReducedBody small = reduce_dynamic(system, {load},
                                             {.lowest_rad_s = 1e3,
                                              .highest_rad_s = highest_rad_s,
                                              .tolerance = 1e-13,
                                              .largest_basis = limit});
    CAPTURE(limit, small.basis.cols(), small.error);
    CHECK(small.basis.cols() >= limit);
    CHECK(small.basis.cols() <= limit + 2);  // an answer of the whole body adds two at once
    CHECK(small.error > 1e-13);
    CHECK(small.error < last_error);
    last_error = small.error;
    for (const double share : {0.1, 0.53}) {
      const Eigen::VectorXcd whole = solve_harmonic(system, load, share * highest_rad_s);
      const Eigen::VectorXcd found =
          small.basis * solve_harmonic(small.system, small.load(load), share * highest_rad_s);
      CHECK((found - whole).norm() <= 3.0 * small.error * whole.norm());  // of another norm
    }
  }
}

TEST_CASE("an acceleration acts on the whole mass of the body", "[pillar]") {
  // Free to move, so that no mass is lost in the held nodes.
  const Motion motion = GENERATE(Motion::kLongitudinal, Motion::kLateral);
  const PillarModel model({}, {.degree = 3, .layers = 1}, {isotropic_medium(1.8e6, 0.3, 965.0), {}},
                          {.motion = motion, .fixed_bottom = false});
  const Eigen::VectorXd force = unit_acceleration_force(model);
  // Fields of the rigid motion of 1 m: w = 1, or b = 2 (a = 0).
  const int field = 1;
  const double amplitude = motion == Motion::kLateral ? 2.0 : 1.0;
  double mass = 0.0;
  double top = 0.0;
  const Eigen::VectorXd load = unit_top_force(model);
  for (int node = 0; node < model.system().section().node_count(); ++node) {
    const int dof = model.system().dofs().dof(field, node);
    if (dof < 0) continue;
    mass += amplitude * force[dof];
    top += amplitude * load[dof];
  }
  CHECK(mass == Approx(965.0 * M_PI * 20e-6 * 20e-6 * 120e-6).epsilon(1e-12));  // rounding
  CHECK(top == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("readings follow the circuit: decay, charge gain, division by the input's capacitance",
          "[pillar]") {
  const double C_F = 5e-15;
  Readout voltage{.resistance_Ohm = 1e12, .capacitance_F = 15e-15};
  const ReadoutFilter filter = readout_filter(voltage, C_F);
  CHECK(filter.gain == Approx(0.25).epsilon(1e-14));
  CHECK(filter.time_constant_s == Approx(0.02).epsilon(1e-14));
  // A step of the open voltage decays exponentially.
  const std::vector<double> reading = reading_of(filter, {0.0, 0.0, 0.02, 0.1}, {0, 8, 8, 8});
  CHECK(reading[1] == Approx(2.0).epsilon(1e-14));
  CHECK(reading[2] == Approx(2.0 * std::exp(-1.0)).epsilon(1e-14));
  CHECK(reading[3] == Approx(2.0 * std::exp(-5.0)).epsilon(1e-13));
  // A ramp settles at a T times its slope.
  CHECK(reading_of(filter, {0.0, 2.0}, {0.0, 10.0})[1] == Approx(0.25 * 0.02 * 5.0).epsilon(1e-12));
  // Half power at the corner.
  CHECK(std::abs(response(filter, 50.0)) == Approx(0.25 / std::sqrt(2.0)).epsilon(1e-14));
  Readout charge{.kind = ReadoutKind::kCharge, .resistance_Ohm = 1e9, .capacitance_F = 1e-12};
  CHECK(readout_filter(charge, C_F).gain == Approx(5e-3).epsilon(1e-14));
  CHECK(readout_filter(charge, C_F).time_constant_s == Approx(1e-3).epsilon(1e-14));
  // The film's own leakage: rho eps = 1e13 Ohm m * 12 eps_0, for any size.
  Readout open{.film_leakage_s = 1062.5};
  CHECK(readout_filter(open, C_F).time_constant_s == Approx(1062.5).epsilon(1e-12));
  CHECK(readout_filter(open, C_F).gain == 1.0);
  CHECK(readout_filter({}, C_F).time_constant_s == std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(readout_filter({.kind = ReadoutKind::kCharge}, C_F), std::invalid_argument);
  CHECK_THROWS_AS(readout_filter({.resistance_Ohm = -1.0}, C_F), std::invalid_argument);
}
