#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/samples/decay.h"
#include "fit/samples/log_bins.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Moments of many bins as arrays, for evaluating whole columns of a model at once.
struct BinArrays {
  explicit BinArrays(const std::vector<LogBin>& bins);
  // For the decay averaged over each bin times sqrt(count); no moments if each bin is one sample.
  DecayPlaces places(bool has_averages) const;

  Eigen::ArrayXd time_s, weight;  // mean time, sqrt(count)
  Eigen::ArrayXd half_m2, sixth_m3, part_m4;
};

// The information within bins that averaging removes: products of the data and of exponentials with
// the first three orthogonal polynomials within each bin, times sqrt(count). With d = t - mean,
//   P1 = d/n1, P2 = (d^2 - m2 - d m3/m2)/n2, P3 = (d^3 - m3 - d m4/m2 - (q/n2) P2)/n3, q = <d^3 P2>
// (n1, n2, n3: their norms). For an exponential with u = 1/tau and x = u mean, the product with P1
// is exp(-x) (-u <d P1> + u^2 <d^2 P1>/2 - u^3 <d^3 P1>/6), and those with P2 and P3 keep their
// leading terms. The neglected terms are below 3e-10 of a residual sum of squares. Rows: P1 of all
// bins with more than one sample, then P2, then P3.
class BinShapes {
 public:
  explicit BinShapes(const std::vector<LogBin>& bins);

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_rows() const { return data_.size(); }
  Eigen::VectorXd line() const;  // the products of the function t
  // The products of an exponential, and d/d ln tau unless slope is nullptr.
  void decay(double rate_1_s, Eigen::Ref<Eigen::VectorXd> value, Eigen::VectorXd* slope) const;

 private:
  Eigen::ArrayXd time_s_, weight_;
  Eigen::ArrayXd n1_, a_, b_;  // norm of d; <d^3>/(2 m2), <d^4>/(6 m2)
  Eigen::ArrayXd n2_, n3_;
  Eigen::VectorXd data_;
};

// Variance of a sample within bins, about a parabola, so that a smooth curve adds nothing to it. 0
// if no bin holds enough samples.
double variance_within(const std::vector<LogBin>& bins);

}  // namespace viscard
