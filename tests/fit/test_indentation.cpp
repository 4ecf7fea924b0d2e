#include "fit/assembly/stage_specimen.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a slow ramp biases a step fit, but not a fit of the history", "[fit]") {
  const double ramp_s = GENERATE(1.0, 5.0);
  CAPTURE(ramp_s);
  const IndentationData data =
      indentation_of(s2(), even_times(1000.0, 0.1), ramp_and_hold(ramp_s), 1e-3, 21);
  FitOptions options;
  options.n_terms = 2;
  const FitResult exact = fit_indentation(data, options);
  REQUIRE(exact.terms.size() == 2);
  // Three standard errors; the seed is fixed. After a slow ramp little of E_1 is left to see, and
  // the interval shows that.
  CHECK(std::abs(exact.E0_Pa - 1.8) < 3.0 * exact.E0_se_Pa);
  CHECK(std::abs(exact.terms[0].modulus_Pa - 0.12) < 3.0 * exact.terms[0].modulus_se_Pa);
  CHECK(exact.E0_se_Pa < 0.02);

  RelaxationData step;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    if (data.time_s[i] < ramp_s) continue;
    step.time_s.push_back(data.time_s[i] - ramp_s);
    step.value.push_back(data.force_N[i] / 1e-4);
  }
  const FitResult biased = fit_relaxation(step, options);
  // The part of E_1 left after relaxation during the ramp is (tau/t_R)(1 - exp(-t_R/tau)): 57 % and
  // 16 % for tau = 0.8 s (Oyen, Phil. Mag. 86 (2006) 5625).
  const double left = 0.8 / ramp_s * (1.0 - std::exp(-ramp_s / 0.8));
  CHECK(biased.terms[0].modulus_Pa == Approx(0.12 * left).epsilon(0.1));
}

TEST_CASE("the fit of a ramp and hold gives the known effective moduli", "[fit]") {
  // E0 1.88 MPa, g 0.008206 and 0.01386, tau 0.1945 and 2.403 s: force over depth is 1.847789124
  // MPa at 3 s after a ramp of 1 s, and 1.843283901 MPa at 7 s after a ramp of 5 s. The fit of
  // noise-free data must reproduce these values.
  const double E0 = 1.88;
  const PronySeries truth{E0 * (1 - 0.008206 - 0.01386),
                          {{E0 * 0.008206, 0.1945}, {E0 * 0.01386, 2.403}}};
  const double ramp_s = GENERATE(1.0, 5.0);
  const IndentationData data =
      indentation_of(truth, even_times(20.0, 0.02), ramp_and_hold(ramp_s), 0.0, 1);
  FitOptions options;
  options.n_terms = 2;
  const FitResult fit = fit_indentation(data, options);
  REQUIRE(fit.terms.size() == 2);
  const double t = ramp_s == 1.0 ? 3.0 : 7.0;
  double effective = fit.E_inf_Pa;
  for (const FittedTerm& term : fit.terms) {
    effective += term.modulus_Pa * term.tau_s / ramp_s * (1.0 - std::exp(-ramp_s / term.tau_s)) *
                 std::exp(-(t - ramp_s) / term.tau_s);
  }
  CHECK(effective == Approx(ramp_s == 1.0 ? 1.847789124 : 1.843283901).epsilon(3e-10));
}

TEST_CASE("contact that differs from the table's zero of depth is found", "[fit]") {
  // The stage first moves 20 um in air; depth in the table counts from the start of the stage.
  auto depth = [](double t) { return 1e-4 * std::min(t, 1.2) - 2e-5; };
  IndentationData data = indentation_of(s2(), even_times(60.0, 0.01), depth, 1e-3, 22);
  for (double& d : data.depth_m) d += 2e-5;
  for (double& force : data.force_N) force += 3e-5;  // zero offset of the load cell
  FitOptions options;
  options.n_terms = 2;
  const FitResult fit = fit_indentation(data, options);
  REQUIRE(fit.contact_position_m);
  CHECK(*fit.contact_position_m == Approx(2e-5).epsilon(5e-3));
  CHECK(fit.E0_Pa == Approx(1.8).epsilon(5e-3));
  CHECK(fit.is_stiffness);
}

TEST_CASE("geometry converts stiffness to modulus, and its uncertainty is reported separately",
          "[fit]") {
  IndentationData data = indentation_of(s2(), even_times(60.0, 0.02), ramp_and_hold(1.0), 1e-3, 23);
  const double stiffness = fit_indentation(data).E0_Pa;
  data.contact = PunchContact{.punch_radius_m = 2.2e-3,
                              .layer_thickness_m = 11e-3,
                              .poisson_ratio = 0.495,
                              .punch_radius_u_m = 22e-6};
  const FitResult fit = fit_indentation(data);
  CHECK_FALSE(fit.is_stiffness);
  CHECK(fit.E0_Pa * force_per_modulus_and_depth_m(*data.contact) ==
        Approx(stiffness).epsilon(1e-9));
  // 1 % for the radius, and kappa grows with the radius too.
  CHECK(fit.systematic_relative > 0.01);
  CHECK(fit.systematic_relative < 0.02);
  REQUIRE(fit.two_point);
  // Between E_inf and E0. The half-space value lacks the factor kappa = 1.277 (frictionless, a/H =
  // 0.2).
  CHECK(fit.two_point->modulus_Pa < fit.E0_Pa);
  CHECK(fit.two_point->modulus_Pa > fit.E_inf_Pa);
  CHECK(fit.two_point->half_space_modulus_Pa ==
        Approx(fit.two_point->modulus_Pa * layer_factor(*data.contact)).epsilon(1e-12));
}

TEST_CASE("a frame in series is removed exactly", "[fit]") {
  const PronySeries specimen{14000.0, {{150.0, 0.2}, {200.0, 2.4}}};
  // Adds the spring by its compliance and removes it by the function.
  RetardationSpectrum compliance = retardation_from_relaxation(specimen);
  compliance.instantaneous_compliance_1_Pa += 1.0 / 10e3;
  const PronySeries back = specimen_series(relaxation_from_retardation(compliance), 10e3);
  CHECK(back.equilibrium_modulus_Pa == Approx(14000.0).epsilon(1e-10));
  REQUIRE(back.terms.size() == 2);
  CHECK(back.terms[0].modulus_Pa == Approx(150.0).epsilon(1e-9));
  CHECK(back.terms[1].relaxation_time_s == Approx(2.4).epsilon(1e-9));
  CHECK_THROWS_WITH(specimen_series({20e3, {}}, 10e3), Catch::Contains("frame stiffness"));
}

TEST_CASE("a gap in the ramp and a saturated converter are flagged", "[fit]") {
  IndentationData data = indentation_of(s2(), even_times(60.0, 0.02), ramp_and_hold(1.0), 1e-3, 24);
  SECTION("gap") {
    IndentationData gap;
    for (std::size_t i = 0; i < data.time_s.size(); ++i) {
      if (data.time_s[i] > 0.3 && data.time_s[i] < 0.7) continue;
      gap.time_s.push_back(data.time_s[i]);
      gap.depth_m.push_back(data.depth_m[i]);
      gap.force_N.push_back(data.force_N[i]);
    }
    const FitResult fit = fit_indentation(gap);
    CHECK(has_flag(fit, "gap-in-ramp"));
    CHECK_FALSE(fit.is_trustworthy);
  }
  SECTION("saturation") {
    for (double& force : data.force_N) force = std::min(force, 1.7e-4);
    const FitResult fit = fit_indentation(data);
    CHECK(has_flag(fit, "saturated"));
    CHECK_FALSE(fit.is_trustworthy);
  }
}
