#pragma once

#include "fit/intervals/fitted_law.h"
#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/foam_law.h"
#include "models/hyperelastic/law_stability.h"
#include "models/hyperelastic/mullins_damage.h"
#include "models/material/material.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// One fitted term of relaxation beside a law. Not a FittedTerm: it has no modulus of its own.
struct FittedRubberTerm : RubberTerm {
  double g_se = 0.0, ln_tau_se = 0.0;         // standard errors, pure numbers
  Interval g_interval_95, tau_s_interval_95;  // of the time symmetric in the logarithm
};

// One number of terms that was tried.
struct RubberOrder {
  int n_terms = 0;
  double bic = 0.0;
  bool is_eligible = true;  // converged, no time at the end of its range
  bool is_chosen = false;
};

// Directions of the parameters (moduli, shapes, g, ln tau) along which the data do not change: columns,
// in steps of each parameter that change the rows alike. Empty: none.
struct UnseenDirections {
  Eigen::MatrixXd columns;
  Eigen::VectorXd step;
  // True if a quantity with this gradient by the first parameters is not determined.
  bool change(const Eigen::VectorXd& gradient) const {
    constexpr double kRounding = 1e-4;
    if (columns.size() == 0) return false;
    const Eigen::VectorXd scaled = gradient.cwiseProduct(step.head(gradient.size()));
    return (columns.topRows(gradient.size()).transpose() * gradient).norm() >
           kRounding * scaled.norm();
  }
};

// Damage beside a law. Misfits are root mean squares relative to the stresses of their branch; nothing
// without readings on it.
struct FittedDamage {
  MullinsDamage constants;
  std::vector<LawParameter> parameters;  // r, m_Pa, beta; those that are held have no error
  Eigen::MatrixXd covariance;            // of the law's parameters, then r, m_Pa, beta
  bool has_one_maximum = false;          // all unloading is from one maximum: beta is held at 0
  // Relative to the stresses of the branch, pure numbers.
  std::optional<double> misfit_first_loading, misfit_unloading, misfit_reloading;
};

// A foam, which stands in the place of a law of rubber.
struct FittedFoam {
  FoamLaw law;
  bool has_one_nu = true;  // of all terms: one of each is no better by BIC
  bool nu_is_given = false;
};

// One law fitted to all tests. With terms it is the instantaneous law, of which 1 - sum g is left after
// all relaxation.
struct FittedRubber {
  HyperelasticLaw law;
  std::vector<LawParameter> parameters;  // moduli, then shapes
  Eigen::MatrixXd covariance;            // of them, in that order; rows of held ones are zero
  double E0_Pa = 0.0, E0_se_Pa = 0.0;    // Young's modulus at rest
  Interval E0_interval_95;
  std::vector<FittedRubberTerm> terms;  // of relaxation, by ascending time; empty: elastic
  // Of the parameters, the g and the ln tau, in that order; empty without terms.
  Eigen::MatrixXd series_covariance;
  std::optional<FittedDamage> damage;        // softening by the first loading; never beside terms
  std::optional<FittedFoam> foam;            // then `law` means nothing
  UnseenDirections unseen;                   // quantities along them have infinite intervals
  double E_inf_Pa = 0.0, E_inf_se_Pa = 0.0;  // Young's modulus at rest after all relaxation
  Interval E_inf_interval_95;
  std::vector<RubberOrder> orders;  // numbers of terms that were tried
  int n_parameters = 0;
  double rss = 0.0;           // Pa^2, unweighted, over all readings
  double rms_relative = 0.0;  // root of rss over the sum of squared stresses
  double aicc = 0.0, bic = 0.0;
  double inflation = 1.0;  // of variances, by the memory that its residuals have along each test
  std::array<StableRange, 3> stable;  // in the order of Deformation
  std::vector<MaterialFlag> flags;
  bool is_trustworthy = true;
};

// The terms of relaxation of a fitted law.
inline std::vector<RubberTerm> relaxation_of(const FittedRubber& fitted) {
  return {fitted.terms.begin(), fitted.terms.end()};
}

// Name of a fitted law, "yeoh" or "hyperfoam-2".
inline std::string name_of(const FittedRubber& fitted) {
  return fitted.foam ? foam_name(fitted.foam->law.mu_Pa.size()) : name_of(fitted.law.form);
}

// What one test shows of the chosen law.
struct RubberTestSummary {
  std::string name;
  Deformation deformation = Deformation::kUniaxial;
  std::string kind;  // name of the deformation, or of the test of a foam
  std::size_t n_readings = 0;
  double least_stretch = 1.0, largest_stretch = 1.0;
  double rms_Pa = 0.0;  // of its residuals
};

// All laws, the chosen one, and what the tests show.
struct LargeStrainResult {
  std::vector<FittedRubber> laws;  // in the order of the options
  std::size_t chosen = 0;
  std::vector<RubberTestSummary> tests;
  std::vector<MaterialFlag> notes;  // about the data

  const FittedRubber& best() const { return laws[chosen]; }
};

}  // namespace viscard
