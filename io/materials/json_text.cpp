#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/materials/json_watch.h"
#include "io/materials/material_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

const std::set<std::string>& known_keys(const std::string& section) {
  static const std::map<std::string, std::set<std::string>> kKnown{
      {"",
       {"schema", "name", "E0_Pa", "nu", "rho_kg_m3", "terms", "T_ref_C", "valid", "uncertainty",
        "flags", "provenance", "mixing_ratio", "specimen_id", "shift", "body_sha256"}},
      {"shift",
       {"law", "C1", "C2_K", "activation_J_mol", "T_ref_C", "T_min_C", "T_max_C", "C1_interval_95",
        "C2_K_interval_95", "activation_J_mol_interval_95"}},
      {"terms", {"g", "k", "tau_s", "modulus_se_Pa", "ln_tau_se", "interval_95"}},
      {"interval_95", {"modulus_Pa", "g", "tau_s"}},
      {"valid", {"t_min_s", "t_max_s", "strain_max"}},
      {"uncertainty",
       {"E0_interval_95", "E_inf_interval_95", "systematic_relative", "systematic_parts",
        "covariance_parameters", "covariance"}},
      {"systematic_parts", {"cause", "E0", "g", "tau_s"}},
      {"flags", {"name", "term", "text"}},
      {"provenance",
       {"created_by", "created_at", "command", "raw_files", "fit_from_s", "fit_to_s", "nu_origin",
        "bulk_origin"}},
      {"raw_files", {"path", "sha256"}}};
  static const std::set<std::string> kNone;
  const auto found = kKnown.find(section);
  return found == kKnown.end() ? kNone : found->second;
}

void carry_unknown(const Json& original, Json& fresh, const std::string& section) {
  const auto& known = known_keys(section);
  for (const auto& [key, value] : original.items()) {
    if (known.count(key) == 0) {
      fresh[key] = value;
    } else if (fresh.contains(key) && value.is_object() && fresh[key].is_object()) {
      carry_unknown(value, fresh[key], key);
    } else if (fresh.contains(key) && value.is_array() && fresh[key].is_array() &&
               value.size() == fresh[key].size()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (value[i].is_object() && fresh[key][i].is_object()) {
          carry_unknown(value[i], fresh[key][i], key);
        }
      }
    }
  }
}

// ":3: is not JSON: column 7: ": where the reader gave up, counted from 1.
std::string place_of_fault(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(text.size(), byte == 0 ? 0 : byte - 1);
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t last = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = 1 + end - (last == std::string::npos ? 0 : last + 1);
  return ":" + std::to_string(line) + ": is not JSON: at column " + std::to_string(column) + " ";
}

// "the reader met ..." without the words of the JSON library about its own work.
std::string what_was_met(const Json::parse_error& error) {
  std::string what = error.what();
  if (what.find("unexpected end of input") != std::string::npos) {
    return "the file ends too early; a closing quotation mark, bracket or brace is missing";
  }
  const std::size_t from = what.find(" - "), to = what.find("; last read");
  what = from == std::string::npos
             ? what
             : what.substr(from + 3, to == std::string::npos ? to : to - from - 3);
  return "the text is unexpected (" + what.substr(0, what.find(';')) +
         "); look for a comma, quotation mark or brace that is missing before it";
}

}  // namespace

int whole_number(const Json& json) {
  if (!json.is_number_integer()) throw std::runtime_error("expected a whole number");
  const auto value = json.get<std::int64_t>();
  constexpr std::int64_t kMost = 1'000'000'000;
  if (value < -kMost || value > kMost) {
    throw std::runtime_error("expected a whole number of at most nine digits");
  }
  return static_cast<int>(value);
}

Json json_from(const Interval& interval) {
  const auto bound = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  return Json::array({bound(interval.low), bound(interval.high)});
}

std::string reason_of(const Json::exception& error) {
  std::string what = error.what();  // "[json.exception.type_error.302] type must be number, ..."
  const std::size_t tag = what.find("] ");
  if (tag != std::string::npos) what.erase(0, tag + 2);
  return what;
}

Json parse_json(const std::string& text, const std::string& name) {
  const JsonFaults faults = faults_of_json(text);
  if (faults.has_many_keys) {
    throw std::runtime_error(name + ": an object has more than " + std::to_string(kMostJsonKeys) +
                             " keys, the limit; remove those that viscard does not know");
  }
  Json json;
  try {
    json = ordered_json_from_text(text);
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(name + place_of_fault(text, error.byte) + what_was_met(error));
  } catch (const Json::exception& error) {
    throw std::runtime_error(name + ": is not JSON: " + reason_of(error));
  }
  if (faults.is_deep) {
    throw std::runtime_error(name + ": is nested deeper than " + std::to_string(kDeepestJson) +
                             " levels, the limit");
  }
  if (faults.has_long_key) {
    throw std::runtime_error(name + ": a key has more than " + std::to_string(kLongestJsonKey) +
                             " characters, the limit");
  }
  if (faults.has_nul) {
    throw std::runtime_error(name +
                             ": a text has the character \\u0000, which no text may have; "
                             "remove it");
  }
  if (!faults.repeated.empty()) {
    throw std::runtime_error(name + ": key '" + faults.repeated + "' is given twice");
  }
  return json;
}

namespace {

constexpr const char* kBodySum = "body_sha256";

std::string sum_of_body(Json json) {
  json.erase(kBodySum);
  return sha256_of_text(text_from_json(json));
}

// Laws of rubber have no author, but those by viscard name tables or a card, with sums. Materials state it in
// "provenance", joint fits in that of "common"; what typed numbers come from begins with other words.
bool is_by_viscard(const Json& json) {
  if (json.contains("laws"))
    return json.contains("imported_from") || (json.contains("tests") && !json["tests"].empty());
  const Json& material = json.contains("common") ? json["common"] : json;
  if (!material.is_object()) return false;
  const Json& origin = material.contains("provenance") ? material["provenance"] : material;
  return origin.is_object() && origin.contains("created_by") && origin["created_by"].is_string() &&
         origin["created_by"].get<std::string>().starts_with("viscard ");
}

}  // namespace

void add_body_sum(Json& json) {
  json.erase(kBodySum);
  json[kBodySum] = sum_of_body(json);
}

bool has_own_sum(const std::string& text) {
  const Json json = parse_json(text, "the file");
  return json.is_object() && json.contains(kBodySum) && json[kBodySum] == sum_of_body(json);
}

bool is_doubt_of_record(const MaterialFlag& flag) {
  static const std::set<std::string> kDoubts = {
      kEdited,           kUncheckedCardFlag,  "unverified",
      "samples-damaged", "reports-damaged",   "temperatures-damaged",
      "side-file-torn",  "side-file-missing", "calibration-edited"};
  return kDoubts.count(flag.name) > 0;
}

bool is_edited(const Json& json, const std::string& name) {
  if (!json.is_object()) return false;
  if (!json.contains(kBodySum)) {
    if (is_by_viscard(json)) {
      note_input(name,
                 "has no sum of its contents, because it was written before 2026-12 or the sum was "
                 "removed; "
                 "whether it was edited cannot be seen");
    }
    return false;
  }
  if (json[kBodySum] == sum_of_body(json)) return false;
  note_input(name, kEditedText);
  return true;
}

void carry_unknown_keys(const Json& original, Json& fresh) {
  carry_unknown(original, fresh, "");
}

}  // namespace viscard
