#pragma once

#include "models/material/material.h"

#include <nlohmann/json.hpp>

#include <string>

namespace viscard {

// Parts of material_file.cpp: between a Material and its JSON. Keys keep the order in which a
// person would read them.
using Json = nlohmann::ordered_json;

// Throws std::runtime_error naming the file (name), line and column, or a key given twice.
Json parse_json(const std::string& text, const std::string& name);

// Throws std::runtime_error naming the file and the key.
Material material_from(const Json& json, const std::string& name);

Json json_from(const Material& material);

// Adds to `fresh` what stands in `original` under keys that viscard does not know.
void carry_unknown_keys(const Json& original, Json& fresh);

}  // namespace viscard
