#pragma once

#include <string>

namespace viscard {

// Line (from 1) of a key such as "geometry.film.radius" in a TOML text; of the nearest table around
// it if the key itself is not there; 0 if the text is no TOML. Entries of a list have their number,
// from 1: "analysis.history.3".
int line_of_key(const std::string& toml, const std::string& dotted_key);

}  // namespace viscard
