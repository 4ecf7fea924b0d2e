// How often 95 % intervals of relaxation hold the truth under noise of several kinds.
#include "fit/fit_relaxation.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

struct Noise {
  double floor = 0.0;  // of E0
  double share = 0.0;  // of the value
  double rho = 0.0;    // between neighbours
};

struct CoverageRow {
  const char* name;
  PronySeries truth;
  std::vector<double> time_s;
  Noise noise;
  double cut_s = 0.0;  // times cut off to this step
  bool with_terms = true;
};

std::vector<double> log_spaced(double from_s, double to_s, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    times.push_back(from_s * std::pow(to_s / from_s, i / (count - 1.0)));
  }
  return times;
}

std::vector<double> even_from_one(double step_s, int count) {
  std::vector<double> times;
  for (int i = 1; i <= count; ++i) times.push_back(step_s * i);
  return times;
}

// From 1 GPa to 2 MPa over seventeen decades.
PronySeries glass() {
  PronySeries series{2e6, {}};
  for (int k = 0; k < 16; ++k) {
    series.terms.push_back({9.98e8 * 0.36 * std::pow(0.64, k), 1e-6 * std::pow(10.0, k)});
  }
  return series;
}

struct Coverage {
  double E0 = 0.0, E_inf = 0.0, moduli = 0.0, times = 0.0, trusted = 0.0, width = 0.0;
};

Coverage coverage_of(const CoverageRow& row, int runs) {
  Coverage share;
  const double E0 = instantaneous_modulus_Pa(row.truth);
  double n_trusted = 0.0, n_same = 0.0;
  std::vector<double> widths;
  for (int run = 1; run <= runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run));
    std::normal_distribution<double> normal;
    RelaxationData data;
    double memory = normal(random);
    for (const double t : row.time_s) {
      const double value = relaxation_modulus_Pa(row.truth, t);
      const double sigma = std::hypot(row.noise.floor * E0, row.noise.share * value);
      data.value.push_back(value + sigma * memory);
      data.time_s.push_back(row.cut_s > 0.0 ? row.cut_s * std::floor(t / row.cut_s + 1e-9) : t);
      memory =
          row.noise.rho * memory + std::sqrt(1.0 - row.noise.rho * row.noise.rho) * normal(random);
    }
    FitOptions options;
    options.with_curves = false;
    const FitResult fit = fit_relaxation(data, options);
    if (!fit.is_trustworthy) continue;
    n_trusted += 1.0;
    share.E0 += holds(fit.E0_interval_95, E0) ? 1.0 : 0.0;
    share.E_inf += holds(fit.E_inf_interval_95, row.truth.equilibrium_modulus_Pa) ? 1.0 : 0.0;
    widths.push_back((fit.E_inf_interval_95.high - fit.E_inf_interval_95.low) /
                     row.truth.equilibrium_modulus_Pa);
    if (!row.with_terms || fit.terms.size() != row.truth.terms.size()) continue;
    n_same += static_cast<double>(fit.terms.size());
    for (std::size_t i = 0; i < fit.terms.size(); ++i) {
      const MaxwellTerm& term = row.truth.terms[i];
      share.moduli += holds(fit.terms[i].modulus_Pa_95, term.modulus_Pa) ? 1.0 : 0.0;
      share.times += holds(fit.terms[i].tau_s_95, term.relaxation_time_s) ? 1.0 : 0.0;
    }
  }
  share.trusted = n_trusted / runs;
  share.E0 /= n_trusted;
  share.E_inf /= n_trusted;
  share.moduli /= std::max(1.0, n_same);
  share.times /= std::max(1.0, n_same);
  std::sort(widths.begin(), widths.end());
  share.width = widths.empty() ? 0.0 : widths[widths.size() / 2];
  return share;
}

}  // namespace

TEST_CASE("intervals of relaxation hold under absolute, proportional and mixed noise",
          "[fit][slow]") {
  const PronySeries two{1e6, {{0.2e6, 3.0}, {0.3e6, 30.0}}};
  const PronySeries falling{0.05e6, {{0.4e6, 0.5}, {0.55e6, 8.0}}};
  const PronySeries fast{1e6, {{0.3e6, 0.6}, {0.2e6, 10.0}}};
  const std::vector<CoverageRow> rows{
      {"white, 0.1 %", two, even_from_one(0.1, 2000), {1e-3, 0.0, 0.0}},
      {"AR(1), 0.9", two, even_from_one(0.1, 2000), {1e-3, 0.0, 0.9}},
      {"falling by 95 %, 1 % of the value", falling, even_from_one(0.03, 2000), {0.0, 0.01, 0.0}},
      {"falling by 95 %, floor and 1 %", falling, even_from_one(0.03, 2000), {5e-4, 0.01, 0.0}},
      {"times cut off to 0.1 s at 7 Hz",
       fast,
       even_from_one(1.0 / 7.0, 600),
       {1e-3, 0.0, 0.0},
       0.1},
      {"master curve, 1 % of the value",
       glass(),
       log_spaced(1e-7, 1e11, 400),
       {0.0, 0.01, 0.0},
       0.0,
       false}};
  std::printf(
      "| noise | E0 | E_inf | E_i | tau_i | trusted | width of E_inf "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const CoverageRow& row : rows) {
    const Coverage share = coverage_of(row, 300);
    std::printf("| %s | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.0f %% | %.3g %% |\n", row.name,
                100.0 * share.E0, 100.0 * share.E_inf, 100.0 * share.moduli, 100.0 * share.times,
                100.0 * share.trusted, 100.0 * share.width);
    CAPTURE(row.name);
    CHECK(share.trusted >= 0.9);
    CHECK(share.E0 >= 0.88);
    CHECK(share.E_inf >= 0.88);
    if (!row.with_terms) continue;
    CHECK(share.moduli >= 0.88);
    CHECK(share.times >= 0.88);
  }
}
