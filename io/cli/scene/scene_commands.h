#pragma once

#include "io/cli/words/streams.h"
#include "io/options/option.h"
#include "models/scene/scene.h"

#include <optional>

namespace viscard {

// The commands for scenes and pillars.

// viscard validate: runs the pillar in relaxation and creep with a material and compares with the
// exact answers (models/pillar/validate_material.h). Fails above the largest error allowed.
int run_validate(const Words& words, Streams& streams);
// viscard scene check: reads a scene, reports contradictions, and draws the geometry.
int run_scene(const Words& words, Streams& streams);
// viscard plan: which effects a scene is solved with, and why; nothing is solved.
int run_plan(const Words& words, Streams& streams);
// viscard simulate: solves a scene file (io/scenes/scene_file.h) with error estimates.
int run_simulate(const Words& words, Streams& streams);
// viscard sweep: a scene at many values of its parameters, kept in an SQLite file.
int run_sweep_command(const Words& words, Streams& streams);
// viscard design: closed-form limits of a pillar sensor, the longest admissible pillar, and
// pictures of the admissible region.
int run_design(const Words& words, Streams& streams);
// viscard cost: error of a scene against time and memory, over discretisations and effects.
int run_cost(const Words& words, Streams& streams);

// --tol: the relative error allowed, instead of the scene's.
void add_tolerance_option(OptionList& options, std::optional<double>& tolerance);
// Sets the scene's tolerance if --tol is given. Throws UsageError outside the limits of its kind.
void apply_tolerance(const std::optional<double>& tolerance, Scene& scene);

}  // namespace viscard
