#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/scene/pillar_scene.h"

#include <random>

namespace viscard::test {

// A scene of one pillar drawn at random over wide ranges: all analyses that rest on a plane
// section, with and without film and electrode, stiffness contrasts of 10 to 1e5 (modes also 0.3 to
// 10, and materials that damp them), Poisson ratios to 0.4995, pillars from squat to slender (from
// 1.5 diameters for buckling), tolerances from 1e-4 to 1e-1. Never above its buckling load.
struct Ranges {
  double least_tolerance = 1e-4;
  double largest_aspect = 8.0;  // L/d
  double widest_film = 4.0;     // in radii
  double softest_film = 0.3;    // over the pillar's modulus
};
PillarScene random_scene(std::mt19937_64& random, const Ranges& ranges = {});

// The same scene with every effect on, for a reference on a fine mesh.
PillarScene with_everything_on(const PillarScene& scene);

// Everything on, on one fine mesh; errors are not estimated.
SceneAnswer fine_answer(const PillarScene& scene, int degree, int layers);

}  // namespace viscard::test
