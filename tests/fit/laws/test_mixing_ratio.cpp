#include "fit/fit_relaxation.h"
#include "fit/laws/fit_mixing_ratio.h"
#include "models/material/prony_series.h"
#include "tests/fit/laws/campaigns.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a joint fit finds the power law behind a campaign", "[fit][joint]") {
  std::mt19937_64 dice(11);
  const Campaign campaign{.ratios = {5.0, 10.0, 15.0, 20.0, 30.0}, .specimens_per_ratio = 6};
  const RatioFit fit = fit_mixing_ratio(measured(campaign, dice));
  CHECK(is_law(fit.best.form));
  CHECK(fit.best.form.variable == RatioVariable::kLogRatio);
  CHECK(fit.best.form.E0_degree == 1);
  CHECK(fit.best.form.g_degree == 0);
  CHECK(fit.best.form.tau_degree == 0);
  // Exponent: a spread of 0.05 over 30 specimens with sd(ln r) = 0.6 gives a standard error of
  // 0.015.
  const double slope = fit.law.coefficients[1] / (0.5 * std::log(30.0 / 5.0));
  CHECK(slope == Approx(-1.0).margin(0.05));
  // The relative standard deviation of a standard deviation with 28 degrees of freedom is 13 %;
  // allow three.
  CHECK(fit.law.spread_ln_E0 == Approx(0.05).epsilon(0.4));
  CHECK(fit.forms.front().bic <= fit.forms.back().bic);
}

TEST_CASE("a joint fit distinguishes a spectrum that depends on the ratio from one that does not",
          "[fit][joint]") {
  std::mt19937_64 dice(5);
  const Campaign moving{.ratios = {5.0, 10.0, 20.0}, .specimens_per_ratio = 5, .g_slope = 0.8};
  CHECK(fit_mixing_ratio(measured(moving, dice)).law.form.g_degree == 1);
}

TEST_CASE("parameters declared shared stay shared for any data", "[fit][joint]") {
  std::mt19937_64 dice(5);
  const Campaign moving{.ratios = {5.0, 10.0, 20.0}, .specimens_per_ratio = 5, .g_slope = 0.8};
  const RatioFit fit = fit_mixing_ratio(measured(moving, dice), {.share_g = true});
  CHECK(fit.best.form.g_degree == 0);
  CHECK(material_at_ratio(fit, 5.0).terms[0].g == material_at_ratio(fit, 20.0).terms[0].g);
}

TEST_CASE("a single parameter can be declared shared by name", "[fit][joint]") {
  std::mt19937_64 dice(5);
  const Campaign moving{.ratios = {5.0, 10.0, 20.0}, .specimens_per_ratio = 5, .g_slope = 0.8};
  const std::vector<Material> specimens = measured(moving, dice);
  REQUIRE(specimens.front().terms.size() >= 2);
  const RatioFit free = fit_mixing_ratio(specimens);
  const RatioFit fit = fit_mixing_ratio(specimens, {.shared = {"g_2"}});
  const Material soft = material_at_ratio(fit, 20.0), stiff = material_at_ratio(fit, 5.0);
  CHECK(stiff.terms[1].g == Approx(soft.terms[1].g).epsilon(1e-12));
  CHECK(std::abs(stiff.terms[0].g / soft.terms[0].g - 1.0) > 0.3);
  CHECK(fit.best.n_parameters < free.best.n_parameters);
  CHECK_THROWS_AS(fit_mixing_ratio(specimens, {.shared = {"tau_9"}}), std::invalid_argument);
}

TEST_CASE("a non-monotone modulus is not forced into a law, and the misfit is flagged",
          "[fit][joint]") {
  std::mt19937_64 dice(3);
  Campaign campaign{.specimens_per_ratio = 4, .spread_ln_E0 = 0.02};
  std::vector<Material> specimens = measured(campaign, dice);
  for (Material& one : specimens) {
    if (one.mixing_ratio != 13.0) continue;
    one.E0_Pa *= 3.0;
    one.uncertainty->covariance.topLeftCorner(3, 3) *= 9.0;
    one.uncertainty->covariance.topRightCorner(3, 2) *= 3.0;
    one.uncertainty->covariance.bottomLeftCorner(2, 3) *= 3.0;
  }
  const RatioFit fit = fit_mixing_ratio(specimens);
  CHECK_FALSE(is_law(fit.best.form));
  REQUIRE_FALSE(fit.flags.empty());
  CHECK(fit.flags.back().name == "law-misfits");
  // Measured ratios then use the values of their own specimens.
  CHECK(material_at_ratio(fit, 13.0).E0_Pa == Approx(3.0 * 20e6 / 13.0).epsilon(0.1));
}

