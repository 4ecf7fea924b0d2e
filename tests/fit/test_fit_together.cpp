// Several tests of one material in one fit: generated sets of one spectrum with different noise.
#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/fit_together.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

const PronySeries kSolid{1.0e6, {{0.6e6, 0.05}, {0.5e6, 2.0}, {0.4e6, 60.0}}};
const PronySeries kLiquid{0.0, {{1.0e6, 0.05}, {0.5e6, 2.0}, {0.2e6, 60.0}}};
constexpr double kStiffness = 3e-3;  // N/m per Pa, of the indentation

using Times = std::vector<double>;

Times log_times(double from, double to, int count) {
  Times times;
  for (int i = 0; i < count; ++i) times.push_back(from * std::pow(to / from, i / (count - 1.0)));
  return times;
}

class Laboratory {
 public:
  Laboratory(PronySeries truth, std::uint64_t seed) : truth_(std::move(truth)), random_(seed) {
    options_.keep_rows = true;
  }

  // Noise of 1 % of E0, with a correlation of rho between neighbours.
  MaterialTest relaxation(double to_s = 1000.0, double rho = 0.0) {
    RelaxationData data;
    data.time_s = log_times(0.05, to_s, 120);
    double noise = normal_(random_);
    for (const double t_s : data.time_s) {
      noise = rho * noise + std::sqrt(1.0 - rho * rho) * normal_(random_);
      data.value.push_back(relaxation_modulus_Pa(truth_, t_s) +
                           0.01 * instantaneous_modulus_Pa(truth_) * noise);
    }
    return {"relaxation", fit_relaxation(data, options_)};
  }

  // Noise of 1 % of J(1000 s). The compliance belongs to `factor` times the moduli.
  MaterialTest creep(double factor = 1.0) {
    const RetardationSpectrum spectrum = retardation_from_relaxation(truth_);
    const double size = 0.01 * creep_compliance_1_Pa(spectrum, is_liquid() ? 100.0 : 1000.0);
    CreepData data;
    data.time_s = log_times(0.5, 5000.0, 90);
    for (const double t_s : data.time_s) {
      data.compliance_1_Pa.push_back(creep_compliance_1_Pa(spectrum, t_s) / factor +
                                     size * normal_(random_));
    }
    return {"creep", fit_creep(data, options_)};
  }

  // Noise of 1 % of each modulus.
  MaterialTest oscillation(double factor = 1.0) {
    DmaData data;
    data.frequency_Hz = log_times(0.003, 30.0, 30);
    for (const double f_Hz : data.frequency_Hz) {
      const ComplexModulus at = complex_modulus_Pa(truth_, 2.0 * std::numbers::pi * f_Hz);
      data.storage_Pa.push_back(factor * at.storage_Pa * (1.0 + 0.01 * normal_(random_)));
      data.loss_Pa.push_back(factor * at.loss_Pa * (1.0 + 0.01 * normal_(random_)));
    }
    return {"oscillation", fit_dma(data, options_)};
  }

  // Without geometry; noise of 0.5 % of the largest force.
  MaterialTest indentation() {
    PronySeries stiffness = truth_;
    stiffness.equilibrium_modulus_Pa *= kStiffness;
    for (MaxwellTerm& term : stiffness.terms) term.modulus_Pa *= kStiffness;
    const IndentationData data =
        indentation_of(stiffness, even_times(30.0, 0.01), ramp_and_hold(1.0), 0.005, random_());
    return {"indentation", fit_indentation(data, options_)};
  }

 private:
  bool is_liquid() const { return truth_.equilibrium_modulus_Pa == 0.0; }

  PronySeries truth_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  FitOptions options_;
};

std::vector<MaterialTest> three_tests(const PronySeries& truth, std::uint64_t seed,
                                      double creep_factor = 1.0) {
  Laboratory laboratory(truth, seed);
  const double to_s = truth.equilibrium_modulus_Pa > 0.0 ? 1000.0 : 300.0;
  MaterialTest relaxation = laboratory.relaxation(to_s);
  MaterialTest creep = laboratory.creep(creep_factor);
  return {relaxation, creep, laboratory.oscillation()};
}

// How often intervals hold the truth, for all parameters of a series.
struct Coverage {
  std::map<std::string, std::pair<int, int>> by_name;

