// What is wrong with a record is named with its rows, and mended where that is unambiguous.
#include "fit/fit_creep.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/check_record.h"
#include "fit/samples/cycle.h"
#include "fit/samples/spikes.h"
#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kE0_Pa = 1.5e6, kE_inf_Pa = 1e6;
constexpr int kPositions = 20;

PronySeries two_terms() {
  return {kE_inf_Pa, {{0.2e6, 3.0}, {0.3e6, 30.0}}};
}

// 2000 rows at 10 Hz, from t = 0.1 s on, with noise of 0.1 % of E_inf.
RelaxationData record(std::uint64_t seed, std::size_t n = 2000) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1e3);
  RelaxationData data;
  for (std::size_t i = 1; i <= n; ++i) {
    data.time_s.push_back(0.1 * static_cast<double>(i));
    data.value.push_back(relaxation_modulus_Pa(two_terms(), data.time_s.back()) + normal(random));
  }
  return data;
}

std::vector<std::string> flags_of(const RecordNotes& notes) {
  std::vector<std::string> names;
  for (const RecordFault& fault : notes.faults) names.push_back(fault.flag);
  return names;
}

std::string text_of_flag(const FitResult& fit, const std::string& name) {
  for (const MaterialFlag& flag : fit.flags) {
    if (flag.name == name) return flag.text;
  }
  return "";
}

std::size_t n_left_out(const FitResult& fit, const std::string& reason) {
  for (const LeftOutRows& left : fit.left_out) {
    if (left.reason == reason) return left.count;
  }
  return 0;
}

void check_values_of_material(const FitResult& fit, double E0_tolerance = 0.004) {
  CHECK(fit.E0_Pa == Approx(kE0_Pa).epsilon(E0_tolerance));
  CHECK(fit.E_inf_Pa == Approx(kE_inf_Pa).epsilon(0.002));
}

CheckedRecord checked(const RelaxationData& data) {
  return CheckedRecord({data.time_s, data.value}, 4, RecordKind::kRelaxation);
}

}  // namespace

TEST_CASE("zeros and other constants inside a record are left out and named", "[fit]") {
  std::mt19937_64 random(1);
  const double constant = GENERATE(0.0, -999.0, 9.9e37);
  const std::size_t length = GENERATE(std::size_t{1}, std::size_t{2}, std::size_t{20});
  if (constant != 0.0 && length == 1) return;  // a single one is a spike
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(10 + static_cast<std::uint64_t>(k));
    const auto at = std::uniform_int_distribution<std::size_t>(1, 1950)(random);
    std::fill_n(data.value.begin() + static_cast<std::ptrdiff_t>(at), length, constant);
    const CheckedRecord found = checked(data);
    CAPTURE(constant, length, at, flags_of(found.notes));
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"dropouts-left-out"});
    CHECK(found.clean.column(1).size() == data.value.size() - length);
    const std::string rows = length == 1 ? "row " + std::to_string(at + 1) + " (t = "
                                         : "rows " + std::to_string(at + 1) + " to " +
                                               std::to_string(at + length) + " (t = ";
    CHECK_THAT(found.notes.faults[0].text, Contains(rows));
  }
  RelaxationData data = record(3);
  std::fill_n(data.value.begin() + 700, 20, constant);
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.is_trustworthy);
  check_values_of_material(fit);
  CHECK(n_left_out(fit, "dropout") == 20);
}

TEST_CASE("zeros at the end of a record are left out and named", "[fit]") {
  std::mt19937_64 random(2);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(20 + static_cast<std::uint64_t>(k));
    const auto from = std::uniform_int_distribution<std::size_t>(500, 1998)(random);
    std::fill(data.value.begin() + static_cast<std::ptrdiff_t>(from), data.value.end(), 0.0);
    const CheckedRecord found = checked(data);
    CAPTURE(from);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"dropouts-left-out"});
    CHECK(found.clean.column(1).size() == from);
  }
}

