#pragma once

#include "models/material/material.h"
#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// A solid that relaxes in every deformation at least as much as this one does in any deformation:
// each term has the larger of its shear and bulk parts. Relative to E_0.
PronySeries largest_relaxation(const Material& material);

// First axial frequency of the pillar as a rod that is clamped at one end, Hz (eq. E7).
double first_rod_frequency_Hz(const PillarScene& scene);

}  // namespace viscard
