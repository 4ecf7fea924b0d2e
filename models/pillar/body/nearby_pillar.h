#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/system/stiffness_factor.h"

#include <complex>
#include <memory>
#include <utility>
#include <vector>

namespace viscard {

// What a solved pillar is for.
enum class NearbyRole {
  kAnswers,   // its family of motion is that of the answer
  kPrestress  // its stress stiffens or softens the others
};

// A mode exp(s t) of a body that relaxes.
struct DampedShape {
  std::complex<double> s;  // 1/s
  Eigen::VectorXcd shape;  // unknowns of the model
};

// Motions in time or over frequency, restricted to a span that holds solutions and dual solutions.
struct ReducedMotion {
  Eigen::MatrixXd basis;  // unknowns of the model x vectors
  int level = 0;          // of the time steps (load_history.h)
};

// A pillar that is solved, so that others which differ from it by little are answered to first order in
// the difference without a factorisation of their own. Their meshes have the same elements, whose nodes
// move with the lengths.
class NearbyPillar {
 public:
  NearbyPillar(const PillarGeometry& geometry, const Discretisation& discretisation,
               const PillarMedia& media, const ModelOptions& options,
               NearbyRole role = NearbyRole::kAnswers)
      : role_(role), model_(geometry, discretisation, media, options) {}

  // Factors the stiffness and solves for a force on the top and for a charge on the electrode, as far as
  // the family of motion has them (NearbySolutions).
  void solve();
  // Finds the lowest modes, whose Rayleigh quotients with other matrices are stationary.
  void find_modes(int count);
  // The same under a stress, whose stiffness is given.
  void find_modes(int count, const SymmetricSparse& stress);
  // Finds the shape in which this lateral model buckles under the stress of the axial one.
  void find_buckling(const PillarModel& axial);
  // Keeps the modes of a material that relaxes, which the caller has found.
  void keep_damped(std::vector<DampedShape> shapes) { damped_ = std::move(shapes); }
  // Keeps a basis for motions in time or over frequency, likewise.
  void keep_reduced(ReducedMotion reduced) { reduced_ = std::move(reduced); }

  NearbyRole role() const { return role_; }
  const PillarModel& model() const { return model_; }
  const NearbySolutions& solutions() const { return solutions_; }
  const std::vector<PillarMode>& modes() const { return modes_; }
  const Eigen::VectorXd& buckled() const { return buckled_; }
  const std::vector<DampedShape>& damped() const { return damped_; }
  const ReducedMotion& reduced() const { return reduced_; }

 private:
  NearbyRole role_;
  PillarModel model_;
  NearbySolutions solutions_;
  std::vector<PillarMode> modes_;
  Eigen::VectorXd buckled_;
  std::vector<DampedShape> damped_;
  ReducedMotion reduced_;
};

// The pillars that an analysis needs, each in a family of motion of its own.
using NearbyPillars = std::vector<std::unique_ptr<NearbyPillar>>;

// The modes of a model near one with these: f^2 = (x K x)/(x M x)/(2 pi)^2 with their shapes x, exact to
// first order. Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 1 and 4.
std::vector<PillarMode> modes_nearby(const PillarModel& model, std::vector<PillarMode> modes,
                                     int count);

// The pressure at which a lateral model near one that buckles in this shape buckles under the stress of
// the axial model, -(x K x)/(x K_sigma x) (eq. 21), likewise.
double buckling_pressure_nearby_Pa(const PillarModel& axial, const PillarModel& lateral,
                                   const Eigen::VectorXd& shape);

}  // namespace viscard
