#include "models/pillar/large/large_static.h"

#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {
namespace {

constexpr int kMostCorrections = 40;           // of one load step
constexpr double kLeastAdvance = 1.0 / 128.0;  // along a correction
constexpr double kLeastStep = 1.0 / 1024.0;    // of the load
constexpr double kConverged = 1e-10;           // relative size of the correction that comes next
constexpr double kNearRounding = 1e-6;  // below, corrections that no longer fall are rounding
constexpr int kMostAugmentations = 12;
constexpr double kVolumeKept = 1e-11;  // largest relative change of volume at nu = 0.5

// Three digits, without a power of ten for large numbers.
std::string plain(double value) {
  return std::abs(value) < 999.5 ? text_of(value, 3) : text_from_number(value, 0);
}

class NewtonRun {
 public:
  NewtonRun(LargeBody& body, const LargeLoad& load) : body_(body), load_(load) {
    const Eigen::VectorXd traction = body.model().top_traction();
    area_m2_ = traction.sum();
    push_ = -traction;
    mean_ = traction / area_m2_;
    state_.u = Eigen::VectorXd::Zero(push_.size());
  }

  LargeState run() {
    double done = 0.0;
    for (double step = 1.0; done < 1.0;) {
      step = std::min(step, 1.0 - done);
      const LargeState before = state_;
      if (converge(done + step)) {
        done = 1.0 - done - step < 1e-12 ? 1.0 : done + step;
        ++state_.load_steps;
        look_at_stability(done);
        step *= 2.0;
        continue;
      }
      state_ = before;
      step *= 0.5;
      if (step < kLeastStep) refuse("Newton's method found no equilibrium of the pillar", done);
    }
    keep_volume();
    state_.top_displacement_m = mean_.dot(state_.u);
    state_.force_N = load_.follows_surface
                         ? along_axis(state_.pressure_Pa * body_.following_pressure(state_.u))
                         : -area_m2_ * state_.pressure_Pa;
    return state_;
  }

 private:
  struct Correction {
    Eigen::VectorXd u;
    double pressure_Pa = 0.0;
    double size() const { return u.norm(); }
  };

  // Total force along +z: the work on a motion of 1 m of all unknowns along z.
  double along_axis(const Eigen::VectorXd& force) const {
    double sum = 0.0;
    const DiscreteSystem& system = body_.model().system();
    std::vector<bool> is_counted(static_cast<std::size_t>(system.size()), false);
    for (int node = 0; node < system.section().node_count(); ++node) {
      const int dof = system.dofs().dof(1, node);
      if (dof < 0 || is_counted[static_cast<std::size_t>(dof)]) continue;
      is_counted[static_cast<std::size_t>(dof)] = true;
      sum += force[dof];
    }
    return sum;
  }

  // At a share of the load, from internal forces, by the matrix that is factored.
  Correction correction(double share, const LargeState& at, const Eigen::VectorXd& internal) const {
    Correction out;
    const Eigen::VectorXd& push = load_.follows_surface ? body_.following_pressure(at.u) : push_;
    if (!load_.displacement_m) {
      const double pressure_Pa = share * load_.pressure_Pa;
      out.u = factor_.solve(pressure_Pa * push - internal);
      out.pressure_Pa = pressure_Pa - at.pressure_Pa;
      return out;
    }
    out.u = factor_.solve(at.pressure_Pa * push - internal);
    const double lacks_m = share * *load_.displacement_m - mean_.dot(at.u + out.u);
    out.pressure_Pa = lacks_m / mean_.dot(per_Pa_);
    out.u += out.pressure_Pa * per_Pa_;
    return out;
  }

  bool factor(const SymmetricSparse& tangent) {
    try {
      factor_.factor(tangent);
    } catch (const std::runtime_error& error) {
      if (!is_refusal(error)) throw;
      return false;  // at a limit point
    }
    if (load_.displacement_m) per_Pa_ = factor_.solve(push_);
    return true;
  }

  // The state after the part `advance` of a correction.
  static LargeState advanced(LargeState state, const Correction& c, double advance) {
    state.u += advance * c.u;
    state.pressure_Pa += advance * c.pressure_Pa;
    return state;
  }