  void add(const std::string& name, const Interval& interval, double truth) {
    auto& [inside, all] = by_name[name];
    inside += holds(interval, truth) ? 1 : 0;
    ++all;
  }
  void add(const FitResult& fit, const PronySeries& truth) {
    add("E0", fit.E0_interval_95, instantaneous_modulus_Pa(truth));
    if (truth.equilibrium_modulus_Pa > 0.0) {
      add("E_inf", fit.E_inf_interval_95, truth.equilibrium_modulus_Pa);
    }
    if (fit.terms.size() != truth.terms.size()) return;
    for (std::size_t i = 0; i < fit.terms.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      add("E_" + number, fit.terms[i].modulus_Pa_95, truth.terms[i].modulus_Pa);
      add("tau_" + number, fit.terms[i].tau_s_95, truth.terms[i].relaxation_time_s);
    }
  }
  double pooled() const {
    double inside = 0.0, all = 0.0;
    for (const auto& [name, counts] : by_name) {
      inside += counts.first;
      all += counts.second;
    }
    return inside / all;
  }
};

double width(const Interval& interval) {
  return interval.high - interval.low;
}

}  // namespace

TEST_CASE("three tests of one spectrum: intervals hold it and are shorter than alone",
          "[fit][together]") {
  constexpr int kSets = 40;
  Coverage coverage;
  int n_flagged = 0, n_three = 0;
  double shorter_E_inf = 0.0, shorter_tau = 0.0;
  for (unsigned seed = 0; seed < kSets; ++seed) {
    const std::vector<MaterialTest> tests = three_tests(kSolid, 1000 + seed);
    const FitResult fit = fit_together(tests, {});
    CHECK(fit.kind == FitKind::kSeveral);
    REQUIRE(fit.tests.size() == 3);
    n_flagged += has_flag(fit, "tests-disagree") ? 1 : 0;
    coverage.add(fit, kSolid);
    // The noise that the sets were made with.
    CHECK(fit.tests[0].noise.sigma == Approx(2.5e4).epsilon(0.3));
    CHECK(fit.tests[2].noise.sigma == Approx(0.01).epsilon(0.4));
    if (fit.terms.size() != 3) continue;
    ++n_three;
    const FitResult &relaxation = tests[0].own, &oscillation = tests[2].own;
    shorter_E_inf += width(fit.E_inf_interval_95) / width(relaxation.E_inf_interval_95) / kSets;
    if (oscillation.terms.size() == 3) {
      shorter_tau += width(fit.terms[2].tau_s_95) / width(oscillation.terms[2].tau_s_95) / kSets;
    }
  }
  CHECK(n_three >= 38);
  CHECK(n_flagged <= 2);
  CHECK(coverage.pooled() > 0.9);
  CHECK(coverage.pooled() < 0.985);
  CHECK(shorter_E_inf < 0.5);
  CHECK(shorter_tau < 0.8);
}

TEST_CASE("a disagreement of 5 % is found and reported, and the result is not trusted",
          "[fit][together]") {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::vector<MaterialTest> tests = three_tests(kSolid, 2000 + seed, 1.05);
    const FitResult fit = fit_together(tests, {});
    REQUIRE(has_flag(fit, "tests-disagree"));
    CHECK_FALSE(fit.is_trustworthy);
    const FittedTest& creep = fit.tests[1];
    CHECK(creep.disagrees);
    // The compliance is 1/1.05 of the one that belongs to the other tests.
    CHECK(holds({creep.difference_95.low - 0.005, creep.difference_95.high + 0.005}, 1 / 1.05 - 1));
    CHECK(creep.p_value < 1e-6);
    CHECK_FALSE(fit.tests[0].disagrees);  // relaxation and oscillation agree without the creep
    CHECK_FALSE(fit.tests[2].disagrees);
    const auto flag = std::find_if(fit.flags.begin(), fit.flags.end(),
                                   [](const auto& one) { return one.name == "tests-disagree"; });
    CHECK_THAT(flag->text, Contains("the creep lies") && Contains("% below") && Contains("p "));
  }
}

TEST_CASE("a liquid in three tests is found as a liquid", "[fit][together]") {
  Coverage coverage;
  int n_flagged = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const FitResult fit = fit_together(three_tests(kLiquid, 3000 + seed), {});
    CAPTURE(seed, fit.terms.size());
    CHECK(fit.E_inf_Pa == 0.0);
    n_flagged += has_flag(fit, "tests-disagree") ? 1 : 0;
    coverage.add(fit, kLiquid);
  }
  CHECK(n_flagged <= 1);
  CHECK(coverage.pooled() > 0.85);
}

TEST_CASE("a stiffness among moduli gets its scale from them", "[fit][together]") {
  Coverage coverage;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Laboratory laboratory(kSolid, 4000 + seed);
    const MaterialTest oscillation = laboratory.oscillation();
    const FitResult fit = fit_together({laboratory.indentation(), oscillation}, {});
    CAPTURE(seed);
    CHECK_FALSE(fit.is_stiffness);
    CHECK_FALSE(has_flag(fit, "tests-disagree"));
    REQUIRE(fit.tests[0].has_scale);
    CHECK_FALSE(fit.tests[1].has_scale);
    CHECK(fit.tests[0].scale == Approx(kStiffness).epsilon(0.02));
    coverage.add("scale", fit.tests[0].scale_95, kStiffness);
    coverage.add(fit, kSolid);
  }
  CHECK(coverage.by_name["scale"].first >= 10);
  CHECK(coverage.pooled() > 0.88);
}

