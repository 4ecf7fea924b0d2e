#include "fit/large_strain/damage_checks.h"

#include "fit/large_strain/rubber_band.h"
#include "models/hyperelastic/law_energy.h"
#include "models/maths/interval.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace viscard {
namespace {

enum class Branch { kFirst, kUnloading, kReloading };

// What the readings of all tests went through.
struct BranchSums {
  double left[3] = {}, of_stress[3] = {};  // squares, by Branch
  double deepest = 0.0;                    // largest (W_m - W)/(m + beta W_m)

  std::optional<double> misfit(Branch branch) const {
    const auto b = static_cast<std::size_t>(branch);
    if (!(of_stress[b] > 0.0)) return std::nullopt;
    return std::sqrt(left[b] / of_stress[b]);
  }
};

void add_branches(const LargeStrainTest& test, const FittedRubber& fitted, BranchSums& sums) {
  const MullinsDamage& damage = fitted.damage->constants;
  const std::vector<double> stress_Pa = stresses_Pa(fitted, test);
  double largest = 0.0, before = 0.0;
  Branch branch = Branch::kFirst;
  for (std::size_t i = 0; i < test.stretch.size(); ++i) {
    const double energy =
        energy_Pa(fitted.law, std::log(test.stretch[i]) * strain_direction(test.deformation));
    if (energy >= largest) {
      branch = Branch::kFirst;
    } else if (energy != before) {
      branch = energy < before ? Branch::kUnloading : Branch::kReloading;
    }
    largest = std::max(largest, energy);
    before = energy;
    const double width = damage.m_Pa + damage.beta * largest;
    if (energy < largest) sums.deepest = std::max(sums.deepest, (largest - energy) / width);
    const double left = test.nominal_stress_Pa[i] - stress_Pa[i];
    const auto b = static_cast<std::size_t>(branch);
    sums.left[b] += left * left;
    sums.of_stress[b] += test.nominal_stress_Pa[i] * test.nominal_stress_Pa[i];
  }
}

void add_constants(const Eigen::MatrixXd& covariance, FittedRubber& fitted) {
  FittedDamage& damage = *fitted.damage;
  const double values[] = {damage.constants.r, damage.constants.m_Pa, damage.constants.beta};
  const Eigen::Index first = covariance.rows() - 3;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto gradient = Eigen::VectorXd::Unit(covariance.rows(), first + k);
    const double se = fitted.unseen.change(gradient)
                          ? std::numeric_limits<double>::infinity()
                          : std::sqrt(std::max(0.0, covariance(first + k, first + k)));
    const double value = values[k], half = kNormal95 * se;
    damage.parameters.push_back({damage_parameter_names()[static_cast<std::size_t>(k)],
                                 value,
                                 se,
                                 {value - half, value + half}});
  }
  damage.covariance = covariance;
}

void add_flags(const FoundDamage& found, const BranchSums& sums, FittedRubber& fitted) {
  const FittedDamage& damage = *fitted.damage;
  const auto add = [&](const char* name, const std::string& text) {
    fitted.flags.push_back({name, 0, text});
  };
  if (damage.has_one_maximum) {
    add("one-maximum",
        "all unloading is from one maximum, so that only m + beta W_m counts: beta is held at 0, "
        "and m holds for this maximum; add cycles to another maximum");
  } else if (!found.fits_m || !found.fits_beta) {
    add("held-at-zero",
        std::string(found.fits_m ? "beta" : "m") +
            " of the damage ended at 0 and is held there; its interval is not known");
  }
  constexpr double kDeepEnough = 1.0;
  if (sums.deepest < kDeepEnough) {
    add("shallow-unloading",
        "unloading reaches (W_m - W)/(m + beta W_m) = " + text_of(sums.deepest, 2) +
            ", below 1, so that the data do not determine r, the softening at rest; unload "
            "further");
    fitted.is_trustworthy = false;
  }
  constexpr double kMostBranchMisfit = 0.1;
  for (const auto& [misfit, name] : {std::pair{damage.misfit_unloading, "unloading"},
                                     std::pair{damage.misfit_reloading, "reloading"}}) {
    if (!misfit || *misfit <= kMostBranchMisfit) continue;
    add("branch-misfit", std::string("the law misses the stresses of ") + name + " by " +
                             text_of(100.0 * *misfit, 2) +
                             " % (root mean square): it has neither set nor hysteresis, which real "
                             "rubber has");
  }
}

}  // namespace

void add_damage(const std::vector<LargeStrainTest>& tests, const FoundDamage& found,
                double stress_scale_Pa, const Eigen::MatrixXd& covariance, FittedRubber& fitted) {
  FittedDamage& damage = fitted.damage.emplace();
  damage.constants = found.constants;
  damage.constants.m_Pa *= stress_scale_Pa;
  damage.has_one_maximum = found.has_one_maximum;
  add_constants(covariance, fitted);
  BranchSums sums;
  for (const LargeStrainTest& test : tests) add_branches(test, fitted, sums);
  damage.misfit_first_loading = sums.misfit(Branch::kFirst);
  damage.misfit_unloading = sums.misfit(Branch::kUnloading);
  damage.misfit_reloading = sums.misfit(Branch::kReloading);
  add_flags(found, sums, fitted);
}

}  // namespace viscard
