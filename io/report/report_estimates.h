#pragma once

#include "io/report/report_input.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a specimen's fit, or its material file when there is no fit, says; one form for the page.
struct Estimate {
  double value = 0.0;
  Interval interval_95;  // {0, 0}: not given
};

struct TermEstimate {
  Estimate modulus_Pa, g, tau_s;
};

struct SpecimenEstimates {
  std::string label;   // specimen's id, or the material's name, or "specimen 2"
  std::string anchor;  // of its section, unique on the page
  double mixing_ratio = 0.0;
  bool is_stiffness = false;  // moduli are stiffnesses in N/m
  Estimate E0_Pa, E_inf_Pa;
  Estimate sum_g;  // 1 - E_inf/E0
  bool is_trustworthy = true;
  std::vector<TermEstimate> terms;  // ascending tau
  double systematic_relative = 0.0;
  std::optional<TwoPointModulus> two_point;
  std::vector<MaterialFlag> flags;
  std::vector<std::string> covariance_parameters;
  Eigen::MatrixXd covariance;
};

// Throws std::invalid_argument if the specimen has neither fit nor material.
SpecimenEstimates estimates_from_specimen(const SpecimenReport& specimen, std::size_t index);

PronySeries series_from_estimates(const SpecimenEstimates& estimates);

// E(t), or E(t)/E0, with its 95 % band to first order in the covariance of the moduli and ln tau
// (var = J C J'); the relative one is narrower because a common factor of all moduli cancels.
// Without a covariance low and high are empty.
struct RelaxationBand {
  std::vector<double> time_s, value, low, high;
};
RelaxationBand relaxation_band(const SpecimenEstimates& estimates,
                               const std::vector<double>& time_s, bool is_relative);

// One parameter whose truth is known. An interval contains the truth either by itself or once the
// systematic part, which scales all moduli together, is added in quadrature.
enum class Recovery { kInside, kInsideWithSystematic, kOutside, kNoInterval, kNotResolved };
struct RecoveredParameter {
  std::string name_html;  // "<i>E</i><sub>0</sub>"
  std::string unit;       // "Pa", "s" or ""
  double truth = 0.0;     // NaN: the fit has a term that the truth has not
  Estimate estimate;      // NaN: the fit does not have this term
  Recovery recovery = Recovery::kNoInterval;
};

// Terms are paired by nearest ln tau.
std::vector<RecoveredParameter> recovered_parameters(const SpecimenEstimates& estimates,
                                                     const Material& truth);

}  // namespace viscard
