#include "io/tables/column_match.h"

#include "io/tables/csv_header.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Returns the text in lower case; each run of blanks, underscores, hyphens and dots becomes one blank.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : lower_case(text)) {
    const bool is_gap = c == ' ' || c == '_' || c == '-' || c == '.' || c == '\t';
    if (is_gap && (out.empty() || out.back() == ' ')) continue;
    out += is_gap ? ' ' : c;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

// Primes as instruments write them: G", G\u2032, G\u2033, G\u2019.
std::string with_plain_primes(std::string name) {
  constexpr std::pair<const char*, const char*> kPrimes[] = {
      {"\"", "''"}, {"\u2033", "''"}, {"\u2032", "'"}, {"\u2019", "'"}};
  for (const auto& [written, primes] : kPrimes) {
    const std::string from = written;
    for (std::size_t at = name.find(from); at != std::string::npos; at = name.find(from, at)) {
      name.replace(at, from.size(), primes);
    }
  }
  return name;
}

bool has_alias(const ColumnKind& quantity, const std::string& name) {
  const std::string primed = with_plain_primes(name);
  return std::any_of(quantity.aliases.begin(), quantity.aliases.end(), [&](const char* alias) {
    const std::string text = alias;
    const bool is_letter = text.size() == 1 || text.find('\'') == 1;  // t, T, E', G''
    return (is_letter ? primed : plain(primed)) == text;
  });
}

// The name without the kind of load ("Tensile stress") or of value ("Mean stress") and without symbols beside words: "Shear
// relaxation modulus G(t)" is a "relaxation modulus", "E' - Storage modulus" a "Storage modulus".
std::string without_kind_and_symbol(const std::string& name) {
  constexpr const char* kKinds[] = {"shear",   "tensile", "tension", "compressive", "compression",
                                    "young's", "youngs",  "young",   "axial",       "uniaxial",
                                    "mean",    "average", "avg"};
  constexpr const char* kSymbols[] = {
      "e",    "g",     "j",     "d",    "e(t)", "g(t)",   "j(t)",   "d(t)", "e'",    "g'",
      "e''",  "g''",   "|e*|",  "|g*|", "e*",   "g*",     "|eta*|", "|η*|", "eta*",  "η*",
      "δ",    "σ",     "τ",     "ε",    "γ",    "λ",      "ω",      "f",    "t",     "(e)",
      "(g)",  "(δ)",   "(ω)",   "(t)",  "(f)",  "(σ)",    "(τ)",    "(ε)",  "(γ)",   "(e')",
      "(g')", "(e'')", "(g'')", "(e*)", "(g*)", "(|e*|)", "(|g*|)", "(η*)", "(|η*|)"};
  std::string rest;
  std::string text = plain(with_plain_primes(name));
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::size_t n_words = 0, n_left = 0;
  for (std::string word; words >> word; ++n_words) {
    const auto is_among = [&](const auto& list) {
      return std::find(std::begin(list), std::end(list), word) != std::end(list);
    };
    if (is_among(kKinds) || is_among(kSymbols)) continue;
    rest += (n_left++ == 0 ? "" : " ") + word;
  }
  return n_left < n_words ? rest : "";
}

bool is_angular(const std::string& name) {
  const std::string text = plain(name);
  const auto& angular = angular_frequency_names();
  return std::any_of(angular.begin(), angular.end(), [&](const std::string& known) {
    return (known.size() == 1 ? name : text) == known;
  });
}

// A unit as part of a name, without a slash: 1_Pa, 1_per_Pa, per_MPa.
std::string unit_in_name(const std::string& text) {
  for (const char* start : {"1_per_", "per_", "1_"}) {
    if (text.rfind(start, 0) == 0) return "1/" + text.substr(std::string(start).size());
  }
  return text;
}

// A force in "g" or "kg": the weight of that mass.
bool is_weight_unit(const std::string& unit) {
  return is_stated(unit) && is_unit_of(unit, "kg");
}