TEST_CASE("the material at an unmeasured ratio lies on the law", "[fit][joint]") {
  std::mt19937_64 dice(2);
  const Campaign campaign{.specimens_per_ratio = 2,
                          .spread_ln_E0 = 0.0,
                          .spread_ln_g = 0.0,
                          .spread_ln_tau = 0.0,
                          .fit_se = 1e-6};
  const RatioFit fit =
      fit_mixing_ratio(measured(campaign, dice), {.variables = {RatioVariable::kLogRatio}});
  const Material at = material_at_ratio(fit, 12.5);
  CHECK(at.mixing_ratio == 12.5);
  CHECK(at.E0_Pa == Approx(20e6 / 12.5).epsilon(1e-5));  // ten standard errors
  CHECK(at.terms[1].g == Approx(0.05).epsilon(1e-5));
  CHECK(at.terms[1].tau_s == Approx(40.0).epsilon(1e-5));
  CHECK(at.valid.t_max_s == 1000.0);
  CHECK_NOTHROW(validate(at));
}

TEST_CASE("specimens that cannot be joined are named", "[fit][joint]") {
  std::mt19937_64 dice(2);
  std::vector<Material> specimens = measured({}, dice);
  const auto text_of = [&] { return error_text([&] { fit_mixing_ratio(specimens); }); };
  SECTION("too few") {
    specimens.resize(2);
    CHECK(text_of().find("at least three") != std::string::npos);
  }
  SECTION("one ratio") {
    for (Material& one : specimens) one.mixing_ratio = 10.0;
    CHECK(text_of().find("same mixing ratio") != std::string::npos);
  }
  SECTION("no ratio") {
    specimens[1].mixing_ratio = 0.0;
    CHECK(text_of().find("(specimen 2) has no mixing ratio") != std::string::npos);
  }
  SECTION("different numbers of terms") {
    specimens[4].terms.pop_back();
    specimens[4].uncertainty->covariance = Eigen::MatrixXd::Identity(3, 3);
    CHECK(text_of().find("--terms") != std::string::npos);
  }
  SECTION("no covariance") {
    specimens[3].uncertainty.reset();
    CHECK(text_of().find("covariance") != std::string::npos);
  }
}

TEST_CASE("specimens fitted from records give the law behind them", "[fit][joint]") {
  std::mt19937_64 dice(17);
  std::normal_distribution<double> normal;
  const Campaign campaign;
  std::vector<Material> specimens;
  for (const double ratio : {10.0, 13.0, 20.0}) {
    for (int k = 0; k < 2; ++k) {
      const Material truth =
          material_of(with_spread(campaign, truth_at(campaign, ratio), dice), ratio, 0.0);
      RelaxationData data;
      for (int i = 0; i < 600; ++i) {
        data.time_s.push_back(0.02 * std::pow(10.0, 4.3 * i / 599.0));
        data.value.push_back(relaxation_modulus_Pa(young_series(truth), data.time_s.back()) +
                             2e-3 * truth.E0_Pa * normal(dice));
      }
      specimens.push_back(material_from_fit(fit_relaxation(data, {.n_terms = 2}), 0.495, 965.0));
      specimens.back().mixing_ratio = ratio;
    }
  }
  const RatioFit fit = fit_mixing_ratio(specimens);
  const Material at = material_at_ratio(fit, 12.5);
  // Spread 0.05 over six specimens: 0.02 for E0, 0.03 for each of the others (one g and one tau,
  // pooled).
  CHECK(at.E0_Pa == Approx(20e6 / 12.5).epsilon(0.07));
  CHECK(at.terms[0].g == Approx(0.10).epsilon(0.12));
  CHECK(at.terms[1].tau_s == Approx(40.0).epsilon(0.12));
}
