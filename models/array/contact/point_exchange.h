#pragma once

#include <Eigen/Core>

namespace viscard {

using PointMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Which of the points that pull or overlap change sides: all, as long as their number has fallen within
// the last sets, otherwise the last one alone. All at once may go round in a circle; one by one ends.
// Judice & Pires, Computers & Operations Research 21 (1994) 587 (block pivoting); Murty's rule.
class PointExchange {
 public:
  PointMask next(const PointMask& wrong) {
    const Eigen::Index count = wrong.count();
    if (fewest_ == 0 || count < fewest_) {
      fewest_ = count;
      left_ = kChances;
      return wrong;
    }
    if (left_-- > 0) return wrong;
    PointMask last = PointMask::Constant(wrong.rows(), wrong.cols(), false);
    for (Eigen::Index i = wrong.size() - 1; i >= 0; --i) {
      if (!wrong.data()[i]) continue;
      last.data()[i] = true;
      break;
    }
    return last;
  }

 private:
  static constexpr int kChances = 10;
  Eigen::Index fewest_ = 0;
  int left_ = kChances;
};

}  // namespace viscard