TEST_CASE("lost readings of an indentation are left out, also with the depth", "[fit]") {
  std::mt19937_64 random(3);
  const bool with_depth = GENERATE(false, true);
  const std::vector<double> time_s = even_times(100.0, 0.1);
  const IndentationData whole = indentation_of(s2(), time_s, ramp_and_hold(5.0), 1e-3, 5);
  const std::size_t length = GENERATE(std::size_t{1}, std::size_t{12});
  for (int k = 0; k < kPositions; ++k) {
    IndentationData data = whole;
    const auto at = std::uniform_int_distribution<std::size_t>(25, 980)(random);
    const auto begin = static_cast<std::ptrdiff_t>(at);
    std::fill_n(data.force_N.begin() + begin, length, 0.0);
    if (with_depth) std::fill_n(data.depth_m.begin() + begin, length, 0.0);
    const CheckedRecord found({data.time_s, data.force_N, data.depth_m}, 6, RecordKind::kHistory);
    CAPTURE(with_depth, length, at);
    REQUIRE(flags_of(found.notes).size() >= 1);
    CHECK(flags_of(found.notes)[0] == "dropouts-left-out");
    CHECK(found.clean.column(1).size() == data.force_N.size() - length);
  }
  IndentationData data = whole;
  std::fill(data.force_N.begin() + 900, data.force_N.end(), 0.0);
  const CheckedRecord found({data.time_s, data.force_N, data.depth_m}, 6, RecordKind::kHistory);
  CHECK(found.clean.column(1).size() == 900);
}

TEST_CASE("a display that stands still is left out and named", "[fit]") {
  std::mt19937_64 random(4);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(40 + static_cast<std::uint64_t>(k));
    const auto at = std::uniform_int_distribution<std::size_t>(50, 1900)(random);
    const auto length = std::uniform_int_distribution<std::size_t>(15, 99)(random);
    const double value = data.value[at];
    std::fill_n(data.value.begin() + static_cast<std::ptrdiff_t>(at), length, value);
    const CheckedRecord found = checked(data);
    CAPTURE(at, length);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"stuck-left-out"});
    CHECK(found.clean.column(1).size() == data.value.size() - length + 1);
    CHECK_THAT(found.notes.faults[0].text, Contains("rows " + std::to_string(at + 2) + " to "));
  }
  RelaxationData data = record(7);
  std::fill(data.value.begin() + 1700, data.value.end(), data.value[1700]);
  const FitResult fit = fit_relaxation(data);
  check_values_of_material(fit);
  CHECK(has_flag(fit, "rows-left-out"));
}

TEST_CASE("readings at the end of a range are left out, and the fit is not trusted", "[fit]") {
  std::mt19937_64 random(5);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(60 + static_cast<std::uint64_t>(k));
    const double top = std::uniform_real_distribution<double>(1.30e6, 1.45e6)(random);
    std::size_t n_above = 0;
    for (double& value : data.value) {
      n_above += value > top ? 1 : 0;
      value = std::min(value, top);
    }
    const CheckedRecord found = checked(data);
    CAPTURE(top, n_above);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"saturated"});
    CHECK(found.clean.column(1).size() <= data.value.size() - n_above + 3);
  }
  RelaxationData data = record(8);
  for (double& value : data.value) value = std::min(value, 1.35e6);
  const FitResult fit = fit_relaxation(data);
  CHECK_FALSE(fit.is_trustworthy);
  check_values_of_material(fit, 0.02);
}

TEST_CASE("a relaxation that falls below the range is cut there, and the fit is not trusted",
          "[fit]") {
  std::mt19937_64 random(9);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(80 + static_cast<std::uint64_t>(k));
    // Above the last value, so that many rows are clipped.
    const double bottom =
        data.value.back() * std::uniform_real_distribution<double>(1.03, 1.15)(random);
    for (double& value : data.value) value = std::max(value, bottom);
    const CheckedRecord found = checked(data);
    CAPTURE(bottom);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"saturated"});
    CHECK_THAT(found.notes.faults[0].text, Contains("exactly at the smallest value"));
    CHECK_FALSE(fit_relaxation(data).is_trustworthy);
    // A creep that grows beyond the range.
    CreepData creep{.time_s = data.time_s, .compliance_1_Pa = data.value};
    for (double& value : creep.compliance_1_Pa) value = 1.0 / value;
    const CheckedRecord risen({creep.time_s, creep.compliance_1_Pa}, 3, RecordKind::kCreep);
    REQUIRE(flags_of(risen.notes) == std::vector<std::string>{"saturated"});
    CHECK_FALSE(fit_creep(creep).is_trustworthy);
  }
}

