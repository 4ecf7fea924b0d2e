#include "fit/curves/bin_arrays.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Norms of the second and third orthogonal polynomial of a bin and their products with its data.
// Bins of two samples have no second polynomial, bins of three no third.
struct BinBends {
  double n2 = 0.0, n3 = 0.0;
  double data2 = 0.0, data3 = 0.0;
};

BinBends bends_of(const LogBin& bin) {
  constexpr double kNoMore = 1e-9;  // relative to the mean square of the power itself
  BinBends bends;
  const double skew = bin.m3 / bin.m2;
  const double square2 = bin.m4 - bin.m2 * bin.m2 - bin.m3 * skew;
  if (!(square2 > kNoMore * bin.m4)) return bends;
  bends.n2 = std::sqrt(square2);
  const double product2 = bin.c2 - bin.c1 * skew;
  bends.data2 = product2 / bends.n2;
  const double q = bin.m5 - bin.m2 * bin.m3 - bin.m4 * skew;
  const double square3 = bin.m6 - bin.m3 * bin.m3 - bin.m4 * bin.m4 / bin.m2 - q * q / square2;
  if (!(square3 > kNoMore * bin.m6)) return bends;
  bends.n3 = std::sqrt(square3);
  bends.data3 = (bin.c3 - bin.c1 * bin.m4 / bin.m2 - product2 * q / square2) / bends.n3;
  return bends;
}

}  // namespace

BinArrays::BinArrays(const std::vector<LogBin>& bins) {
  const auto count = static_cast<Index>(bins.size());
  for (Eigen::ArrayXd* array : {&time_s, &weight, &half_m2, &sixth_m3, &part_m4}) {
    array->resize(count);
  }
  for (Index i = 0; i < count; ++i) {
    const LogBin& bin = bins[static_cast<std::size_t>(i)];
    time_s[i] = bin.time_s;
    weight[i] = std::sqrt(bin.count) / bin.sigma;
    half_m2[i] = bin.m2 / 2.0;
    sixth_m3[i] = bin.m3 / 6.0;
    part_m4[i] = bin.m4 / 24.0;
  }
}

DecayPlaces BinArrays::places(bool has_averages) const {
  DecayPlaces at;
  at.count = static_cast<std::size_t>(time_s.size());
  at.time_s = time_s.data();
  at.weight = weight.data();
  if (!has_averages) return at;
  at.half_m2 = half_m2.data();
  at.sixth_m3 = sixth_m3.data();
  at.part_m4 = part_m4.data();
  return at;
}

BinShapes::BinShapes(const std::vector<LogBin>& bins) {
  const auto n =
      std::count_if(bins.begin(), bins.end(), [](const LogBin& bin) { return bin.m2 > 0.0; });
  for (Eigen::ArrayXd* array : {&time_s_, &weight_, &n1_, &a_, &b_, &n2_, &n3_}) array->resize(n);
  data_.resize(3 * n);
  Index i = 0;
  for (const LogBin& bin : bins) {
    if (!(bin.m2 > 0.0)) continue;
    const BinBends bends = bends_of(bin);
    time_s_[i] = bin.time_s;
    weight_[i] = std::sqrt(bin.count) / bin.sigma;
    n1_[i] = std::sqrt(bin.m2);
    a_[i] = 0.5 * bin.m3 / bin.m2;
    b_[i] = bin.m4 / (6.0 * bin.m2);
    n2_[i] = bends.n2;
    n3_[i] = bends.n3;
    data_[i] = weight_[i] * bin.c1 / n1_[i];
    data_[n + i] = weight_[i] * bends.data2;
    data_[2 * n + i] = weight_[i] * bends.data3;
    ++i;
  }
}

Eigen::VectorXd BinShapes::line() const {
  Eigen::VectorXd line = Eigen::VectorXd::Zero(n_rows());
  line.head(weight_.size()) = (weight_ * n1_).matrix();
  return line;
}

void BinShapes::decay(double rate_1_s, Eigen::Ref<Eigen::VectorXd> value,
                      Eigen::VectorXd* slope) const {
  const Index n = time_s_.size();
  const double u = rate_1_s;
  Eigen::ArrayXd e(n);
  DecayPlaces at;
  at.time_s = time_s_.data();
  at.weight = weight_.data();
  at.count = static_cast<std::size_t>(n);
  decay_column(at, u, e.data(), nullptr);
  value.head(n) = (e * n1_ * u * (u * (a_ - u * b_) - 1.0)).matrix();
  value.segment(n, n) = (e * n2_ * (0.5 * u * u)).matrix();
  value.tail(n) = (e * n3_ * (-u * u * u / 6.0)).matrix();
  if (slope == nullptr) return;
  // d/d ln tau = -u d/du: the exponential contributes a factor x, each part minus its power of u.
  const auto x = u * time_s_;
  slope->resize(3 * n);
  slope->head(n) =
      (x * value.head(n).array() + e * n1_ * u * (1.0 - u * (2.0 * a_ - 3.0 * u * b_))).matrix();
  slope->segment(n, n) = ((x - 2.0) * value.segment(n, n).array()).matrix();
  slope->tail(n) = ((x - 3.0) * value.tail(n).array()).matrix();
}

double variance_within(const std::vector<LogBin>& bins) {
  double square = 0.0, freedom = 0.0;
  for (const LogBin& bin : bins) {
    if (bin.count < 6.0 || !(bin.m2 > 0.0)) continue;
    const double bend = bends_of(bin).data2;
    square += bin.count * (bin.value_m2 - bin.c1 * bin.c1 / bin.m2 - bend * bend) /
              (bin.sigma * bin.sigma);
    freedom += bin.count - 3.0;
  }
  return freedom > 0.0 ? std::max(0.0, square / freedom) : 0.0;
}

}  // namespace viscard
