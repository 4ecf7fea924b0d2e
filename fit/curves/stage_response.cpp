#include "fit/curves/stage_response.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// One step with velocity linear from v0 to v1, and its derivative. Uses d phi_1/d ln tau = x (phi_1
// - phi_2), d phi_2/d ln tau = 2 phi_2 - phi_1.
BranchState stepped(const BranchState& start, double dt_s, double v0, double v1, double tau_s) {
  const BranchStep step(dt_s, tau_s);
  const double x = step.x, p1 = step.gain, p2 = phi2(x);
  BranchState end;
  end.value = step.decay * start.value + dt_s * (v0 * p1 + (v1 - v0) * p2);
  end.slope = step.decay * (start.slope + x * start.value) +
              dt_s * (v0 * x * (p1 - p2) + (v1 - v0) * (2.0 * p2 - p1));
  return end;
}

}  // namespace

StageResponse::StageResponse(const StageMove& move, double from_s) {
  const std::vector<double> knots = knots_s(move);
  const double start_s = std::max(from_s, knots.front());
  knot_s_.push_back(std::min(start_s, knots.back()));
  for (const double knot : knots) {
    if (knot > knot_s_.front()) knot_s_.push_back(knot);
  }
  for (const double knot : knot_s_) velocity_m_s_.push_back(velocity_m_s(move, knot));
  velocity_m_s_.back() = 0.0;
}

StageResponse::Branch StageResponse::branch(double tau_s) const {
  Branch branch{tau_s, {{}}};
  for (std::size_t i = 1; i < knot_s_.size(); ++i) {
    branch.at_knots.push_back(stepped(branch.at_knots.back(), knot_s_[i] - knot_s_[i - 1],
                                      velocity_m_s_[i - 1], velocity_m_s_[i], tau_s));
  }
  return branch;
}

BranchResponse StageResponse::at(const Branch& branch, double time_s) const {
  if (!(time_s > knot_s_.front())) return {};
  const auto next = std::upper_bound(knot_s_.begin(), knot_s_.end(), time_s);
  const auto i = static_cast<std::size_t>(next - knot_s_.begin()) - 1;
  double v0 = velocity_m_s_[i];
  double v1 = 0.0;
  if (i + 1 < knot_s_.size()) {
    const double share = (time_s - knot_s_[i]) / (knot_s_[i + 1] - knot_s_[i]);
    v1 = v0 + share * (velocity_m_s_[i + 1] - v0);
  } else {
    v0 = 0.0;
  }
  const BranchState end = stepped(branch.at_knots[i], time_s - knot_s_[i], v0, v1, branch.tau_s);
  return {end, v1 - end.value / branch.tau_s};
}

double time_at_position_s(const StageMove& move, double position) {
  // Position is monotonic during the move; bisect to the last bit.
  const std::vector<double> knots = knots_s(move);
  double low = knots.front();
  double high = knots.back();
  const double direction = move.to_m >= move.from_m ? 1.0 : -1.0;
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((position_m(move, middle) - position) * direction < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace viscard
