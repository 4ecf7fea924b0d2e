#pragma once

#include "models/quantities/modulus_kind.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Files as instruments write them, recognised by their content and rewritten as a plain table:
// a header, one row per line, and a column `segment` if the file has several parts. Every line that
// is not a row becomes a comment, so that line numbers stay those of the file.
struct MakerTable {
  std::string maker;  // "JPK force curve", for the output
  std::string text;   // the plain table; empty if the file is one already
  // Quantities that the maker's headers do not name: as --column writes them.
  std::map<std::string, std::string> columns;
  // What the maker's machine measures where the headers do not tell.
  std::optional<ModulusKind> modulus_kind;
};

// Nothing for an ordinary table. name: the path of the file; the files of RepTate are recognised by
// their ending. Throws std::runtime_error that begins with "line N" if a part of the file differs
// from the maker's format.
std::optional<MakerTable> maker_table(std::string_view text, const std::string& name);

// Shear if the text speaks of a rheometer: its tables are of shear where their headers do not tell.
std::optional<ModulusKind> kind_of_instrument(std::string_view text);

// The maker of an ordinary table, by the names in its header; empty if the names belong to no
// maker.
std::string maker_of_header(std::string_view header_line);

}  // namespace viscard
