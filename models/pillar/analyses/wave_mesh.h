#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <vector>

namespace viscard {

// Largest elements of a scene over frequency. The shortest waves of the bar need one element per
// wave in each direction, so that a rising degree resolves them. With damping, waves decay as
// exp(-Im(k) s), k = omega sqrt(rho/M*), with the distance s from the loaded face and the side.
// Deeper than `skin_m` they are negligible at the tolerance, and elements may grow by their own
// length, so that the highest frequency costs no more than a lower one. Source: Christensen, Theory
// of Viscoelasticity (1982), ch. 2.
struct WaveMesh {
  double longest_m = 0.0;
  double skin_m = 0.0;  // 0: waves cross the pillar
  double cells = 0.0;   // about as many elements in the section
};

// Throws SceneMistake if the section would need more elements than can be solved, with their number
// and the highest possible frequency.
WaveMesh wave_mesh(const PillarScene& scene, const std::vector<double>& frequencies_Hz);

}  // namespace viscard
