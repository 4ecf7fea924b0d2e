#include "io/tables/modulus_of_columns.h"

#include "io/tables/column_match.h"
#include "io/tables/column_names.h"
#include "io/tables/header_words.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

// Parts of words, in lower case.
struct KindWords {
  ModulusKind kind;
  std::vector<std::string_view> parts;
};
const std::vector<KindWords>& kind_words() {
  static const std::vector<KindWords> kWords{
      {ModulusKind::kPlaneStrain, {"plane strain", "ebene dehnung", "平面应变"}},
      {ModulusKind::kIndentation, {"reduced modulus", "indentation modulus", "reduzierter modul"}},
      {ModulusKind::kBulk, {"bulk", "volumetric", "kompressionsmodul", "体积"}},
      {ModulusKind::kShear,
       {"shear",    "scher",   "schub",  "torsion", "cisaillement", "剪切",    "taglio",
        "cortante", "cizalla", "сдвиг",  "せん断",  "gamma",        "γ",       "τ",
        " tau ",    "twist",   "viscos", "η",       " eta ",        "вязкост", "粘度"}},
      {ModulusKind::kTension,
       {"young",     "tensile",  "engineering", "nominal",    "technisch", "nenn",
        " tension ", "zug",      "traction",    "elongation", "flexur",    "bending",
        "compressi", "uniaxial", "axial",       "拉伸",       "压缩",      "trazione",
        "tracción",  "traccion", "растяж",      "сжат",       "юнг",       "引張",
        "圧縮",      "杨氏",     "ヤング",      "epsilon",    "ε"}}};
  return kWords;
}

// The letter that stands alone at the begin of a name: "G" of "G'", "|G*|", "g_relax", "G(t)", "Gp".
char leading_letter(const std::string& name) {
  const std::size_t at = name.find_first_not_of("| ");
  if (at == std::string::npos) return '\0';
  std::size_t next = at + 1;
  for (const std::string_view prime : {"pp", "p"}) {  // Gp, Gpp
    const bool ends = name.size() == next + prime.size() ||
                      (name.size() > next + prime.size() && name[next + prime.size()] == '_');
    if (name.compare(next, prime.size(), prime) == 0 && ends) next += prime.size();
  }
  const bool is_letter_next = next < name.size() && ((name[next] >= 'a' && name[next] <= 'z') ||
                                                     (name[next] >= 'A' && name[next] <= 'Z'));
  if (is_letter_next) return '\0';
  const char c = name[at];
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_own_name(const CsvColumn& column, const ColumnKind& quantity) {
  // "strain" is the word of everybody, modulus_Pa and modulus_MPa are not.
  const bool has_unit = std::string(quantity.name) != quantity.base;
  if (!has_unit || !column.derived_from.empty()) return false;
  const auto match = match_header(column, quantity);
  const bool has_unit_in_name = column.header.rfind(std::string(quantity.base) + "_", 0) == 0;
  return match && (match->rank == 3 || (match->rank == 2 && has_unit_in_name));
}

bool tells_kind(const std::string& name) {
  constexpr const char* kNames[] = {"modulus_Pa",      "stress_Pa",          "strain",
                                    "compliance_1_Pa", "storage_modulus_Pa", "loss_modulus_Pa"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

std::optional<ModulusKind> modulus_kind_of_header(const CsvColumn& column) {
  if (column.modulus_kind) return column.modulus_kind;
  std::string words;
  for (const std::string& word : words_of_header(column.name)) words += " " + word;
  words += " ";
  for (const KindWords& of : kind_words()) {
    for (const std::string_view part : of.parts) {
      if (words.find(part) != std::string::npos) return of.kind;
    }
  }
  switch (leading_letter(column.name)) {
    case 'G':
    case 'J':
      return ModulusKind::kShear;
    case 'E':
    case 'D':
      return ModulusKind::kTension;
    default:
      return std::nullopt;
  }
}

TableModulusKind modulus_kind_of(const CsvTable& table, const ColumnMap& map,
                                 const std::vector<std::string>& names) {
  TableModulusKind found;
  const CsvColumn* teller = nullptr;
  bool has_own_name = false;
  for (const std::string& name : names) {
    const auto use = tells_kind(name) ? find_column(table, name, map) : std::nullopt;
    if (!use) continue;
    const CsvColumn& column = table.columns[use->index];
    const std::string& header = column.derived_from.empty() ? column.header : column.derived_from;
    if (is_own_name(column, column_kind(name)) && !column.modulus_kind) {
      has_own_name = true;
      continue;
    }
    if (found.header.empty()) found.header = header;
    const auto kind = modulus_kind_of_header(column);
    if (!kind) continue;
    if (teller != nullptr && *kind != found.kind) {
      throw std::runtime_error(table.file + ": the header '" + teller->header + "' speaks of " +
                               text_of(found.kind).word + " and '" + header + "' of " +
                               text_of(*kind).word +
                               "; state which it is with --modulus-kind, or choose other columns");
    }
    if (teller == nullptr) found.from = "the header '" + header + "'";
    teller = &column;
    found.kind = *kind;
  }
  if (teller != nullptr) return found;
  if (table.modulus_kind) {
    found.kind = *table.modulus_kind;
    found.from = table.maker.empty() ? "the instrument in the notes" : table.maker;
    return found;
  }
  found.is_assumed = !has_own_name;
  if (has_own_name) found.from = "a name of viscard, which means tension";
  return found;
}

}  // namespace viscard
