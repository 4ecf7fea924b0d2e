#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <filesystem>
#include <random>
#include <string>

namespace viscard::test {

// A random scene (random_scenes.h) that is made harder: films as wide as the pillar or little wider,
// electrodes of all kinds (wider than the pillar, over the whole film, edges near the rim of the
// bond, sampled faces, quadrants under a sideways force), films stretched in one direction, loads up
// to 97 % of the (long-term) buckling load, materials of twelve terms over twelve decades,
// oscillations. Never above the buckling load.
PillarScene wide_scene(std::mt19937_64& random);

// Writes the scene as NAME.toml with its materials beside it, so that viscard simulate answers it.
// Histories, frequencies and loads of the analyses that wide_scene() draws are written.
void write_scene(const PillarScene& scene, const std::filesystem::path& folder,
                 const std::string& name);

}  // namespace viscard::test
