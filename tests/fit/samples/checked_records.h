// Records with a known truth, and what their fit says of their rows.
#pragma once

#include "fit/fit_relaxation.h"
#include "fit/samples/check_record.h"
#include "models/material/prony_series.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace viscard::test {

inline constexpr double kE0_Pa = 1.5e6, kE_inf_Pa = 1e6;
inline constexpr int kPositions = 20;

inline PronySeries two_terms() {
  return {kE_inf_Pa, {{0.2e6, 3.0}, {0.3e6, 30.0}}};
}

// 2000 rows at 10 Hz, from t = 0.1 s on, with noise of 0.1 % of E_inf.
inline RelaxationData record(std::uint64_t seed, std::size_t n = 2000) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1e3);
  RelaxationData data;
  for (std::size_t i = 1; i <= n; ++i) {
    data.time_s.push_back(0.1 * static_cast<double>(i));
    data.value.push_back(relaxation_modulus_Pa(two_terms(), data.time_s.back()) + normal(random));
  }
  return data;
}

inline std::vector<std::string> flags_of(const RecordNotes& notes) {
  std::vector<std::string> names;
  for (const RecordFault& fault : notes.faults) names.push_back(fault.flag);
  return names;
}

inline std::string text_of_flag(const FitResult& fit, const std::string& name) {
  for (const MaterialFlag& flag : fit.flags) {
    if (flag.name == name) return flag.text;
  }
  return "";
}

inline std::size_t n_left_out(const FitResult& fit, const std::string& reason) {
  for (const LeftOutRows& left : fit.left_out) {
    if (left.reason == reason) return left.count;
  }
  return 0;
}

inline void check_values_of_material(const FitResult& fit, double E0_tolerance = 0.004) {
  CHECK(fit.E0_Pa == Approx(kE0_Pa).epsilon(E0_tolerance));
  CHECK(fit.E_inf_Pa == Approx(kE_inf_Pa).epsilon(0.002));
}

inline CheckedRecord checked(const RelaxationData& data) {
  return CheckedRecord({data.time_s, data.value}, 4, RecordKind::kRelaxation);
}

}  // namespace viscard::test
