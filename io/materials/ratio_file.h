#pragma once

#include "models/material/ratio_model.h"

#include <filesystem>
#include <string>

namespace viscard {

// Files of joint fits over mixing ratios, schema "viscard-joint/1": JSON with the best form, the
// best law, the forms that were compared, and one material per measured ratio; README.md of this
// room lists the keys. Reading gives the same law, every double exactly.

// Throws std::invalid_argument if the material at a measured ratio is unphysical.
std::string json_from_ratio_fit(const RatioFit& fit);

// Throws std::runtime_error naming the file and the key.
RatioFit read_ratio_fit(const std::filesystem::path& path);

// True for a JSON file with the schema of a joint fit; false for any other file, or if there is
// none.
bool looks_like_ratio_file(const std::filesystem::path& path);

}  // namespace viscard
