#include "models/array/inverse/patch_estimate.h"

#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kNextTo = 1.3;  // pitches: square and hexagonal lattices link their nearest only
constexpr double kLeastSlope = 1e-9;  // of the size of a load, for pillars without neighbours

Eigen::MatrixXd penalty_matrix(const OffsetKernels& kernels, std::span<const std::uint32_t> around,
                               Penalty penalty) {
  const ReadArray& array = kernels.array();
  const Eigen::Index loads = array.loads;
  const auto count = static_cast<Eigen::Index>(around.size());
  if (penalty == Penalty::kSize) return Eigen::MatrixXd::Identity(count * loads, count * loads);
  Eigen::MatrixXd L = kLeastSlope * Eigen::MatrixXd::Identity(count * loads, count * loads);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      const SourcePoint& one = array.pillars[around[static_cast<std::size_t>(a)]];
      const SourcePoint& other = array.pillars[around[static_cast<std::size_t>(b)]];
      if (std::hypot(one.x_m - other.x_m, one.y_m - other.y_m) > kNextTo * kernels.pitch_m()) {
        continue;
      }
      for (Eigen::Index l = 0; l < loads; ++l) {
        const Eigen::Index i = a * loads + l, j = b * loads + l;
        L(i, i) += 1.0;
        L(j, j) += 1.0;
        L(i, j) -= 1.0;
        L(j, i) -= 1.0;
      }
    }
  }
  return L;
}

}  // namespace

PatchEquations::PatchEquations(OffsetKernels& kernels, std::span<const std::uint32_t> around,
                               Penalty penalty)
    : readings_(kernels.array().readings),
      loads_(kernels.array().loads),
      scale_V_Pa_(std::sqrt(kernels.scale_V2_Pa2())),
      penalty_(penalty_matrix(kernels, around, penalty)) {
  const ReadArray& array = kernels.array();
  const auto count = static_cast<Eigen::Index>(around.size());
  const Eigen::Index disturbing = kernels.between(around[0], around[0])->cols() - loads_;
  reads_ = Eigen::MatrixXd::Zero(count * readings_, count * loads_);
  disturbs_ = Eigen::MatrixXd::Zero(count * readings_, count * disturbing);
  for (Eigen::Index to = 0; to < count; ++to) {
    const std::size_t reader = around[static_cast<std::size_t>(to)];
    for (Eigen::Index from = 0; from < count; ++from) {
      const Eigen::MatrixXd* kernel =
          kernels.between(around[static_cast<std::size_t>(from)], reader);
      if (kernel == nullptr) continue;
      for (Eigen::Index r = 0; r < readings_; ++r) {
        if (!array.does_work(reader, r)) continue;
        const Eigen::Index row = to * readings_ + r;
        reads_.row(row).segment(from * loads_, loads_) = kernel->row(r).head(loads_) / scale_V_Pa_;
        disturbs_.row(row).segment(from * disturbing, disturbing) =
            kernel->row(r).tail(disturbing) / scale_V_Pa_;
      }
    }
  }
  gram_ = gram_of(reads_);
}

Eigen::MatrixXd PatchEquations::solved(double weight, const Eigen::MatrixXd& right) const {
  const Cholesky factor(gram_ + weight * penalty_);
  if (!factor.is_definite()) {
    throw std::runtime_error(
        "the voltages that are read do not determine the loads; let the data choose the weight of "
        "the regularisation, or state a larger one");
  }
  return factor.solve(right);
}

PillarEstimate PatchEquations::estimate(double weight) const {
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(gram_.rows(), loads_);
  const Eigen::MatrixXd Z = solved(weight, unit);
  const Eigen::MatrixXd gain = (reads_ * Z).transpose();
  const Eigen::MatrixXd resolution = Z.transpose() * gram_;
  PillarEstimate one;
  one.gain_Pa_V = gain / scale_V_Pa_;
  one.noise_Pa2_V2 = one.gain_Pa_V.rowwise().squaredNorm();
  one.bias_Pa2_V2 =
      weight / (scale_V_Pa_ * scale_V_Pa_) * (Z.transpose() * penalty_ * Z).diagonal();
  one.disturbed_Pa2_Pa2 = (gain * disturbs_).rowwise().squaredNorm();
  const Eigen::Index count = gram_.rows() / loads_;
  one.share.resize(loads_, count);
  for (Eigen::Index l = 0; l < loads_; ++l) {
    for (Eigen::Index p = 0; p < count; ++p) one.share(l, p) = resolution(l, p * loads_ + l);
  }
  return one;
}

Eigen::MatrixXd PatchEquations::explained(double weight) const {
  return (reads_ * solved(weight, reads_.topRows(readings_).transpose())).transpose();
}

double PatchEquations::condition() const {
  const Eigen::VectorXd values = singular_values(reads_);
  const double least = values[values.size() - 1];
  return least > 0.0 ? values[0] / least : HUGE_VAL;
}

}  // namespace viscard