std::optional<UnitScale> scale_if_fits(const std::string& name, const std::string& unit,
                                       const ColumnKind& quantity) {
  if (quantity.is_text) return UnitScale{};
  if (std::string(quantity.unit.si) == "Hz" && is_angular(name)) {
    if (is_stated(unit) && unit != "rad/s" && unit != "1/s" && unit != "s-1") return std::nullopt;
    return UnitScale{0.5 / std::numbers::pi, 0.0};
  }
  if (!is_stated(unit)) {
    // An elongation is a strain or a length, and P a pressure or a load: their units say which.
    const bool needs_unit = plain(name) == "elongation" || name == "P";
    return needs_unit ? std::nullopt : std::optional(UnitScale{});
  }
  if (std::string(quantity.unit.si) == "N" && is_weight_unit(unit)) {
    constexpr double kStandardGravity_m_s2 = 9.80665;  // BIPM, The International System of Units
    return UnitScale{kStandardGravity_m_s2 * scale_to_si(unit, "kg").factor, 0.0};
  }
  if (!is_unit_of(unit, quantity.unit.si)) return std::nullopt;
  return scale_to_si(unit, quantity.unit.si);
}

bool is_unit_assumed(const CsvColumn& column, const ColumnKind& quantity) {
  const bool has_unit = !quantity.is_text && std::string(quantity.unit.si) != "1";
  return has_unit && !is_stated(column.unit) && !is_angular(column.name);
}

// Of a column of words: segment, specimen, phase.
bool names_a_part(const std::string& name) {
  const std::vector<ColumnKind>& kinds = column_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const ColumnKind& kind) {
    return kind.is_text && (plain(name) == plain(kind.base) || has_alias(kind, name));
  });
}

// force_mN, depth_um: the quantity's own name followed by a unit; storage_kPa, "Load mN": another name of it.
std::optional<HeaderMatch> match_unit_in_name(const std::string& name, const ColumnKind& quantity) {
  const std::string base = std::string(quantity.base) + "_";
  const bool is_own = name.rfind(base, 0) == 0;
  const std::size_t at = is_own ? base.size() - 1 : name.find_last_of("_ ");
  if (at == std::string::npos) return std::nullopt;
  const std::string head = name.substr(0, at), unit = unit_in_name(name.substr(at + 1));
  const bool is_named = is_own || plain(head) == plain(quantity.base) || has_alias(quantity, head);
  if (!is_stated(unit) || !is_named) return std::nullopt;
  const auto scale = scale_if_fits(is_own ? quantity.base : head, unit, quantity);
  if (!scale) return std::nullopt;
  const bool is_weight = std::string(quantity.unit.si) == "N" && is_weight_unit(unit);
  return HeaderMatch{is_own ? 2 : 1, *scale, false, is_weight};
}

}  // namespace

std::optional<HeaderMatch> match_header(const CsvColumn& column, const ColumnKind& quantity) {
  if (column.name.empty()) return std::nullopt;
  if (column.header == quantity.name || column.name == quantity.name) {
    const auto scale = scale_if_fits(column.name, column.unit, quantity);
    // A name that ends in one unit above a row with another contradicts itself, so the column is
    // not used unless --column names it.
    const bool names_unit = std::string(quantity.name) != quantity.base;
    const bool is_si = scale && scale->factor == 1.0 && scale->offset == 0.0;
    if (!scale || (names_unit && !is_si)) return std::nullopt;
    return HeaderMatch{3, *scale};
  }
  // The column phase of a capture holds words, an angle does not.
  const bool is_text =
      !column.text.empty() && std::all_of(column.values.begin(), column.values.end(),
                                          [](double value) { return std::isnan(value); });
  if (is_text && !quantity.is_text && names_a_part(column.name)) return std::nullopt;
  // tau is a relaxation time, too.
  const bool is_tau = column.name == "tau" || column.name == "τ";
  if (is_tau && !is_stated(column.unit)) return std::nullopt;
  if (!quantity.is_text && !is_stated(column.unit)) {
    // Before symbols in a name are looked for: the g of mass_g is its unit.
    if (const auto found = match_unit_in_name(column.name, quantity)) return found;
  }
  const bool is_own_name = plain(column.name) == plain(quantity.base);
  const std::string rest = quantity.is_text ? "" : without_kind_and_symbol(column.name);
  const bool is_named_inside =
      rest.size() > 1 && (rest == plain(quantity.base) || has_alias(quantity, rest));
  if (!is_own_name && !is_named_inside && !has_alias(quantity, column.name)) return std::nullopt;
  const auto scale = scale_if_fits(column.name, column.unit, quantity);
  if (!scale) return std::nullopt;
  const bool is_weight = std::string(quantity.unit.si) == "N" && is_weight_unit(column.unit);
  return HeaderMatch{is_own_name ? 2 : 1, *scale, is_unit_assumed(column, quantity), is_weight};
}

bool is_stated(const std::string& unit) {
  return !unit.empty() && unit != "-";
}

}  // namespace viscard
