#pragma once

#include "models/scene/scene.h"

#include <optional>
#include <utility>

namespace viscard {

// One of the usual pillars of a scene on its part of the film, without electrodes, readout, load or wanted
// results; nothing for a layer.
std::optional<PillarScene> single_body(const Scene& scene);

// Distance of nearest axes; nothing for one pillar and for a layer.
std::optional<double> pitch_of(const Scene& scene);

// Area that belongs to one pillar of a square or hexagonal lattice. Nothing for other scenes.
std::optional<double> cell_area_m2(const Scene& scene);

// Pressure on the top of a pillar over the mean pressure on the sensor (models/sensor, eq. D1): the cell's
// area over the pillar's, of a row pitch over width, of one pillar 1. Nothing for a layer and for pillars
// without a lattice.
std::optional<double> pressure_share(const Scene& scene);

// Place in SpaceScene::pillars of the usual pillar nearest to the middle; nothing if there is none.
std::optional<std::size_t> middle_pillar(const SpaceScene& scene);

}  // namespace viscard
