#pragma once

#include "io/basics/file_kind.h"
#include "models/quantities/plausible.h"
#include "models/uncertainty/uncertain_number.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace viscard {

// One function per configuration struct shows each of its fields to a FieldVisitor. One visitor
// reads TOML into the fields, another writes them as TOML, so that reading and writing cannot
// differ.

// Allowed values of a quantity.
enum class Range { kAny, kPositive, kNotNegative, kFraction };  // fraction: [0, 1]

// A number with a unit, as a file has it: "40 um".
struct QuantityField {
  const char* key;
  QuantityOrUnit unit = "1";
  Range range = Range::kAny;
  bool is_required = false;
  double written_per_value = 1.0;  // 2 for a radius that is written as a diameter
  const char* word = nullptr;      // a word that a file may use for word_value: "rigid"
  double word_value = 0.0;         // in SI
  bool is_exact = false;           // a setting or a requested point: has no uncertainty
};
// "a positive number with a unit of m".
std::string text_of(const QuantityField& field);

// A text; the example stands in messages.
struct TextField {
  const char* key;
  const char* example;
  bool is_required = false;
  bool may_be_number = false;  // without quotes; the text is then that of the number
};

// The words that a key may have, and what they mean.
template <typename Value>
using WordTable = std::map<std::string, Value>;

// Reads or writes the fields of a struct, or lists their keys.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  // How numbers are judged, also those of files that the fields name.
  virtual Plausible judged() const { return Plausible::kOff; }
  // Whether values are taken from a file.
  virtual bool reads() const { return false; }
  // finish() is called once all keys of the file are read and known: to fill what several keys decide, and to refuse
  // what contradicts itself.
  virtual void after_all_keys(const std::function<void()>& /*finish*/) {}
  // key = "40 um"; the value is in the SI unit of the field.
  virtual void quantity(const QuantityField& field, double& value) = 0;
  // key = "words".
  virtual void text(const TextField& field, std::string& value) = 0;
  // key = "word", one of those known; an empty value: not given.
  virtual void word(const TextField& field, const std::vector<std::string>& known,
                    std::string& value) = 0;
  // The same for a value with a word; those without one, as the default may be, are not written.
  template <typename Value>
  void choice(const TextField& field, const WordTable<std::type_identity_t<Value>>& words,
              Value& value);
  // Nothing: not given.
  template <typename Value>
  void choice(const TextField& field, const WordTable<std::type_identity_t<Value>>& words,
              std::optional<Value>& value);
  // key = "word", with which a file may say what holds anyway.
  void only(const char* key, const char* known) {
    std::string value = known;
    word({key, known}, {known}, value);
  }
  // key = 3, from low to high.
  virtual void integer(const char* key, std::int64_t low, std::int64_t high,
                       std::int64_t& value) = 0;
  // The same for a member of any whole type.
  template <typename Integer>
  void integer(const char* key, std::int64_t low, std::int64_t high, Integer& value) {
    auto wide = static_cast<std::int64_t>(value);
    integer(key, low, high, wide);
    value = static_cast<Integer>(wide);
  }
  // key = true.
  virtual void boolean(const char* key, bool& value) = 0;
  // key = ["a", "b"].
  virtual void texts(const TextField& field, std::vector<std::string>& values) = 0;
  // key = [["0 s", "10 kPa"], ...]; the values are in the SI units named.
  virtual void quantity_pairs(const char* key, QuantityOrUnit first, QuantityOrUnit second,
                              std::vector<std::pair<double, double>>& values) = 0;
  // key = ["5 um", "10 um"]; every entry is read as by quantity(), values in SI.
  virtual void quantities(const QuantityField& field, std::vector<double>& values) = 0;
  // A section [key] with the fields that body shows.
  virtual void section(const char* key, const std::function<void(FieldVisitor&)>& body) = 0;
  // The same, or a word in its place, which leaves the fields as they are.
  virtual void section_or_word(const char* key, const char* /*word*/,
                               const std::function<void(FieldVisitor&)>& body) {
    section(key, body);
  }
  // A list of sections [[key]]: on reading, resize(n) is called with the number of entries; body
  // shows the fields of entry i.
  virtual void list(const char* key, std::size_t size,
                    const std::function<void(std::size_t)>& resize,
                    const std::function<void(FieldVisitor&, std::size_t)>& body) = 0;
};

template <typename Value>
void FieldVisitor::choice(const TextField& field,
                          const WordTable<std::type_identity_t<Value>>& words, Value& value) {
  std::optional<Value> chosen = value;
  choice(field, words, chosen);
  if (chosen) value = *chosen;
}

template <typename Value>
void FieldVisitor::choice(const TextField& field,
                          const WordTable<std::type_identity_t<Value>>& words,
                          std::optional<Value>& value) {
  std::vector<std::string> known;
  std::string chosen;
  for (const auto& [name, meaning] : words) {
    known.push_back(name);
    if (value && meaning == *value) chosen = name;
  }
  const std::string before = chosen;
  word(field, known, chosen);
  if (chosen != before) value = words.at(chosen);
}

// Shows all fields of a struct to a visitor.
using ShowFields = std::function<void(FieldVisitor&)>;

// An uncertain quantity, as it stands in a file.
struct UncertainField {
  std::string key;   // "geometry.diameter", or "shape.at.2" for the second entry of a list
  std::string text;  // "40 um +- 1 um"
  std::string unit;  // SI
  UncertainNumber number;
};
// Returns the value to take for it.
using ChooseValue = std::function<double(const UncertainField& field)>;

// How a file is read.
struct ReadRules {
  Plausible plausible = Plausible::kOff;  // a file may say plausible = "off"
  ChooseValue choose = {};                // without it, uncertain quantities are refused
};

// Throws std::runtime_error with file, line, key and the expected value; messages show name in
// place of the file. Returns whether the file says plausible = "off".
bool read_toml_fields(const std::string& text, const std::string& name, const ShowFields& show,
                      const ReadRules& rules = {});

// The fields as TOML, in SI. Empty: texts, lists and sections without content.
enum class Empty { kWritten, kLeftOut };
std::string toml_from_fields(const ShowFields& show, Empty empty = Empty::kWritten);

// A key that a file may have, and what it may hold: "a positive number with a unit of m".
struct FieldKey {
  std::string key;  // "geometry.diameter", "shape.at.2"
  std::string holds;
};
// All keys, those of sections too, and the entries that lists of values have. A list of sections has one entry at
// least: "geometry.classes.1.diameter".
std::vector<FieldKey> keys_of_fields(const ShowFields& show);

// Returns the line (from 1) of a key such as "geometry.film.radius" in a TOML text, or that of the
// innermost table around it if the key is missing, or 0 if the text is not TOML. An entry of a list
// is given by its number from 1: "analysis.history.3".
int line_of_key(const std::string& toml, const std::string& dotted_key);

// The path of a file that the TOML text names at a key. Throws std::runtime_error "rig.toml:7:
// calibration.file: names ..., but ...; ..." if it cannot be read. `in`: the file of the text.
std::filesystem::path path_at_key(const std::string& toml, const std::filesystem::path& in,
                                  const std::string& dotted_key, const std::string& name,
                                  FileKind wanted);

}  // namespace viscard
