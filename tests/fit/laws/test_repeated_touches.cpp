#include "fit/laws/fit_mixing_ratio.h"
#include "tests/fit/laws/campaigns.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// The records of a campaign in which every specimen is touched several times; each touch has an
// error of its own in ln E0 and the ln g.
std::vector<Material> touched(const Campaign& campaign, int touches, double touch_spread,
                              std::mt19937_64& dice) {
  std::normal_distribution<double> normal;
  std::vector<Material> out;
  for (const double ratio : campaign.ratios) {
    for (int s = 0; s < campaign.specimens_per_ratio; ++s) {
      const Eigen::VectorXd specimen = with_spread(campaign, truth_at(campaign, ratio), dice);
      for (int k = 0; k < touches; ++k) {
        Eigen::VectorXd theta = specimen;
        for (int i = 0; i < 5; ++i) theta[i] += campaign.fit_se * normal(dice);
        for (int i = 0; i < 3; ++i) theta[i] += touch_spread * normal(dice);
        out.push_back(material_of(theta, ratio, campaign.fit_se));
        out.back().specimen_id = std::to_string(ratio) + "-" + std::to_string(s);
      }
    }
  }
  return out;
}

struct CoverageOfE0 {
  int pooled = 0, as_specimens = 0;
};

// How often the interval of a new specimen holds it: with the touches pooled, and with each touch
// taken for a specimen of its own.
CoverageOfE0 coverage_of_new_specimens(int runs, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  const Campaign campaign{.specimens_per_ratio = 2};
  const MixingOptions options{.variables = {RatioVariable::kLogRatio}};
  CoverageOfE0 count;
  for (int run = 0; run < runs; ++run) {
    std::vector<Material> records = touched(campaign, 4, 0.02, dice);
    const Material pooled = material_at_ratio(fit_mixing_ratio(records, options), 12.5);
    for (Material& one : records) one.specimen_id.clear();
    const Material apart = material_at_ratio(fit_mixing_ratio(records, options), 12.5);
    const double truth = std::exp(with_spread(campaign, truth_at(campaign, 12.5), dice)[0]);
    const auto holds = [&](const Material& at) {
      const Interval& interval = at.uncertainty->E0_Pa_95;
      return truth >= interval.low && truth <= interval.high ? 1 : 0;
    };
    count.pooled += holds(pooled);
    count.as_specimens += holds(apart);
  }
  return count;
}

}  // namespace

TEST_CASE("repeated touches count as one specimen, and three levels of scatter are found",
          "[fit][joint]") {
  std::mt19937_64 dice(6);
  const Campaign campaign{.ratios = {5.0, 10.0, 15.0, 20.0}, .specimens_per_ratio = 5};
  const RatioFit fit = fit_mixing_ratio(touched(campaign, 3, 0.02, dice));
  CHECK(fit.law.n_specimens == 20);
  CHECK(fit.specimens.size() == 60);
  CHECK(fit.specimens[4].specimen == 2);
  CHECK(fit.specimens[4].touch == 2);
  REQUIRE(fit.scatter.size() == 2);
  const Scatter& E0 = fit.scatter[0];
  CHECK(E0.quantity == "ln_E0");
  CHECK(E0.own_error == Approx(0.01).epsilon(1e-6));
  CHECK(E0.touch.degrees_of_freedom == 40);
  CHECK(E0.specimen.degrees_of_freedom == 16);
  // Relative standard errors 1/sqrt(2 x 40) and 1/sqrt(2 x 16), the own errors allowed for; three of
  // them.
  CHECK(E0.touch.deviation == Approx(0.02).epsilon(0.4));
  CHECK(E0.specimen.deviation == Approx(0.05).epsilon(0.55));
  CHECK(fit.law.touch_ln_E0 == Approx(E0.touch.deviation).epsilon(0.05));
  CHECK(fit.law.touch_ln_tau < 0.01);  // the times do not scatter between touches
  const Scatter& relaxed = fit.scatter[1];
  CHECK(relaxed.quantity == "sum_g");
  CHECK(relaxed.mean == Approx(0.15).epsilon(0.1));
  CHECK(relaxed.touch.interval_95.low > 0.0);
}

