#pragma once

#include "io/config/config_fields.h"
#include "io/flow/design/requirements.h"
#include "io/flow/design/scene_solver.h"
#include "models/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// One kind of requirement: its key in [require], and the quantity of a scene that it limits.
struct RequirementKind {
  const char* key;
  const char* unit;  // SI
  bool is_upper;     // the quantity must be at most the limit; false: at least
  const char* what;  // the quantity in words
  double Requirements::*limit;
  // Solves what the quantity needs. Throws what `solve` throws.
  RequiredValue (*compute)(const Scene& scene, const Requirements& requirements,
                           const SceneSolver& solve);
};
// All kinds, in the order in which they are judged.
const std::vector<RequirementKind>& requirement_kinds();

// Shows the fields of [require].
void show_requirements(FieldVisitor& v, Requirements& requirements);
// Reads a file with a table [require]. Throws std::runtime_error naming file, line, key and what is
// expected, or that nothing is required.
Requirements read_requirements(const std::filesystem::path& path);
// The same from text; messages show `name`.
Requirements requirements_from_toml(const std::string& text, const std::string& name);
// Throws std::invalid_argument for conditions that are wrong, or if nothing is required.
void validate(const Requirements& requirements);

}  // namespace viscard
