#include "fit/fit_indentation.h"
#include "io/config/config_file.h"
#include "models/material/hereditary.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;

namespace {

const PronySeries kTruth{1.6e6, {{1.2e5, 0.8}, {8e4, 40.0}}};

// Ramp of 1 s to 50 um and a hold, recorded at 100 Hz from before contact. The force is computed
// with a tenth of that step.
IndentationData pressed(const PunchContact& contact, double noise_N, double contact_at_m) {
  std::mt19937_64 dice(4);
  std::normal_distribution<double> normal;
  const DepthLaw law = depth_law(contact);
  HereditaryStress force(kTruth);
  IndentationData data;
  data.contact = contact;
  constexpr int kFine = 10;
  for (int i = 0; i <= 20000; ++i) {
    const double t_s = 0.01 * i;
    for (int f = 0; i > 0 && f < kFine; ++f) {
      const double at_s = t_s - 0.01 + 0.01 * (f + 1) / kFine;
      const double depth_m = 5e-5 * std::clamp(at_s - 0.5, 0.0, 1.0);
      force.advance(0.01 / kFine, law.factor * std::pow(depth_m, law.power));
    }
    data.time_s.push_back(t_s);
    data.depth_m.push_back(5e-5 * std::min(t_s - 0.5, 1.0) + contact_at_m);
    data.force_N.push_back(force.stress_Pa() + noise_N * normal(dice));
  }
  return data;
}

void check_truth(const FitResult& fit, double tolerance) {
  CHECK(fit.E0_Pa == Approx(1.8e6).epsilon(tolerance));
  CHECK(fit.E_inf_Pa == Approx(1.6e6).epsilon(tolerance));
  REQUIRE(fit.terms.size() == 2);
  CHECK(fit.terms[1].tau_s == Approx(40.0).epsilon(10.0 * tolerance));
}

}  // namespace

TEST_CASE("a sphere on a viscoelastic half-space gives the true modulus", "[fit]") {
  const PunchContact sphere{
      .punch_radius_m = 2e-3, .poisson_ratio = 0.495, .shape = TipShape::kSphere};
  const double peak_N = depth_law(sphere).factor * std::pow(5e-5, 1.5) * 1.7e6;
  // depth^1.5 is taken as linear between samples: an error of (dt/ramp)^2, plus that of the
  // contact.
  check_truth(fit_indentation(pressed(sphere, 1e-4 * peak_N, 3e-6), {.n_terms = 2}), 0.01);
}

TEST_CASE("a cone on a viscoelastic half-space gives the true modulus", "[fit]") {
  const PunchContact cone{.poisson_ratio = 0.495,
                          .shape = TipShape::kCone,
                          .half_angle_rad = 70.0 * std::numbers::pi / 180.0};
  const double peak_N = depth_law(cone).factor * std::pow(5e-5, 2.0) * 1.7e6;
  check_truth(fit_indentation(pressed(cone, 1e-4 * peak_N, 3e-6), {.n_terms = 2}), 0.01);
}

TEST_CASE("a sphere fitted as a flat punch gives a wrong modulus", "[fit]") {
  const PunchContact sphere{
      .punch_radius_m = 2e-3, .poisson_ratio = 0.495, .shape = TipShape::kSphere};
  IndentationData data = pressed(sphere, 1e-5, 0.0);
  data.contact->shape = TipShape::kFlat;
  CHECK(std::abs(fit_indentation(data, {.n_terms = 2}).E0_Pa / 1.8e6 - 1.0) > 0.5);
}

TEST_CASE("specimen files name the tip", "[io]") {
  const std::string text =
      "id = \"a\"\nmodulus_guess = \"1 MPa\"\n[tip]\nshape = \"cone\"\nhalf_angle = \"70 deg\"\n"
      "[contact]\nlayer_thickness = \"half-space\"\npoisson_ratio = 0.5\n";
  const Specimen specimen = specimen_from_toml(text, "s.toml");
  CHECK(specimen.contact.shape == TipShape::kCone);
  CHECK(specimen.contact.half_angle_rad == Approx(70.0 * std::numbers::pi / 180.0).epsilon(1e-14));
  const Specimen again = specimen_from_toml(toml_from_specimen(specimen), "again");
  CHECK(again.contact.half_angle_rad == specimen.contact.half_angle_rad);
  CHECK(test::error_text([] {
          specimen_from_toml("id = \"a\"\nmodulus_guess = \"1 MPa\"\n[tip]\nshape = \"ball\"\n",
                             "s");
        }).find("\"sphere\"") != std::string::npos);
}
