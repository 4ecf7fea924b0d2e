#pragma once

#include "io/config/config_fields.h"
#include "models/array/plane/array_scene.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/readout.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace viscard {

// [analysis], without the load of a row. The scene gets the drive of its kind, and every part that this drive has. Throw
// SceneMistake for a key that the analysis does not use, naming the analyses that do.
void show_analysis(FieldVisitor& v, PillarScene& scene);
void show_analysis(FieldVisitor& v, ArrayScene& scene);

// The points of a history, from rest.
using Pairs = std::vector<std::pair<double, double>>;
Course history_of(const Pairs& pairs);
Pairs pairs_of(const Course& history);

// [readout]; 0: not given.
struct ReadoutKeys {
  std::optional<ReadoutKind> kind;
  double resistance_Ohm = 0.0, capacitance_F = 0.0, film_resistivity_Ohm_m = 0.0;
};
// `now` and its film: what is written.
std::shared_ptr<ReadoutKeys> show_readout(FieldVisitor& v, const std::optional<Readout>& now,
                                          const Medium* film);
// Of keys that have a kind, on this film. Throws SceneMistake for a resistivity that the film's material states, too.
Readout readout_of(const ReadoutKeys& keys, const Medium& film, const FilmLoss& loss);

}  // namespace viscard
