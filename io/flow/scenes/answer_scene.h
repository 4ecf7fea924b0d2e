#pragma once

#include "io/scenes/scene_file.h"
#include "models/answer/scene_answer.h"

#include <functional>
#include <string>

namespace viscard {

// Answers what stands in a scene file, one scene or a sweep, and keeps the results that it wants. path:
// of the file, for messages. progress: called with the fraction done and the point of a sweep; may be
// empty. Throws std::runtime_error naming the file, and the line if the scene contradicts itself.
SceneAnswer answer_scene(const SceneFile& file, const std::string& path,
                         const std::function<void(double, const std::string&)>& progress);

// What the file itself calls for beside the numbers: values that nothing has, words of before.
void add_notes_of_file(const SceneFile& file, SceneAnswer& answer);

// Files of the pillars' materials that were edited since they were written; "": none.
std::string note_of_edited(const Scene& scene);

// simulate() of one scene with messages that name the file.
SceneAnswer simulate_file(const Scene& scene, const std::string& path);

// Sets the relative error allowed. Throws std::invalid_argument outside the limits of this kind of scene.
void set_tolerance(double tolerance, Scene& scene);

}  // namespace viscard