TEST_CASE("a test with slow noise counts with its own memory", "[fit][together]") {
  Coverage coverage;
  int n_flagged = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Laboratory laboratory(kSolid, 5000 + seed);
    const MaterialTest relaxation = laboratory.relaxation(1000.0, 0.8);
    const FitResult fit = fit_together({relaxation, laboratory.oscillation()}, {});
    n_flagged += has_flag(fit, "tests-disagree") ? 1 : 0;
    coverage.add(fit, kSolid);
  }
  CHECK(n_flagged <= 6);  // at a level of 5 %, 7 of 60 come up in 3 % of all tries
  CHECK(coverage.pooled() > 0.88);
}

TEST_CASE("several tests refuse what one test alone can have", "[fit][together]") {
  const std::vector<MaterialTest> tests = three_tests(kSolid, 1);
  FitOptions bound;
  bound.n_terms = 3;
  bound.constraints = {{"E0", 2e6, 2e6}};
  CHECK_THROWS_WITH(fit_together(tests, bound), Contains("single tests"));
  CHECK_THROWS_WITH(fit_together({tests[0]}, {}), Contains("at least two"));
  std::vector<MaterialTest> lost = tests;
  lost[1].own.kept.reset();
  CHECK_THROWS_WITH(fit_together(lost, {}), Contains("the creep cannot be fitted together"));
}

TEST_CASE("coverage of several tests together", "[fit][together][slow]") {
  constexpr int kSets = 300;
  std::printf("share of %d sets whose 95 %% intervals hold the truth\n", kSets);
  for (const bool is_liquid : {false, true}) {
    const PronySeries& truth = is_liquid ? kLiquid : kSolid;
    Coverage together, alone;
    int n_flagged = 0, n_found = 0;
    for (unsigned seed = 0; seed < kSets; ++seed) {
      const std::vector<MaterialTest> tests = three_tests(truth, 10000 + seed);
      const FitResult fit = fit_together(tests, {});
      together.add(fit, truth);
      alone.add(tests[2].own, truth);
      n_flagged += has_flag(fit, "tests-disagree") ? 1 : 0;
      if (seed >= 100) continue;
      const FitResult apart = fit_together(three_tests(truth, 20000 + seed, 1.05), {});
      n_found += has_flag(apart, "tests-disagree") ? 1 : 0;
    }
    std::printf("%s: together %.1f %% (", is_liquid ? "liquid" : "solid",
                100.0 * together.pooled());
    for (const auto& [name, counts] : together.by_name) {
      std::printf("%s %.0f ", name.c_str(), 100.0 * counts.first / counts.second);
    }
    std::printf(
        "), oscillation alone %.1f %%; tests-disagree in %d of %d, with 5 %% in %d of 100\n",
        100.0 * alone.pooled(), n_flagged, kSets, n_found);
    CHECK(together.pooled() > 0.92);
    CHECK(together.pooled() < 0.98);
    CHECK(n_flagged <= kSets / 20);
    CHECK(n_found == 100);
  }
}

TEST_CASE("what is known of how a record was made and read stands in a fit of several tests",
          "[fit][together]") {
  std::vector<MaterialTest> tests = three_tests(kSolid, 1);
  const bool is_trustworthy = fit_together(tests, {}).is_trustworthy;
  const std::vector<std::string> of_record{
      "touch-unknown",   "unit-assumed",       "run-stopped",   "lost-steps",
      "samples-damaged", "beyond-calibration", "times-rounded", "modulus-kind-assumed"};
  for (const std::string& name : of_record) tests[1].own.flags.push_back({name, 0, "why"});
  tests[1].own.flags.push_back({"E0-unknown", 0, "other tests may tell it"});
  const FitResult fit = fit_together(tests, {});
  for (const std::string& name : of_record) {
    CAPTURE(name);
    const auto flag = std::find_if(fit.flags.begin(), fit.flags.end(),
                                   [&](const MaterialFlag& one) { return one.name == name; });
    REQUIRE(flag != fit.flags.end());
    CHECK(flag->text == "creep: why");
  }
  CHECK_FALSE(has_flag(fit, "E0-unknown"));
  CHECK(fit.is_trustworthy == is_trustworthy);
  tests[0].own.flags.push_back({"unverified", 0, "damaged"});
  CHECK_FALSE(fit_together(tests, {}).is_trustworthy);
}
