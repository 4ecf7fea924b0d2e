#pragma once

#include "fit/curves/spectral_model.h"
#include "fit/samples/decay.h"
#include "fit/samples/log_bins.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// The moments of many bins in columns, for whole columns of a model at once.
struct BinArrays {
  explicit BinArrays(const std::vector<LogBin>& bins);
  // Decay averaged over every bin times sqrt(count), without averages where each is one sample.
  DecayPlaces places(bool has_averages) const;

  Eigen::ArrayXd time_s, weight;  // mean time, sqrt(count)
  Eigen::ArrayXd half_m2, sixth_m3, part_m4;
};

// What averages hide of data and exponentials: their products with the first three orthogonal
// polynomials within each bin, times sqrt(count). With d = t - mean,
//   P1 = d/n1, P2 = (d^2 - m2 - d m3/m2)/n2, P3 = (d^3 - m3 - d m4/m2 - (q/n2) P2)/n3, q = <d^3 P2>
// (n: their lengths). An exponential has -u <d P1> + u^2 <d^2 P1>/2 - u^3 <d^3 P1>/6 times exp(-x)
// of P1, u = 1/tau, x = u mean, and the leading term of P2 and P3; what is left out is below 3e-10
// of a residual sum of squares. Rows: P1 of all bins with more than one sample, then P2, then P3.
class BinShapes {
 public:
  explicit BinShapes(const std::vector<LogBin>& bins);

  const Eigen::VectorXd& data() const { return data_; }
  Eigen::Index n_rows() const { return data_.size(); }
  Eigen::VectorXd line() const;  // the same of the function t
  // Of an exponential, and d/d ln tau if wanted.
  void decay(double rate_1_s, Eigen::Ref<Eigen::VectorXd> value, Eigen::VectorXd* slope) const;

 private:
  Eigen::ArrayXd time_s_, weight_;
  Eigen::ArrayXd n1_, a_, b_;  // length of d; <d^3>/(2 m2), <d^4>/(6 m2)
  Eigen::ArrayXd n2_, n3_;
  Eigen::VectorXd data_;
};

// Scatter of a sample as seen within bins, about a parabola: a smooth curve adds nothing to it. 0
// if no bin holds enough samples.
double variance_within(const std::vector<LogBin>& bins);

}  // namespace viscard