  // Newton's method at a share of the load from the present state; false if it does not converge.
  bool converge(double share) {
    state_.corrections.clear();
    LargeBody::Pressures pressures = body_.pressures_at(state_.u);
    for (int i = 0; i < kMostCorrections; ++i) {
      const LargeBody::Forces forces = body_.forces_with(state_.u, pressures);
      if (!forces.is_finite || !factor(forces.tangent)) return false;
      const Correction now = correction(share, state_, forces.internal);
      if (!now.u.allFinite()) return false;
      Correction next;
      double advance = 1.0;
      LargeState trial;
      for (;; advance *= 0.5) {
        if (advance < kLeastAdvance) return false;
        trial = advanced(state_, now, advance);
        const LargeBody::Forces there = body_.forces(trial.u, false);
        if (!there.is_finite) continue;
        next = correction(share, trial, there.internal);
        if (next.size() <= (1.0 - 0.25 * advance) * now.size()) break;
        if (now.size() <= kNearRounding * trial.u.norm()) break;
      }
      const double size = trial.u.norm();
      const LargeBody::Pressures after = body_.pressures_after(state_.u, now.u);
      for (std::size_t e = 0; e < pressures.size(); ++e) {
        pressures[e] += advance * (after[e] - pressures[e]);
      }
      state_ = trial;
      state_.corrections.push_back(now.size() / size);
      const bool stalls = now.size() <= kNearRounding * size && next.size() > 0.1 * now.size();
      if (advance < 1.0 || !(next.size() <= kConverged * size || stalls)) continue;
      state_ = advanced(state_, next, stalls ? 0.0 : 1.0);
      state_.rest = next.size() / size;
      return true;
    }
    return false;
  }

  // Beyond the largest load that a pillar bears the top yields against its force. Other directions
  // in which the energy falls are counted by the negative pivots (Sylvester); one of them is taken away by a top that
  // is held and would yield so.
  void look_at_stability(double done) {
    const bool yields_back = push_.dot(load_.displacement_m ? per_Pa_ : factor_.solve(push_)) < 0.0;
    if (yields_back && !load_.displacement_m) refuse("the pillar gives way", done);
    state_.falling_directions = factor_.negative_pivots() - (yields_back ? 1 : 0);
  }

  [[noreturn]] void refuse(const std::string& what, double done) const {
    const std::string reached =
        load_.displacement_m ? "a top displacement of " + plain(1e6 * mean_.dot(state_.u)) + " um"
                             : "a pressure of " + plain(done * load_.pressure_Pa) + " Pa";
    const std::string where = done < 1.0 ? "beyond " + plain(100.0 * done) + " % of the load, "
                                         : "under the whole load, ";
    const std::string instead =
        load_.displacement_m
            ? "Ask for a smaller displacement"
            : "Ask for a smaller load, press the top by a displacement instead of a pressure";
    throw std::runtime_error(
        what + " at large strain " + where + reached + " (" +
        plain(100.0 * std::abs(mean_.dot(state_.u)) / body_.model().geometry().length_m) +
        " % of the length). " + instead + ", or use a law that is stable over this strain");
  }

  // The pressures of an incompressible body.
  void keep_volume() {
    if (!body_.is_incompressible()) return;
    for (int i = 0; i < kMostAugmentations; ++i) {
      const double change = body_.augment(state_.u);
      if (change <= kVolumeKept) {
        state_.rest = std::max(state_.rest, change);
        return;
      }
      const LargeState before = state_;
      if (converge(1.0)) continue;
      state_ = before;
      break;
    }
    refuse("the pressures of the incompressible pillar do not converge", 1.0);
  }

  LargeBody& body_;
  const LargeLoad& load_;
  double area_m2_ = 0.0;
  Eigen::VectorXd push_;    // forces per Pa of a dead load
  Eigen::VectorXd mean_;    // mean displacement of the top
  Eigen::VectorXd per_Pa_;  // motion per Pa, by the present matrix
  StiffnessFactor factor_;
  LargeState state_;
};

}  // namespace

LargeState solve_large(LargeBody& body, const LargeLoad& load) {
  if (load.follows_surface && load.displacement_m) {
    throw std::invalid_argument("a pressure that follows the surface needs its size");
  }
  return NewtonRun(body, load).run();
}

}  // namespace viscard
