#pragma once

#include "models/material/material.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// One record, or one specimen, in the joint fit: (ln E0, ln g_i, ln tau_i) with the covariance of
// its error.
struct RatioEstimate {
  double ratio = 0.0;
  Eigen::VectorXd theta;
  Eigen::MatrixXd covariance;
  int specimen = 0;  // records with the same number are touches on one specimen
};

// Which records must have the same number of terms.
enum class EqualTerms { kEverywhere, kAtEachRatio, kNowhere };

// Records with the same Material::specimen_id and ratio are touches on one specimen; a record
// without id is a specimen of its own.
// Throws std::invalid_argument that names the record: no ratio, no covariance, a number of terms
// that must not differ, a share of zero.
std::vector<RatioEstimate> ratio_estimates_of(const std::vector<Material>& records,
                                              EqualTerms equal = EqualTerms::kEverywhere);

std::vector<double> distinct_ratios(const std::vector<RatioEstimate>& estimates);  // ascending
int count_specimens(const std::vector<RatioEstimate>& records);

}  // namespace viscard
