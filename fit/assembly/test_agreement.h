#pragma once

#include "fit/curves/joint_model.h"
#include "fit/intervals/grouped_covariance.h"
#include "models/maths/interval.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace viscard {

// Tests whether one of several tests agrees with the spectrum of all. Its values may differ from
// that spectrum by a factor 1 + d(u), where d is a parabola in u = log time. The spectrum of all
// tests and d are fitted together (one linearised step), so d measures how far this test lies from
// the prediction of the others.
struct TestAgreement {
  double difference = 0.0;  // the same factor at all times
  Interval difference_95;
  double worst = 0.0;     // d where it exceeds its error most
  double at_least = 0.0;  // |d| there, minus 1.96 standard errors
  // Probability of so large a difference by chance: twice the smaller one of the probabilities for
  // a factor and for a parabola. F test with the noise of every test and its autocorrelation;
  // degrees of freedom of Satterthwaite, Biometrics Bull. 2 (1946) 110.
  double p_value = 1.0;
  int freedom = 0;  // number of directions in which the other tests allow a comparison
};

// For each test. state: an optimum of the model. ln_time: of the rows of each test. freedom: of each
// test's own noise. freed: this test has a parabola of its own while the others are compared.
std::vector<TestAgreement> test_agreement(const JointModel& model, const SpectralState& state,
                                          const std::vector<NoiseGroup>& groups,
                                          const std::vector<Eigen::VectorXd>& ln_time,
                                          const Eigen::VectorXd& freedom,
                                          std::optional<std::size_t> freed = std::nullopt);

}  // namespace viscard
