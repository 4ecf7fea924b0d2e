#pragma once

#include "models/scene/common/scene_answer.h"

#include <nlohmann/json_fwd.hpp>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// How the answer of any scene is printed and stored.

nlohmann::json json_from_answer(const SceneAnswer& answer, double wall_s);
// A list of {name, on, estimate, number, value, forced, counted, reason}; estimate is null where
// the effect has nothing to act on.
nlohmann::json json_from_effects(const std::vector<SceneEffect>& effects);
void print_answer(const SceneAnswer& answer, double wall_s, std::ostream& out);

// Drops the results that are not among the wanted ones, if any are; a wanted name also stands for
// the same with a pillar's number behind it, and the name of a curve for what is read off it.
void keep_wanted(const std::vector<std::string>& wanted, SceneAnswer& answer);

// Name and SVG each.
void write_pictures(const std::vector<std::pair<std::string, std::string>>& pictures,
                    const std::string& folder, bool overwrite);

// results.json, results.csv and modes.csv, a CSV table and a picture of every curve. Throws
// std::runtime_error if a file exists and may not be overwritten.
void write_files(const SceneAnswer& answer, const nlohmann::json& object, const std::string& folder,
                 const std::string& command, bool overwrite);

}  // namespace viscard
