#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/system/stiffness_factor.h"

#include <memory>
#include <vector>

namespace viscard {

// A pillar that is solved, so that others which differ from it by little are answered to first order in
// the difference without a factorisation of their own. Their meshes have the same elements, whose nodes
// move with the lengths.
class NearbyPillar {
 public:
  NearbyPillar(const PillarGeometry& geometry, const Discretisation& discretisation,
               const PillarMedia& media, const ModelOptions& options)
      : model_(geometry, discretisation, media, options) {}

  // Factors the stiffness and solves for a force on the top and for a charge on the electrode, as far as
  // the family of motion has them (NearbySolutions).
  void solve();
  // Finds the lowest modes, whose Rayleigh quotients with other matrices are stationary.
  void find_modes(int count);

  const PillarModel& model() const { return model_; }
  const NearbySolutions& solutions() const { return solutions_; }
  const std::vector<PillarMode>& modes() const { return modes_; }

 private:
  PillarModel model_;
  NearbySolutions solutions_;
  std::vector<PillarMode> modes_;
};

// The pillars that an analysis needs, each in a family of motion of its own.
using NearbyPillars = std::vector<std::unique_ptr<NearbyPillar>>;

// The modes of a model near one with these: f^2 = (x K x)/(x M x)/(2 pi)^2 with their shapes x, exact to
// first order. Source: Parlett, The Symmetric Eigenvalue Problem (1998), ch. 1 and 4.
std::vector<PillarMode> modes_nearby(const PillarModel& model, std::vector<PillarMode> modes,
                                     int count);

}  // namespace viscard