TEST_CASE("records of coarse resolution, without noise, or of repeated readings are healthy",
          "[fit]") {
  const double resolution = GENERATE(0.0, 1.0, 2e3, 1e4, 5e4);
  const double noise_Pa = GENERATE(0.0, 1e3, 5e3);
  const std::size_t repeats = GENERATE(std::size_t{1}, std::size_t{4}, std::size_t{20});
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  RelaxationData data;
  double value = 0.0;
  for (std::size_t i = 1; i <= 3000; ++i) {
    data.time_s.push_back(0.1 * static_cast<double>(i));
    if (i % repeats == 0 || i == 1) {
      value = relaxation_modulus_Pa(two_terms(), data.time_s.back()) + noise_Pa * normal(random);
      if (resolution > 0.0) value = resolution * std::round(value / resolution);
    }
    data.value.push_back(value);
  }
  CAPTURE(resolution, noise_Pa, repeats);
  CHECK(flags_of(checked(data).notes).empty());
}

TEST_CASE("a liquid that relaxes to nothing and a clipped force are healthy", "[fit]") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 100.0);
  RelaxationData data;
  for (std::size_t i = 0; i < 3000; ++i) {
    data.time_s.push_back(0.1 * static_cast<double>(i));
    const double modulus_Pa = 1e6 * std::exp(-data.time_s.back() / 20.0) + normal(random);
    data.value.push_back(std::max(0.0, 50.0 * std::round(modulus_Pa / 50.0)));
  }
  CHECK(flags_of(checked(data).notes).empty());
  // Out of contact, pressed, lifted off, pressed again; the force cannot be negative.
  const auto depth_m = [](double t) {
    return 1e-4 * std::max({std::min({t - 5.0, 1.0, 30.0 - t}), std::min({t - 40.0, 1.0}), -0.2});
  };
  IndentationData touch = indentation_of(s2(), even_times(60.0, 0.05), depth_m, 1e-3, 8);
  for (double& force : touch.force_N) force = std::max(0.0, force);
  const CheckedRecord found({touch.time_s, touch.force_N, touch.depth_m}, 6, RecordKind::kHistory);
  CHECK(flags_of(found.notes).empty());
}

TEST_CASE("one stamp far off is left out and named", "[fit]") {
  std::mt19937_64 random(8);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(80 + static_cast<std::uint64_t>(k));
    const auto at = std::uniform_int_distribution<std::size_t>(0, 1999)(random);
    data.time_s[at] += std::uniform_real_distribution<double>(150.0, 900.0)(random);
    const CheckedRecord found = checked(data);
    CAPTURE(at, data.time_s[at]);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"stamps-left-out"});
    CHECK_THAT(found.notes.faults[0].text, Contains("row " + std::to_string(at + 1) + " (t = "));
    CHECK(found.clean.column(0).size() == 1999);
  }
  RelaxationData data = record(9);
  data.time_s[1200] = 0.0;  // a stamp that was not written
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.is_trustworthy);
  CHECK(n_left_out(fit, "stamp") == 1);
  check_values_of_material(fit);
}

