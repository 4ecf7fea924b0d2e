// Values of a record that no specimen gives are named with their rows, and left out where that is unambiguous.
#include "fit/fit_creep.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/check_record.h"
#include "fit/samples/cycle.h"
#include "fit/samples/spikes.h"
#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/samples/checked_records.h"
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
