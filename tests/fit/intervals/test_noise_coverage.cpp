// How often 95 % intervals hold the truth, by kind of test and of noise.
#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/text_of_number.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
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
  std::vector<double> time_s;  // or frequencies in Hz
  Noise noise;
  double cut_s = 0.0;  // times cut off to this step
  bool with_terms = true;
  std::function<FitResult(const CoverageRow&, std::mt19937_64&)> fit =
      nullptr;  // none: relaxation after a step
};

// Values with noise; the floor is relative to the largest one.
std::vector<double> with_noise(std::vector<double> values, const Noise& noise,
                               std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  double memory = normal(random);
  for (double& value : values) {
    value += std::hypot(noise.floor * largest, noise.share * value) * memory;
    memory = noise.rho * memory + std::sqrt(1.0 - noise.rho * noise.rho) * normal(random);
  }
  return values;
}

FitOptions without_curves() {
  FitOptions options;
  options.with_curves = false;
  options.with_spectrum = true;
  return options;
}

FitResult fit_of_relaxation(const CoverageRow& row, std::mt19937_64& random) {
  RelaxationData data;
  for (const double t : row.time_s) {
    data.value.push_back(relaxation_modulus_Pa(row.truth, t));
    data.time_s.push_back(row.cut_s > 0.0 ? row.cut_s * std::floor(t / row.cut_s + 1e-9) : t);
  }
  data.value = with_noise(data.value, row.noise, random);
  return fit_relaxation(data, without_curves());
}

FitResult fit_of_creep(const CoverageRow& row, std::mt19937_64& random) {
  const RetardationSpectrum spectrum = retardation_from_relaxation(row.truth);
  CreepData data;
  data.time_s = row.time_s;
  for (const double t : row.time_s)
    data.compliance_1_Pa.push_back(creep_compliance_1_Pa(spectrum, t));
  data.compliance_1_Pa = with_noise(data.compliance_1_Pa, row.noise, random);
  return fit_creep(data, without_curves());
}

FitResult fit_of_oscillation(const CoverageRow& row, std::mt19937_64& random) {
  DmaData data;
  data.frequency_Hz = row.time_s;
  for (const double f : row.time_s) {
    double storage_Pa = row.truth.equilibrium_modulus_Pa, loss_Pa = 0.0;
    for (const MaxwellTerm& term : row.truth.terms) {
      const double x = 2.0 * std::numbers::pi * f * term.relaxation_time_s;
      storage_Pa += term.modulus_Pa * x * x / (1.0 + x * x);
      loss_Pa += term.modulus_Pa * x / (1.0 + x * x);
    }
    data.storage_Pa.push_back(storage_Pa);
    data.loss_Pa.push_back(loss_Pa);
  }
  data.storage_Pa = with_noise(data.storage_Pa, row.noise, random);
  data.loss_Pa = with_noise(data.loss_Pa, row.noise, random);
  return fit_dma(data, without_curves());
}

// Ramp of 1 s, then hold.
FitResult fit_of_indentation(const CoverageRow& row, std::mt19937_64& random) {
  IndentationData data = indentation_of(row.truth, row.time_s, ramp_and_hold(1.0), 0.0, 1);
  data.force_N = with_noise(data.force_N, row.noise, random);
  return fit_indentation(data, without_curves());
}

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
  double pooled = 0.0;  // of all intervals
  // Of the bounds over all spectra (continuous_spectrum.h); -1: the kind of test has none.
  double E0_of_all = -1.0, E_inf_of_all = -1.0, width_of_all = 0.0;
};

Coverage coverage_of(const CoverageRow& row, int runs) {
  Coverage share;
  const double E0 = instantaneous_modulus_Pa(row.truth);
  double n_trusted = 0.0, n_same = 0.0;
  std::vector<double> widths, widths_of_all;
  double n_spectra = 0.0, E0_of_all = 0.0, E_inf_of_all = 0.0;
  for (int run = 1; run <= runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run));
    const FitResult fit = row.fit ? row.fit(row, random) : fit_of_relaxation(row, random);
    if (!fit.is_trustworthy) continue;
    n_trusted += 1.0;
    share.E0 += holds(fit.E0_interval_95, E0) ? 1.0 : 0.0;
    share.E_inf += holds(fit.E_inf_interval_95, row.truth.equilibrium_modulus_Pa) ? 1.0 : 0.0;
    if (row.truth.equilibrium_modulus_Pa > 0.0)
      widths.push_back((fit.E_inf_interval_95.high - fit.E_inf_interval_95.low) /
                       row.truth.equilibrium_modulus_Pa);
    if (fit.spectrum) {
      n_spectra += 1.0;
      E0_of_all += holds(fit.spectrum->E0_95, E0) ? 1.0 : 0.0;
      E_inf_of_all += holds(fit.spectrum->E_inf_95, row.truth.equilibrium_modulus_Pa) ? 1.0 : 0.0;
      widths_of_all.push_back((fit.spectrum->E_inf_95.high - fit.spectrum->E_inf_95.low) /
                              std::max(row.truth.equilibrium_modulus_Pa, 1e-300));
    }
    if (!row.with_terms || fit.terms.size() != row.truth.terms.size()) continue;
    n_same += static_cast<double>(fit.terms.size());
    for (std::size_t i = 0; i < fit.terms.size(); ++i) {
      const MaxwellTerm& term = row.truth.terms[i];
      share.moduli += holds(fit.terms[i].modulus_Pa_95, term.modulus_Pa) ? 1.0 : 0.0;
      share.times += holds(fit.terms[i].tau_s_95, term.relaxation_time_s) ? 1.0 : 0.0;
    }
  }
  share.trusted = n_trusted / runs;
  const double n_held = share.E0 + share.E_inf + share.moduli + share.times;
  share.pooled = n_held / (2.0 * n_trusted + 2.0 * n_same);
  share.E0 /= n_trusted;
  share.E_inf /= n_trusted;
  share.moduli /= std::max(1.0, n_same);
  share.times /= std::max(1.0, n_same);
  std::sort(widths.begin(), widths.end());
  share.width = widths.empty() ? 0.0 : widths[widths.size() / 2];
  if (n_spectra > 0.0) {
    share.E0_of_all = E0_of_all / n_spectra;
    share.E_inf_of_all = E_inf_of_all / n_spectra;
    std::sort(widths_of_all.begin(), widths_of_all.end());
    share.width_of_all = widths_of_all[widths_of_all.size() / 2];
  }
  return share;
}

}  // namespace

