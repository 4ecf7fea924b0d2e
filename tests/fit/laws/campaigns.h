#pragma once

#include "models/material/material.h"

#include <Eigen/Core>

#include <random>
#include <vector>

namespace viscard::test {

// The truth behind a campaign: ln E0 = ln(20 MPa) - ln r, and two terms.
struct Campaign {
  std::vector<double> ratios{10.0, 13.0, 20.0};
  int specimens_per_ratio = 3;
  double exponent = -1.0;
  double g_slope = 0.0;  // slope of ln g over ln(ratio)
  double spread_ln_E0 = 0.05, spread_ln_g = 0.05, spread_ln_tau = 0.05;
  double fit_se = 0.01;  // standard error of every ln parameter
};

// theta of the law: (ln E0, ln g_1, ln g_2, ln tau_1, ln tau_2).
Eigen::VectorXd truth_at(const Campaign& campaign, double ratio);

// theta of one specimen of that truth.
Eigen::VectorXd with_spread(const Campaign& campaign, Eigen::VectorXd theta, std::mt19937_64& dice);

// A fitted specimen with independent errors of the logarithms, as a covariance of (E_inf, E_i,
// ln tau).
Material material_of(const Eigen::VectorXd& theta, double ratio, double se);

// The fitted specimens of a campaign.
std::vector<Material> measured(const Campaign& campaign, std::mt19937_64& dice);

}  // namespace viscard::test
