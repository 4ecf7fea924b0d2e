// What clocks of loggers do wrong is named with its rows, and mended where that is unambiguous.
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
  const bool is_creep = GENERATE(false, true), has_load = GENERATE(false, true);
  CAPTURE(late_s, is_creep, has_load);
  RelaxationData data = record(15);
  if (is_creep) {
    for (double& value : data.value) value = 1.0 / value;
  }
  for (double& time_s : data.time_s) time_s += late_s;
  std::vector<double> load;  // also if it stands in a column of its own
  if (has_load) {
    load.assign(data.value.size(), is_creep ? 2e4 : 0.02);
    for (double& value : data.value) value *= load.front();
  }
  CreepData creep{data.time_s, data.value};
  creep.stress_Pa = load;
  data.strain = load;
  const FitResult fit = is_creep ? fit_creep(creep) : fit_relaxation(data);
  CHECK_FALSE(fit.is_trustworthy);
  REQUIRE(fit.first);
  CHECK(fit.first->modulus_Pa == Approx(relaxation_modulus_Pa(two_terms(), 0.1)).epsilon(0.01));
  CHECK_THAT(text_of_flag(fit, "time-zero-doubtful"),
             Contains("cropped") && Contains("--time-zero"));
}

TEST_CASE("a table of force and depth that begins late under load gives the modulus there",
          "[fit]") {
  const double late_s = GENERATE(5.0, 50.0, 500.0);
  CAPTURE(late_s);
  const RelaxationData rows = record(17);
  IndentationData data;
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
    data.time_s.push_back(rows.time_s[i] + late_s);
    data.force_N.push_back(1e-4 * rows.value[i]);  // without a contact: a stiffness
    data.depth_m.push_back(1e-4);
  }
  const FitResult late = fit_indentation(data);
  CHECK_FALSE(late.is_trustworthy);
  REQUIRE(late.first);
  CHECK(late.first->modulus_Pa == Approx(relaxation_modulus_Pa(two_terms(), 0.1)).epsilon(0.01));
  CHECK_THAT(text_of_flag(late, "time-zero-doubtful"), Contains("--time-zero"));
  data.time_s = rows.time_s;
  const FitResult known = fit_indentation(data);
  CHECK(known.is_trustworthy);
  CHECK(holds(known.E0_interval_95, kE0_Pa));
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
