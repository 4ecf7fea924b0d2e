// The worked example of fit/README.md, compiled and run.
#include "fit/fit_relaxation.h"
#include "models/material/prony_series.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

TEST_CASE("the worked example of the C++ interface", "[fit]") {
  // A strip held at constant strain for 200 s, ten readings a second, noise of 0.2 %.
  viscard::RelaxationData data;
  for (int i = 1; i <= 2000; ++i) {
    const double t = 0.1 * i;
    const double noise = 2e-3 * std::sin(12.9898 * i + 78.233 * i * i);
    data.time_s.push_back(t);
    data.value.push_back(1.5e6 + 0.3e6 * std::exp(-t / 5.0) + 1.8e6 * noise);
  }

  viscard::FitOptions options;
  options.with_profiles = true;  // asymmetric intervals of E_inf and the times
  const viscard::FitResult fit = viscard::fit_relaxation(data, options);

  std::printf("E_inf %.4g Pa (%.4g to %.4g)\n", fit.E_inf_Pa, fit.E_inf_interval_95.low,
              fit.E_inf_interval_95.high);
  for (const viscard::FittedTerm& term : fit.terms) {
    std::printf("g %.4f, tau %.3g s (%.3g to %.3g)\n", term.g, term.tau_s, term.tau_s_95.low,
                term.tau_s_95.high);
  }
  const viscard::Material material = viscard::material_from_fit(fit, 0.495, 965.0);

  REQUIRE(fit.terms.size() == 1);
  CHECK(fit.E_inf_Pa == Approx(1.5e6).epsilon(1e-3));
  CHECK(fit.terms[0].tau_s == Approx(5.0).epsilon(0.03));
  CHECK(fit.is_trustworthy);
  CHECK(material.E0_Pa == fit.E0_Pa);
}
