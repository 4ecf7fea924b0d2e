#pragma once

#include <string>

namespace viscard {

// Returns the line (from 1) of a key such as "geometry.film.radius" in a TOML text, or that of the
// innermost table around it if the key is missing, or 0 if the text is not TOML. An entry of a list
// is given by its number from 1: "analysis.history.3".
int line_of_key(const std::string& toml, const std::string& dotted_key);

}  // namespace viscard