TEST_CASE("single touches give the answer that they gave before touches were known",
          "[fit][joint]") {
  std::mt19937_64 dice(12);
  std::vector<Material> records = measured({}, dice);
  const RatioFit plain = fit_mixing_ratio(records);
  for (std::size_t s = 0; s < records.size(); ++s) records[s].specimen_id = std::to_string(s);
  const RatioFit named = fit_mixing_ratio(records);
  CHECK(named.law.coefficients == plain.law.coefficients);
  CHECK(named.law.spread_ln_E0 == plain.law.spread_ln_E0);
  CHECK(named.law.touch_ln_E0 == 0.0);
  CHECK_FALSE(is_identified(named.scatter[0].touch));
}

TEST_CASE("repeats do not make up for specimens", "[fit][joint]") {
  std::mt19937_64 dice(12);
  const Campaign campaign{.ratios = {10.0, 20.0}, .specimens_per_ratio = 1};
  const std::vector<Material> records = touched(campaign, 3, 0.02, dice);
  CHECK_THAT(error_text([&] { fit_mixing_ratio(records); }),
             Contains("at least three specimens; there are 2 (6 records"));
}

TEST_CASE("ratios can keep their own numbers of terms; then only E0 follows a law",
          "[fit][joint]") {
  std::mt19937_64 dice(12);
  const Campaign campaign{.specimens_per_ratio = 3};
  std::vector<Material> records = touched(campaign, 2, 0.02, dice);
  for (Material& one : records) {
    if (one.mixing_ratio != 13.0) continue;
    one.terms.pop_back();  // its second term joins the rest
    Eigen::MatrixXd pick = Eigen::MatrixXd::Zero(3, 5);
    pick(0, 0) = pick(0, 2) = pick(1, 1) = pick(2, 3) = 1.0;
    one.uncertainty->covariance = pick * one.uncertainty->covariance * pick.transpose();
  }
  CHECK_THAT(error_text([&] { fit_mixing_ratio(records); }), Contains("same number of terms"));
  const RatioFit fit = fit_mixing_ratio(records, {.own_terms = true});
  CHECK(fit.law.own_terms == std::vector<int>{2, 1, 2});
  CHECK(fit.law.form.E0_degree >= 0);
  CHECK(material_at_ratio(fit, 10.0).terms.size() == 2);
  const Material at = material_at_ratio(fit, 13.0);
  REQUIRE(at.terms.size() == 1);
  // Spread 0.05 over three specimens: three standard errors.
  CHECK(at.terms[0].tau_s == Approx(0.8).epsilon(0.09));
  CHECK(at.uncertainty->terms[0].tau_s_95.high > at.terms[0].tau_s);
  CHECK(ratio_band(fit).E0_Pa.front() == Approx(2e6).epsilon(0.1));
  CHECK_THAT(error_text([&] { material_at_ratio(fit, 12.5); }), Contains("own-terms"));
  CHECK_THAT(
      error_text([&] { fit_mixing_ratio(records, {.share_times = true, .own_terms = true}); }),
      Contains("cannot share"));
}

TEST_CASE("a new specimen lies in its interval if touches are pooled", "[fit][joint]") {
  // 60 campaigns: 95 % is 57 +- 1.7.
  CHECK(coverage_of_new_specimens(60, 2).pooled >= 52);
}

// 400 campaigns: 95 % is 380 +- 4.4.
TEST_CASE("95 % of many new specimens lie in their intervals if touches are pooled",
          "[fit][joint][slow]") {
  const CoverageOfE0 count = coverage_of_new_specimens(400, 3);
  std::cout << "new specimens in their intervals: touches pooled " << count.pooled
            << " of 400, touches taken for specimens " << count.as_specimens << " of 400\n";
  CHECK(count.pooled >= 0.92 * 400);
  CHECK(count.pooled <= 0.985 * 400);
  CHECK(count.as_specimens < count.pooled - 8);  // twice the standard error
}
