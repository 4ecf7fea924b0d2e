#pragma once

#include "fit/curves/joint_model.h"
#include "fit/intervals/grouped_covariance.h"
#include "fit/material_test.h"
#include "fit/samples/fit_data.h"
#include "models/material/prony_series.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace viscard {

// Several tests as one model, with the noise of each.
struct JointTests {
  std::unique_ptr<JointModel> model;
  std::vector<NoiseGroup> groups;
  std::vector<int> blocks;               // of rows, for cross-validation
  std::vector<Eigen::VectorXd> ln_time;  // of the rows of each test, since its load began
  std::vector<double> sigma;             // of one sample of each test
};

// The series about which creep is linearised first: that of the creep's own fit.
PronySeries starting_series(const std::vector<MaterialTest>& tests);

// Each test with the noise of its own fit. The rows of the tests must outlive the result.
JointTests joint_tests(const std::vector<MaterialTest>& tests, const FitOptions& options);

// Gives a test another standard deviation of one sample.
void set_sigma(std::size_t k, double sigma, JointTests& joint);

}  // namespace viscard
