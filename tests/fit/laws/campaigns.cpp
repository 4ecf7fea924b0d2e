#include "tests/fit/laws/campaigns.h"

#include <cmath>

namespace viscard::test {

Eigen::VectorXd truth_at(const Campaign& campaign, double ratio) {
  Eigen::VectorXd theta(5);
  theta << std::log(20e6) + campaign.exponent * std::log(ratio),
      std::log(0.10) + campaign.g_slope * std::log(ratio / 10.0),
      std::log(0.05) + campaign.g_slope * std::log(ratio / 10.0), std::log(0.8), std::log(40.0);
  return theta;
}

Eigen::VectorXd with_spread(const Campaign& campaign, Eigen::VectorXd theta,
                            std::mt19937_64& dice) {
  std::normal_distribution<double> normal;
  theta[0] += campaign.spread_ln_E0 * normal(dice);
  for (int i = 1; i <= 2; ++i) theta[i] += campaign.spread_ln_g * normal(dice);
  for (int i = 3; i <= 4; ++i) theta[i] += campaign.spread_ln_tau * normal(dice);
  return theta;
}

Material material_of(const Eigen::VectorXd& theta, double ratio, double se) {
  Material material;
  material.name = "specimen";
  material.nu = 0.495;
  material.mixing_ratio = ratio;
  material.E0_Pa = std::exp(theta[0]);
  const double g1 = std::exp(theta[1]), g2 = std::exp(theta[2]);
  material.terms = {{g1, g1, std::exp(theta[3])}, {g2, g2, std::exp(theta[4])}};
  material.valid = {0.1, 1000.0, 0.0};
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(5, 5);
  slopes.row(0) << material.E0_Pa * (1.0 - g1 - g2), -material.E0_Pa * g1, -material.E0_Pa * g2,
      0.0, 0.0;
  slopes.row(1) << material.E0_Pa * g1, material.E0_Pa * g1, 0.0, 0.0, 0.0;
  slopes.row(2) << material.E0_Pa * g2, 0.0, material.E0_Pa * g2, 0.0, 0.0;
  slopes(3, 3) = slopes(4, 4) = 1.0;
  material.uncertainty.emplace();
  material.uncertainty->covariance = se * se * slopes * slopes.transpose();
  return material;
}

std::vector<Material> measured(const Campaign& campaign, std::mt19937_64& dice) {
  std::normal_distribution<double> normal;
  std::vector<Material> out;
  for (const double ratio : campaign.ratios) {
    for (int k = 0; k < campaign.specimens_per_ratio; ++k) {
      Eigen::VectorXd theta = with_spread(campaign, truth_at(campaign, ratio), dice);
      for (int i = 0; i < 5; ++i) theta[i] += campaign.fit_se * normal(dice);
      out.push_back(material_of(theta, ratio, campaign.fit_se));
    }
  }
  return out;
}

}  // namespace viscard::test
