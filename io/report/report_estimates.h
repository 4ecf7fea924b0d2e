#pragma once

#include "io/report/report.h"
#include "io/report/report_numbers.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The estimates of a specimen in one form for the page, from its fit or else its material file.
struct Estimate {
  double value = 0.0;
  Interval interval_95;  // {0, 0}: not given
};

// Not a FittedTerm: the page shows each number with its interval alone, and those of a material file may lack errors.
struct TermEstimate {
  Estimate modulus_Pa, g, tau_s;
};

struct SpecimenEstimates {
  std::string label;        // specimen's id, or the material's name, or "specimen 2"
  std::string anchor;       // id of its section, unique on the page
  std::string specimen_id;  // those of repeated touches are equal; empty: not known
  double mixing_ratio = 0.0;
  bool is_stiffness = false;  // moduli are stiffnesses in N/m
  Estimate E0_Pa, E_inf_Pa;
  Estimate sum_g;  // 1 - E_inf/E0
  bool is_trustworthy = true;
  std::vector<TermEstimate> terms;               // ascending tau
  double systematic_relative = 0.0;              // of E0
  std::vector<SystematicPart> systematic_parts;  // its causes
  std::optional<TwoPointModulus> two_point;
  std::vector<MaterialFlag> flags;
  std::vector<std::string> covariance_parameters;
  Eigen::MatrixXd covariance;
};

// Throws std::invalid_argument if the specimen has neither fit nor material.
SpecimenEstimates estimates_from_specimen(const SpecimenReport& specimen, std::size_t index);

// The unit in which E0 of all specimens is shown.
ShownUnit modulus_unit(const std::vector<SpecimenEstimates>& estimates);

// True if the moduli of the specimens differ so much (a factor of 300) that tables show each in a
// unit of its own and figures have a log axis.
bool have_own_units(const std::vector<SpecimenEstimates>& estimates);

// E(t), or E(t)/E0, with its 95 % band to first order in the covariance C of the moduli and ln tau
// (variance J C J', J the derivatives by the parameters). The band of E(t)/E0 is narrower because a
// common factor of all moduli cancels. Without a covariance, low and high are empty.
struct RelaxationBand {
  std::vector<double> time_s, value, low, high;
};
RelaxationBand relaxation_band(const SpecimenEstimates& estimates,
                               const std::vector<double>& time_s, bool is_relative);

// One parameter whose true value is known. kInsideWithSystematic: the interval contains the truth
// only after the systematic parts are added in quadrature.
enum class Recovery { kInside, kInsideWithSystematic, kOutside, kNoInterval, kNotResolved };
struct RecoveredParameter {
  std::string name_html;  // "<i>E</i><sub>0</sub>"
  std::string unit;       // "Pa", "s" or ""
  double truth = 0.0;     // NaN: the truth does not have this term
  Estimate estimate;      // NaN: the fit does not have this term
  Recovery recovery = Recovery::kNoInterval;
};

// Terms are paired by nearest ln tau.
std::vector<RecoveredParameter> recovered_parameters(const SpecimenEstimates& estimates,
                                                     const Material& truth);

}  // namespace viscard