TEST_CASE("intervals of all kinds of test hold under absolute, proportional and mixed noise",
          "[fit][slow]") {
  const PronySeries two{1e6, {{0.2e6, 3.0}, {0.3e6, 30.0}}};
  const PronySeries falling{0.05e6, {{0.4e6, 0.5}, {0.55e6, 8.0}}};
  const PronySeries liquid{0.0, {{0.4e6, 0.3}, {0.2e6, 30.0}}};
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
       false},
      {"six terms over six decades, 0.1 %", s6(), log_spaced(1e-3, 3e4, 400), {1e-3, 0.0, 0.0}},
      {"indentation, 0.1 %",
       two,
       even_from_one(0.05, 2400),
       {1e-3, 0.0, 0.0},
       0.0,
       true,
       fit_of_indentation},
      {"indentation, AR(1), 0.9",
       two,
       even_from_one(0.05, 2400),
       {1e-3, 0.0, 0.9},
       0.0,
       true,
       fit_of_indentation},
      {"creep, 0.1 %", two, even_from_one(0.1, 2000), {1e-3, 0.0, 0.0}, 0.0, true, fit_of_creep},
      {"creep, 1 % of the value",
       two,
       even_from_one(0.1, 2000),
       {0.0, 0.01, 0.0},
       0.0,
       true,
       fit_of_creep},
      {"oscillation of a solid, 1 % of the value",
       two,
       log_spaced(1e-3, 10.0, 60),
       {0.0, 0.01, 0.0},
       0.0,
       true,
       fit_of_oscillation},
      {"oscillation of a solid, floor and 1 %",
       two,
       log_spaced(1e-3, 10.0, 60),
       {2e-3, 0.01, 0.0},
       0.0,
       true,
       fit_of_oscillation},
      {"oscillation of a liquid, 1 % of the value",
       liquid,
       log_spaced(1e-4, 10.0, 60),
       {0.0, 0.01, 0.0},
       0.0,
       true,
       fit_of_oscillation}};
  const char* const fewer = std::getenv("VISCARD_COVERAGE_RUNS");
  const int runs = fewer != nullptr ? std::max(1, std::atoi(fewer)) : 300;
  std::printf(
      "| test and noise | E0 | E_inf | E_i | tau_i | pooled | trusted | width of E_inf | E0, all "
      "spectra | "
      "E_inf, all spectra | its width |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const CoverageRow& row : rows) {
    const Coverage share = coverage_of(row, runs);
    const bool is_solid = row.truth.equilibrium_modulus_Pa > 0.0;
    std::printf("| %s | %.0f | %s |", row.name, 100.0 * share.E0,
                is_solid ? text_of(100.0 * share.E_inf, 2).c_str() : "-");
    if (row.with_terms) std::printf(" %.0f | %.0f |", 100.0 * share.moduli, 100.0 * share.times);
    if (!row.with_terms) std::printf(" - | - |");
    std::printf(" %.1f | %.0f |", 100.0 * share.pooled, 100.0 * share.trusted);
    std::printf(" %s |", is_solid ? (text_of(100.0 * share.width, 3) + " %").c_str() : "-");
    const bool has_spectra = share.E0_of_all >= 0.0;
    std::printf(" %s |", has_spectra ? text_of(100.0 * share.E0_of_all, 3).c_str() : "-");
    std::printf(" %s |",
                has_spectra && is_solid ? text_of(100.0 * share.E_inf_of_all, 3).c_str() : "-");
    std::printf(" %s |\n", has_spectra && is_solid
                               ? (text_of(100.0 * share.width_of_all, 3) + " %").c_str()
                               : "-");
    CAPTURE(row.name);
    CHECK(share.trusted >= 0.9);
    CHECK(share.pooled >= 0.92);
    CHECK(share.E0 >= 0.88);
    if (row.truth.equilibrium_modulus_Pa > 0.0) CHECK(share.E_inf >= 0.88);
    if (!row.with_terms) continue;
    CHECK(share.moduli >= 0.88);
    CHECK(share.times >= 0.88);
  }
}