TEST_CASE("rows in any order and stamps that overtake each other are healthy", "[fit]") {
  RelaxationData data = record(10);
  const std::string order = GENERATE("reversed", "shuffled", "overtaking", "halves");
  std::vector<std::size_t> rows(data.time_s.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  std::mt19937_64 random(11);
  if (order == "reversed") std::reverse(rows.begin(), rows.end());
  if (order == "shuffled") std::shuffle(rows.begin(), rows.end(), random);
  if (order == "overtaking") {
    for (std::size_t i = 10; i + 1 < rows.size(); i += 97) std::swap(rows[i], rows[i + 1]);
  }
  if (order == "halves") std::rotate(rows.begin(), rows.begin() + 900, rows.end());
  RelaxationData mixed;
  for (const std::size_t i : rows) {
    mixed.time_s.push_back(data.time_s[i]);
    mixed.value.push_back(data.value[i]);
  }
  CAPTURE(order);
  const CheckedRecord found = checked(mixed);
  CHECK(flags_of(found.notes).empty());
  CHECK(found.clean.column(0).size() == data.time_s.size());
}

TEST_CASE("two records in one table are refused if they differ", "[fit]") {
  std::mt19937_64 random(12);
  for (int k = 0; k < kPositions; ++k) {
    RelaxationData data = record(100 + static_cast<std::uint64_t>(k), 400);
    const RelaxationData second = record(200 + static_cast<std::uint64_t>(k), 400);
    const double factor = std::uniform_real_distribution<double>(1.05, 2.0)(random);
    for (std::size_t i = 0; i < second.time_s.size(); ++i) {
      data.time_s.push_back(second.time_s[i]);
      data.value.push_back(factor * second.value[i]);
    }
    CAPTURE(factor);
    CHECK_THROWS_WITH(fit_relaxation(data),
                      Contains("goes back at row 401") && Contains("Save rows 401 to 800"));
  }
  RelaxationData same = record(1, 400);
  const RelaxationData again = record(2, 400);
  same.time_s.insert(same.time_s.end(), again.time_s.begin(), again.time_s.end());
  same.value.insert(same.value.end(), again.value.begin(), again.value.end());
  const FitResult fit = fit_relaxation(same);
  CHECK(fit.is_trustworthy);
  CHECK(has_flag(fit, "records-appended"));
}

TEST_CASE("rows before the load are left out, and the load is t = 0", "[fit]") {
  std::mt19937_64 random(13);
  std::normal_distribution<double> noise(0.0, 1e3);
  const bool is_creep = GENERATE(false, true);
  for (int k = 0; k < kPositions; ++k) {
    const double load_s = std::uniform_real_distribution<double>(0.45, 60.0)(random);
    std::vector<double> time_s, value;
    std::size_t n_before = 0;
    for (std::size_t i = 0; i < 2000; ++i) {
      time_s.push_back(0.1 * static_cast<double>(i));
      const double since_s = time_s.back() - load_s;
      double modulus_Pa = 0.0;
      if (since_s >= 0.0) modulus_Pa = relaxation_modulus_Pa(two_terms(), since_s);
      n_before += since_s < 0.0 ? 1 : 0;
      value.push_back(modulus_Pa + noise(random));
      if (is_creep) {
        value.back() = (since_s >= 0.0 ? creep_compliance_1_Pa(
                                             retardation_from_relaxation(two_terms()), since_s)
                                       : 0.0) +
                       1e-12 * noise(random);
      }
    }
    CAPTURE(is_creep, load_s);
    const CheckedRecord found({time_s, value}, 4,
                              is_creep ? RecordKind::kCreep : RecordKind::kRelaxation);
    REQUIRE(flags_of(found.notes) == std::vector<std::string>{"before-load-left-out"});
    CHECK(found.clean.column(0).size() == 2000 - n_before);
    REQUIRE(found.notes.rise_s);
    CHECK(found.notes.rise_s->first <= load_s);
    CHECK(found.notes.rise_s->second >= load_s);
    if (k > 1) continue;
    const FitResult fit = is_creep ? fit_creep({time_s, value}) : fit_relaxation({time_s, value});
    CHECK(fit.is_trustworthy);
    CHECK(holds(fit.E0_interval_95, kE0_Pa));
    CHECK(has_flag(fit, "time-zero-chosen"));
  }
}

TEST_CASE("times of a clock that began long before are counted from the load", "[fit]") {
  const double clock_s = GENERATE(1.7e9, 3.8e9, 4e5);
  RelaxationData data = record(14);
  for (double& time_s : data.time_s) time_s += clock_s;
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.is_trustworthy);
  CHECK(has_flag(fit, "clock-offset"));
  CHECK(holds(fit.E0_interval_95, kE0_Pa));
  check_values_of_material(fit, 0.01);
}

TEST_CASE("a record that begins late without its loading gives the modulus there", "[fit]") {
  const double late_s = GENERATE(1.5, 5.0, 50.0, 500.0, 5000.0);
  const bool is_creep = GENERATE(false, true);
  CAPTURE(late_s, is_creep);
  RelaxationData data = record(15);
  if (is_creep) {
    for (double& value : data.value) value = 1.0 / value;
  }
  for (double& time_s : data.time_s) time_s += late_s;
  const FitResult fit = is_creep ? fit_creep({data.time_s, data.value}) : fit_relaxation(data);
  CHECK_FALSE(fit.is_trustworthy);
  REQUIRE(fit.first);
  CHECK(fit.first->modulus_Pa == Approx(relaxation_modulus_Pa(two_terms(), 0.1)).epsilon(0.01));
  CHECK_THAT(text_of_flag(fit, "time-zero-doubtful"),
             Contains("cropped") && Contains("--time-zero"));
}

TEST_CASE("a record of logarithmic times, or a flat one, may begin late", "[fit]") {
  RelaxationData data;
  const bool is_flat = GENERATE(false, true);
  std::mt19937_64 random(16);
  std::normal_distribution<double> normal(0.0, 1e3);
  for (int i = 0; i < 300; ++i) {
    data.time_s.push_back(is_flat ? 10.0 + 0.5 * i : std::pow(10.0, i / 100.0));
    data.value.push_back((is_flat ? 1e6 : relaxation_modulus_Pa(two_terms(), data.time_s.back())) +
                         normal(random));
  }
  CHECK_FALSE(has_flag(fit_relaxation(data), "time-zero-doubtful"));
}

