#pragma once

#include "models/material/material.h"
#include "models/material/ratio_model.h"
#include "models/quantities/plausible.h"

#include <filesystem>
#include <string>

namespace viscard {

// Material files, schema "viscard-material/1": JSON in SI, with the unit in each key; README.md of
// this room lists the keys. Only E0_Pa, nu and terms are required. k of a term defaults to its g
// (constant Poisson ratio).
struct MaterialFile {
  Material material;
  // The text that the material was read from. When the material is written again, keys that viscard
  // does not know are copied from it. Empty for a material made by viscard.
  std::string original_json;
};

// Throws std::runtime_error naming the file and the key if the file is not JSON, has a newer
// schema, a missing key, a value of the wrong type, or a value that validate(Material) refuses (sum
// of g >= 1, nu > 0.5 ...).
// A modulus, density or temperature that is not plausible is refused too, unless the flags of the
// file, or `judged`, accept it; then it has the flag plausible-off.
MaterialFile read_material(const std::filesystem::path& path,
                           Plausible judged = Plausible::kMeasured);
// The same from text; messages show name in place of the file.
MaterialFile material_from_json(const std::string& text, const std::string& name,
                                Plausible judged = Plausible::kMeasured);

// Every double reads back exactly. Throws std::invalid_argument as validate(Material) does.
std::string json_from_material(const MaterialFile& file);
std::string json_from_material(const Material& material);

// Files of joint fits over mixing ratios, schema "viscard-joint/1": JSON with the best form, the
// best law, the forms that were compared, and one material per measured ratio; keys.md
// (viscard help --schemas) lists the keys. Reading gives the same law, every double exactly.

// Throws std::invalid_argument if the material at a measured ratio is unphysical.
std::string json_from_ratio_fit(const RatioFit& fit);
// Its keys without the schema, as `viscard fit --joint --json` prints them.
void show_keys(ResultVisitor& v, const RatioFit& fit);

// Throws std::runtime_error naming the file and the key.
RatioFit read_ratio_fit(const std::filesystem::path& path, Plausible judged = Plausible::kMeasured);
// The same from text; messages show name in place of the file.
RatioFit ratio_fit_from_json(const std::string& text, const std::string& name,
                             Plausible judged = Plausible::kMeasured);

// True for a JSON file with the schema of a joint fit; false for any other or missing file.
bool looks_like_ratio_file(const std::filesystem::path& path);

}  // namespace viscard
