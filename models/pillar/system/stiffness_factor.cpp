#include "models/pillar/system/stiffness_factor.h"

#include "models/maths/wide_loops.h"

#include <Eigen/Core>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <stdexcept>

namespace viscard {

// y += A x of the stored lower triangle, whose rows ascend in each column. Every stored entry serves two rows. Unknowns of
// an element stand next to each other, so that most entries come in blocks of eight consecutive rows.
VISCARD_WIDE_LOOP void add_product(int columns, const int* outer, const int* row,
                                   const double* value, const double* x, double* y) {
  constexpr int kBlock = 2 * static_cast<int>(kLanes);
  for (int column = 0; column < columns; ++column) {
    int at = outer[column];
    const int end = outer[column + 1];
    assert(at == end || row[at] >= column);
    const double own = x[column];
    Lanes sums[2] = {};
    double sum = 0.0, other_sum = 0.0;
    if (at < end && row[at] == column) sum = value[at++] * own;
    while (at < end) {
      const int first = row[at];
      if (at + kBlock <= end && row[at + kBlock - 1] == first + kBlock - 1) {
        const Lanes low = lanes_at(value + at)->lanes, high = lanes_at(value + at + kLanes)->lanes;
        sums[0] += low * lanes_at(x + first)->lanes;
        sums[1] += high * lanes_at(x + first + kLanes)->lanes;
        lanes_at(y + first)->lanes += low * own;
        lanes_at(y + first + kLanes)->lanes += high * own;
        at += kBlock;
        continue;
      }
      const int stop = std::min(at + 2 * kBlock, end);
      for (; at + 1 < stop; at += 2) {  // two partial sums let additions overlap
        sum += value[at] * x[row[at]];
        other_sum += value[at + 1] * x[row[at + 1]];
        y[row[at]] += value[at] * own;
        y[row[at + 1]] += value[at + 1] * own;
      }
      if (at < stop) {
        sum += value[at] * x[row[at]];
        y[row[at]] += value[at] * own;
        ++at;
      }
    }
    y[column] += sum + other_sum + total(sums[0] + sums[1]);
  }
}

Eigen::VectorXd times(const SymmetricSparse& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(matrix.rows());
  add_product(static_cast<int>(matrix.cols()), matrix.outerIndexPtr(), matrix.innerIndexPtr(),
              matrix.valuePtr(), x.data(), y.data());
  return y;
}

void StiffnessFactor::factor(const SymmetricSparse& matrix) {
  if (!is_analysed_) {
    ldlt_.analyse(matrix);
    is_analysed_ = true;
  }
  if (!ldlt_.factor(matrix)) {
    if (!Eigen::Map<const Eigen::ArrayXd>(matrix.valuePtr(), matrix.nonZeros()).allFinite()) {
      throw std::runtime_error(
          "a modulus or a length is so large or so small that the stiffness is beyond the numbers "
          "of the computer");
    }
    throw std::runtime_error(
        "the stiffness matrix is singular: a part of the body is not held, or a modulus is zero");
  }
}

Eigen::VectorXd StiffnessFactor::solve(const Eigen::VectorXd& right_side,
                                       Eigen::VectorXd* pressure_source) const {
  if (known_ != nullptr) return solve_nearby(right_side, pressure_source);
  if (!product_) return solve_once(right_side, pressure_source);
  constexpr int kCorrections = 8;
  constexpr double kEnough = 1e-9;  // of the solution; what is left is smaller
  Eigen::VectorXd source;
  Eigen::VectorXd u = solve_once(right_side, &source);
  double last = u.norm();
  for (int i = 0; i < kCorrections; ++i) {
    Eigen::VectorXd more;
    const Eigen::VectorXd change = solve_once(right_side - product_(u, source), &more);
    const double size = change.norm();
    if (!(size < 0.5 * last)) break;  // rounding of the products, or a matrix without meaning
    u += change;
    source += more;
    last = size;
    if (size <= kEnough * u.norm()) break;
  }
  if (pressure_source != nullptr) *pressure_source = source;
  return u;
}

Eigen::VectorXd StiffnessFactor::solve_once(const Eigen::VectorXd& right_side,
                                            Eigen::VectorXd* pressure_source) const {
  Eigen::VectorXd u = ldlt_.solve(right_side);
  if (penalty_.size() == 0 && pressure_source == nullptr) return u;
  Eigen::VectorXd added = Eigen::VectorXd::Zero(u.size());
  if (penalty_.size() > 0) constrain_solution(u, added);
  if (pressure_source != nullptr) *pressure_source = u + added;
  return u;
}

// Conjugate gradients for the pressures, whose force adds to the penalty force C u; u itself serves
// as the residual. Rounding is reached when the violation of the constraint stops falling. Products
// with C follow the vectors, so that each iteration takes one.
void StiffnessFactor::constrain_solution(Eigen::VectorXd& u, Eigen::VectorXd& added) const {
  Eigen::VectorXd C_u = times(penalty_, u);
  double violation = u.dot(C_u);
  Eigen::VectorXd direction = u;
  Eigen::VectorXd C_direction = C_u;
  constexpr int kIterations = 40;  // each gains a factor of ten or more; see kPenaltyOverShear
  for (int i = 0; i < kIterations && violation > 0.0; ++i) {
    const Eigen::VectorXd response = ldlt_.solve(C_direction);
    const double step = violation / C_direction.dot(response);
    const Eigen::VectorXd next = u - step * response;
    C_u = times(penalty_, next);
    const double remaining = next.dot(C_u);
    if (!(remaining < 0.5 * violation)) break;
    u = next;
    added += step * direction;
    const double share = remaining / violation;
    direction = u + share * direction;
    C_direction = C_u + share * C_direction;
    violation = remaining;
  }
}

int StiffnessFactor::negative_pivots() const {
  return static_cast<int>((ldlt_.pivots().array() < 0.0).count());
}

}  // namespace viscard