TEST_CASE("good rows are no spikes if the noise grows with the value", "[fit]") {
  const double falls_to = GENERATE(0.02, 0.05, 0.5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (std::size_t i = 1; i <= 3000; ++i) {
      data.time_s.push_back(0.1 * static_cast<double>(i));
      const double share = falls_to + (1.0 - falls_to) * std::exp(-data.time_s.back() / 5.0);
      data.value.push_back(1e6 * share * (1.0 + 0.01 * normal(random)));
    }
    CAPTURE(falls_to, seed);
    CHECK(isolated_spikes(data.time_s, data.value).empty());
    if (seed < 3) CHECK(fit_relaxation(data).n_spikes == 0);
  }
}

TEST_CASE("a cycle in a record is fitted beside the relaxation", "[fit]") {
  const double period_s = GENERATE(9.0, 27.0, 41.0);
  const PronySeries truth{1e6, {{0.2e6, 0.5}, {0.2e6, 8.0}}};
  int holding = 0, found = 0;
  constexpr int kRuns = 4;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, 1e3);
    RelaxationData data;
    for (int i = 1; i <= 2000; ++i) {
      const double t = 0.06 * i;
      data.time_s.push_back(t);
      data.value.push_back(relaxation_modulus_Pa(truth, t) + normal(random) +
                           1e4 * std::sin(2.0 * M_PI * t / period_s + static_cast<double>(seed)));
    }
    const FitResult fit = fit_relaxation(data);
    CAPTURE(period_s, seed, fit.E0_Pa, fit.E_inf_Pa);
    found += has_flag(fit, "cycle-fitted") ? 1 : 0;
    CHECK(fit.terms.size() >= 2);
    CHECK(fit.E0_Pa == Approx(1.4e6).epsilon(0.01));
    holding += holds(fit.E0_interval_95, 1.4e6) ? 1 : 0;
    holding += holds(fit.E_inf_interval_95, 1e6) ? 1 : 0;
  }
  CHECK(found == kRuns);
  CHECK(holding >= 2 * kRuns - 1);
}

TEST_CASE("noise with a memory has no cycle", "[fit]") {
  const double rho = GENERATE(0.9, 0.97, 0.99);
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RelaxationData data = relaxation_of(s2(), 2000, 1000.0, 0.01, seed, rho);
    found += find_cycle(data.time_s, data.value) ? 1 : 0;
  }
  CAPTURE(rho);
  CHECK(found == 0);
}

TEST_CASE("readings of unequal noise weigh by their own, and the least modulus is covered",
          "[fit]") {
  // A master curve that was shifted beforehand, from 1 GPa to 2 MPa, with 1 % of each value.
  PronySeries truth{2e6, {}};
  for (int k = 0; k < 14; ++k) {
    truth.terms.push_back({9.98e8 * 0.4 * std::pow(0.6, k), 1e-6 * std::pow(10.0, k)});
  }
  int of_E_inf = 0, of_E0 = 0;
  constexpr int kRuns = 6;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 0; i < 300; ++i) {
      data.time_s.push_back(1e-7 * std::pow(10.0, 17.0 * i / 299.0));
      data.value.push_back(relaxation_modulus_Pa(truth, data.time_s.back()) *
                           (1.0 + 0.01 * normal(random)));
    }
    const FitResult fit = fit_relaxation(data);
    CAPTURE(seed, fit.E_inf_Pa, fit.E_inf_interval_95.low, fit.E_inf_interval_95.high);
    CHECK(has_flag(fit, "noise-grows"));
    CHECK(fit.E_inf_Pa == Approx(2e6).epsilon(0.03));
    of_E_inf += holds(fit.E_inf_interval_95, 2e6) ? 1 : 0;
    of_E0 += holds(fit.E0_interval_95, instantaneous_modulus_Pa(truth)) ? 1 : 0;
  }
  CHECK(of_E_inf >= kRuns - 1);
  CHECK(of_E0 >= kRuns - 2);
}

