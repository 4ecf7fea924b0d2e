#pragma once

#include "models/material/material.h"

#include <filesystem>
#include <string>

namespace viscard {

// Material files, schema "viscard-material/1" (io/README.md lists the keys): JSON, SI, units in the
// names. E0_Pa, nu and terms are enough; k of a term defaults to its g (constant Poisson ratio).
struct MaterialFile {
  Material material;
  // The text the material was read from; keys viscard does not know are carried over from it when
  // the material is written again. Empty for a material made by viscard.
  std::string original_json;
};

// Throws std::runtime_error naming file and key: not JSON, wrong type, a newer schema, a key
// missing, or a value that models' validate() refuses (sum of g >= 1, nu above 0.5 ...).
MaterialFile read_material(const std::filesystem::path& path);
// The same from text; name stands for the file in messages.
MaterialFile material_from_json(const std::string& text, const std::string& name);

// Every double reads back exactly. Throws std::invalid_argument as validate() does.
std::string json_from_material(const MaterialFile& file);
std::string json_from_material(const Material& material);

}  // namespace viscard
