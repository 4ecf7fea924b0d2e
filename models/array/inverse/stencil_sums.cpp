#include "models/array/inverse/stencil_sums.h"

#include "models/maths/require.h"
#include "models/maths/wide_loops.h"

#include <cstddef>
#include <vector>

namespace viscard {
namespace {

// Pillars from near to far without a tail that adds up to little.
std::size_t pillars_that_count(const Eigen::MatrixXd& coefficients, Eigen::Index readings,
                               double left_out) {
  const Eigen::Index count = coefficients.cols() / readings;
  const Eigen::VectorXd all = coefficients.cwiseAbs().rowwise().sum();
  Eigen::VectorXd tail = Eigen::VectorXd::Zero(coefficients.rows());
  for (Eigen::Index p = count - 1; p > 0; --p) {
    tail += coefficients.middleCols(p * readings, readings).cwiseAbs().rowwise().sum();
    if ((tail.array() > left_out * all.array()).any()) return static_cast<std::size_t>(p + 1);
  }
  return 1;
}

// The sums of one pillar stay in registers: their numbers are known when this is compiled.
template <int kReadings, int kOutputs>
[[gnu::always_inline]] inline void sum_row(const StencilSums::Row& row, const double* values,
                                           double* sums) {
  Lanes sum[kOutputs] = {};
  const double* number = row.numbers;
  for (std::size_t p = 0; p < row.pillars; ++p) {
    const double* at = values + row.around[p] * (kReadings * kLanes);
    for (int o = 0; o < kOutputs; ++o) {
      for (int r = 0; r < kReadings; ++r) {
        sum[o] += *number++ * lanes_at(at + static_cast<std::size_t>(r) * kLanes)->lanes;
      }
    }
  }
  for (int o = 0; o < kOutputs; ++o)
    lanes_at(sums + static_cast<std::size_t>(o) * kLanes)->lanes = sum[o];
}

VISCARD_WIDE_LOOP void sum_one_to_one(const std::vector<StencilSums::Row>& rows,
                                      const double* values, double* sums) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].pillars > 0) sum_row<1, 1>(rows[i], values, sums + i * kLanes);
  }
}

VISCARD_WIDE_LOOP void sum_four_to_three(const std::vector<StencilSums::Row>& rows,
                                         const double* values, double* sums) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].pillars > 0) sum_row<4, 3>(rows[i], values, sums + i * 3 * kLanes);
  }
}

VISCARD_WIDE_LOOP void sum_four_to_four(const std::vector<StencilSums::Row>& rows,
                                        const double* values, double* sums) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].pillars > 0) sum_row<4, 4>(rows[i], values, sums + i * 4 * kLanes);
  }
}

}  // namespace

StencilSums::StencilSums(const PillarPatches& patches, Eigen::Index readings, Eigen::Index outputs,
                         const std::vector<Eigen::MatrixXd>& of_kind, double left_out)
    : readings_(readings), outputs_(outputs) {
  require((readings == 1 && outputs == 1) || (readings == 4 && (outputs == 3 || outputs == 4)),
          "an electrode has one reading, or four quarters");
  std::vector<std::size_t> first(of_kind.size()), pillars(of_kind.size(), 0);
  for (std::size_t k = 0; k < of_kind.size(); ++k) {
    if (of_kind[k].size() == 0) continue;
    first[k] = numbers_.size();
    pillars[k] = pillars_that_count(of_kind[k], readings, left_out);
    for (std::size_t p = 0; p < pillars[k]; ++p) {
      for (Eigen::Index o = 0; o < outputs; ++o) {
        for (Eigen::Index r = 0; r < readings; ++r) {
          numbers_.push_back(of_kind[k](o, static_cast<Eigen::Index>(p) * readings + r));
        }
      }
    }
  }
  for (std::size_t i = 0; i < patches.pillars(); ++i) {
    const std::size_t kind = patches.kind_of(i);
    rows_.push_back({numbers_.data() + first[kind], patches.around(i).data(), pillars[kind]});
  }
}

void StencilSums::apply(const double* values, double* sums) const {
  if (readings_ == 1) {
    sum_one_to_one(rows_, values, sums);
  } else if (outputs_ == 3) {
    sum_four_to_three(rows_, values, sums);
  } else {
    sum_four_to_four(rows_, values, sums);
  }
}

}  // namespace viscard
