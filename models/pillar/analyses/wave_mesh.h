#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <vector>

namespace viscard {

// How long the elements of a scene over frequency may be. Waves of a bar, of the length L at the
// frequency where they are shortest, need one element each way per wave, so that a rising degree
// resolves them. In a material with damping they die out as exp(-Im(k) s), k = omega sqrt(rho/M*),
// s from the loaded face and the side: deeper in than `skin_m` nothing is left of them that the
// tolerance could see, and elements may grow by their own length, so that the highest frequency
// costs no more than a lower one. Source: Christensen, Theory of Viscoelasticity (1982), ch. 2.
struct WaveMesh {
  double longest_m = 0.0;
  double skin_m = 0.0;  // 0: waves cross the pillar
  double cells = 0.0;   // about as many elements in the section
};

// Throws SceneMistake if the section would need more elements than can be solved, saying how many
// and how much memory that would be, and up to which frequency the pillar can be answered.
WaveMesh wave_mesh(const PillarScene& scene, const std::vector<double>& frequencies_Hz);

}  // namespace viscard