TEST_CASE("times that were cut off widen the intervals of the terms", "[fit]") {
  const PronySeries truth{1e6, {{0.3e6, 0.4}, {0.2e6, 10.0}}};
  int of_first = 0;
  constexpr int kRuns = 8;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, 1e3);
    RelaxationData data;
    for (int i = 1; i <= 600; ++i) {
      const double t = i / 7.0;
      data.time_s.push_back(0.1 * std::floor(10.0 * t));
      data.value.push_back(relaxation_modulus_Pa(truth, t) + normal(random));
    }
    const FitResult fit = fit_relaxation(data);
    if (fit.terms.size() != 2) continue;
    of_first += holds(fit.terms[0].modulus_Pa_95, 0.3e6) && holds(fit.terms[0].g_95, 0.2) ? 1 : 0;
  }
  CHECK(of_first >= kRuns - 1);
}

TEST_CASE("intervals of moduli do not reach below zero", "[fit]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FitResult fit = fit_relaxation(relaxation_of(s2(), 12, 1.0, 0.5, seed));
    CHECK(fit.E0_interval_95.low >= 0.0);
    CHECK(fit.E_inf_interval_95.low >= 0.0);
    for (const FittedTerm& term : fit.terms) CHECK(term.modulus_Pa_95.low >= 0.0);
  }
}

TEST_CASE("blocks that jump away and back, and a load that is lost, are left out with any scatter",
          "[fit]") {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  const auto value_of = [](double t) {
    return 1e6 + 0.3e6 * std::exp(-t / 3.0) + 0.2e6 * std::exp(-t / 30.0);
  };
  const auto damaged = [&](std::size_t from, std::size_t count, double level) {
    RelaxationData data;
    for (std::size_t i = 0; i < 2000; ++i) {
      data.time_s.push_back(0.1 * static_cast<double>(i + 1));
      const bool is_bad = i >= from && i < from + count;
      data.value.push_back((is_bad ? level : value_of(data.time_s.back())) + 1e3 * normal(random));
    }
    return data;
  };
  for (const double level : {0.0, 3e6, -2e6, 5e4}) {
    for (const std::size_t count : {2, 5, 20, 100, 400}) {
      const std::size_t from = 30 + random() % 1500;
      CAPTURE(level, count, from);
      const CheckedRecord found = checked(damaged(from, count, level));
      REQUIRE(found.notes.left_out.size() == 1);
      CHECK(found.notes.left_out[0].second == count);
      CHECK(std::string(found.notes.left_out[0].first) == "dropout");
    }
  }
  for (const std::size_t count : {2, 10, 500}) {
    CAPTURE(count);
    const CheckedRecord found = checked(damaged(2000 - count, count, 0.0));
    REQUIRE(found.notes.left_out.size() == 1);
    CHECK(found.notes.left_out[0].second == count);
  }
}

TEST_CASE("sampling in log time that began after t = 0 is a late clock, and a cropped one is not",
          "[fit]") {
  const auto found = [](double from_s, double offset_s) {
    RelaxationData data;
    for (double t = from_s; t < 200.0; t *= 1.04) {
      data.time_s.push_back(t + offset_s);
      data.value.push_back(1e6 + 0.5e6 * std::exp(-t / 3.0));
    }
    CheckedRecord record({data.time_s, data.value}, 6, RecordKind::kRelaxation);
    check_clock(record.clean, record.notes);
    return record.notes.late_s;
  };
  CHECK_FALSE(found(0.1, 0.0));
  CHECK_FALSE(found(1.1, 0.0));
  CHECK_FALSE(found(20.0, 0.0));
  for (const double offset_s : {1.0, 5.0}) {
    const auto late_s = found(0.1, offset_s);
    REQUIRE(late_s);
    CHECK(*late_s == Approx(0.1 + offset_s));
  }
}

TEST_CASE("rows before the load are recognised if the first of them is next to zero", "[fit]") {
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal(0.0, 1e3);
  for (const double first : {0.0, -0.04, 1e-9}) {
    RelaxationData data;
    for (int i = 0; i < 400; ++i) {
      const double t = 0.1 * (i - 17);
      data.time_s.push_back(0.1 * i);
      data.value.push_back((t < 0.0 ? 0.0 : 1e6 + 0.5e6 * std::exp(-t / 3.0)) + normal(random));
    }
    data.value[0] = first;
    CAPTURE(first);
    const CheckedRecord found = checked(data);
    REQUIRE(found.notes.left_out.size() == 1);
    CHECK(std::string(found.notes.left_out[0].first) == "before_load");
    CHECK(found.notes.left_out[0].second == 17);
  }
}
