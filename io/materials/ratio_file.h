#pragma once

#include "models/material/ratio_model.h"

#include <filesystem>
#include <string>

namespace viscard {

// Files of joint fits over mixing ratios, schema "viscard-joint/1" (io/README.md lists the keys):
// JSON with the best form, the best law, what was compared, and one material per measured ratio.
// Reading gives back the same law to the last digit.

// Throws std::invalid_argument when a material at a measured ratio is unphysical.
std::string json_from_ratio_fit(const RatioFit& fit);

// Throws std::runtime_error naming file and key.
RatioFit ratio_fit_from_json(const std::string& text, const std::string& name);
RatioFit read_ratio_fit(const std::filesystem::path& path);

// True for a JSON file that says it is a joint fit; false for anything else, or no file.
bool looks_like_ratio_file(const std::filesystem::path& path);

}  // namespace viscard
