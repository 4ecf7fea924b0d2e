#include "io/basics/number_text.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"
#include "io/config/quantity_text.h"
#include "io/config/toml_text.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

bool is_in(Range range, double value) {
  if (!std::isfinite(value) || range == Range::kAny) return std::isfinite(value);
  if (range == Range::kPositive) return value > 0.0;
  return value >= 0.0 && (range != Range::kFraction || value <= 1.0);
}

class TomlReader final : public FieldVisitor {
 public:
  TomlReader(const toml::table& table, std::string file, std::string prefix, const ReadRules& rules,
             std::vector<std::function<void()>>& finishes)
      : table_(table),
        file_(std::move(file)),
        prefix_(std::move(prefix)),
        rules_(rules),
        finishes_(finishes) {}

  Plausible judged() const override { return rules_.plausible; }
  bool reads() const override { return true; }
  void after_all_keys(const std::function<void()>& finish) override { finishes_.push_back(finish); }

  void quantity(const QuantityField& field, double& value) override {
    const toml::node* node = find(field.key, field.is_required, text_of(field));
    if (node != nullptr) value = quantity_at(*node, field, "");
  }

  void text(const TextField& field, std::string& value) override {
    const std::string what = std::string("a text in quotes, such as \"") + field.example + "\"";
    const toml::node* node = find(field.key, field.is_required, what);
    if (node == nullptr) return;
    if (const auto text = node->value_exact<std::string>()) {
      value = *text;
    } else if (field.may_be_number && node->is_number()) {
      value = text_from_number(*node->value<double>());
    } else if (node->is_date() || node->is_date_time()) {  // a date needs no quotes in TOML
      std::ostringstream date;
      node->is_date() ? date << *node->as_date() : date << *node->as_date_time();
      value = date.str();
    } else {
      fail(*node, field.key, "expected " + what);
    }
  }

  void word(const TextField& field, const std::vector<std::string>& known,
            std::string& value) override {
    std::string given;
    text(field, given);
    if (table_.get(field.key) == nullptr) return;
    if (std::find(known.begin(), known.end(), given) == known.end()) {
      throw BadNumber(where(*table_.get(field.key)) + prefix_ + field.key + ": cannot be '" +
                      given + "'" + did_you_mean(given, known) + " There are: " + listed(known));
    }
    value = given;
  }

  void integer(const char* key, std::int64_t low, std::int64_t high, std::int64_t& value) override {
    const std::string what =
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    const toml::node* node = find(key, false, what);
    if (node == nullptr) return;
    const auto number = node->value_exact<std::int64_t>();
    if (!number || *number < low || *number > high) fail(*node, key, "expected " + what);
    value = *number;
  }

  void boolean(const char* key, bool& value) override {
    const toml::node* node = find(key, false, "true or false");
    if (node == nullptr) return;
    const auto truth = node->value_exact<bool>();
    if (!truth) fail(*node, key, "expected true or false, without quotes");
    value = *truth;
  }

  void texts(const TextField& field, std::vector<std::string>& values) override {
    const std::string what = std::string("a list of texts, such as [\"") + field.example + "\"]";
    read_list(field.key, field.is_required, what, values,
              [&](const toml::node& entry, const std::string&) {
                const auto text = entry.value_exact<std::string>();
                if (!text) fail(entry, field.key, "expected " + what);
                return *text;
              });
  }

  void quantity_pairs(const char* key, QuantityOrUnit first, QuantityOrUnit second,
                      std::vector<std::pair<double, double>>& values) override {
    const bool are_numbers = std::string(first.si) == "1" && std::string(second.si) == "1";
    const std::string what = are_numbers ? "a list of pairs, [[1, 1], [2, 1], ...]"
                                         : std::string("a list of pairs, [[\"1 ") + first.si +
                                               "\", \"2 " + second.si + "\"], ...]";
    read_list(key, false, what, values, [&](const toml::node& entry, const std::string& place) {
      const toml::array* pair = entry.as_array();
      if (pair == nullptr || pair->size() != 2) fail(entry, key, "expected " + what);
      return std::pair(quantity_at(*pair->get(0), {key, first}, place + ".1"),
                       quantity_at(*pair->get(1), {key, second}, place + ".2"));
    });
  }

  void quantities(const QuantityField& field, std::vector<double>& values) override {
    read_list(field.key, field.is_required, "a list, each entry " + text_of(field), values,
              [&](const toml::node& entry, const std::string& place) {
                return quantity_at(entry, field, place);
              });
  }

  void section(const char* key, const std::function<void(FieldVisitor&)>& body) override {
    static const toml::table kEmpty;
    const toml::node* node = find(key, false, "");
    if (node != nullptr && !node->is_table()) {
      fail(*node, key, std::string("expected a section [") + prefix_ + key + "]");
    }
    TomlReader inner(node != nullptr ? *node->as_table() : kEmpty, file_, prefix_ + key + ".",
                     rules_, finishes_);
    body(inner);
    inner.refuse_unknown_keys();
  }

  void section_or_word(const char* key, const char* word,
                       const std::function<void(FieldVisitor&)>& body) override {
    const toml::node* node = find(key, false, "");
    if (node == nullptr || node->is_table()) return section(key, body);
    const auto text = node->value<std::string>();
    if (!node->is_string() || *text != word) {
      fail(*node, key,
           std::string("expected \"") + word + "\" or a section [" + prefix_ + key + "]");
    }
  }

  void list(const char* key, std::size_t, const std::function<void(std::size_t)>& resize,
            const std::function<void(FieldVisitor&, std::size_t)>& body) override {
    const toml::node* node = find(key, false, "");
    if (node == nullptr) return;
    const toml::array* entries = node->as_array();
    if (entries == nullptr) fail(*node, key, "expected a list of tables");
    resize(entries->size());
    for (std::size_t i = 0; i < entries->size(); ++i) {
      const toml::table* entry = entries->get(i)->as_table();
      if (entry == nullptr) fail(*entries->get(i), key, "expected a list of tables");
      TomlReader inner(*entry, file_, prefix_ + key + "[" + std::to_string(i + 1) + "].", rules_,
                       finishes_);
      body(inner, i);
      inner.refuse_unknown_keys();
    }
  }

  // The key `plausible` of any file. Lists of known keys leave it out: few files need it.
  bool accepts_any() {
    const toml::node* node = table_.get("plausible");
    if (node == nullptr) return false;
    const auto word = node->value_exact<std::string>();
    has_plausible_ = true;
    if (word && (*word == "on" || *word == "off")) return *word == "off";
    fail(*node, "plausible", "expected \"on\" (the default), or \"off\" to accept any value");
  }

  // Reports a misspelt key before a missing one, because the misspelling is usually the cause.
  void refuse_unknown_keys() const {
    for (const auto& [key, node] : table_) {
      const std::string word(key.str());
      if (std::find(known_.begin(), known_.end(), word) != known_.end()) continue;
      if (has_plausible_ && word == "plausible") continue;
      throw std::runtime_error(where(node) + "there is no key '" + prefix_ + word + "'" +
                               did_you_mean(word, known_) + " Known here: " + listed(known_));
    }
    if (!missing_.empty()) throw std::runtime_error(missing_);
  }

 private:
  // `place`: ".2" of the second entry of a list.
  double quantity_at(const toml::node& node, const QuantityField& field,
                     const std::string& place) const {
    double written = 0.0;
    if (const auto number = node.value_exact<double>()) {
      written = *number;
    } else if (const auto whole = node.value_exact<std::int64_t>()) {
      written = static_cast<double>(*whole);
    } else if (const auto text = node.value_exact<std::string>()) {
      if (field.word != nullptr && *text == field.word) return field.word_value;
      try {
        if (const auto uncertain = uncertain_from_text(*text, field.unit.si)) {
          written = chosen({prefix_ + field.key + place, *text, field.unit.si, *uncertain},
                           field.is_exact);
        } else {
          written = quantity_from_text(*text, field.unit.si);
        }
      } catch (const std::invalid_argument& error) {
        fail(node, field.key, error.what());
      }
    } else {
      fail(node, field.key, "expected " + text_of(field));
    }
    if (!is_in(field.range, written)) {
      fail(node, field.key,
           "is " + text_from_number(written) + "; expected " +
               text_of(QuantityField{.key = field.key, .range = field.range}));
    }
    if (field.unit.quantity == nullptr) return written / field.written_per_value;
    // Above a metre a length has to state its unit: without one it was most likely forgotten.
    const bool is_bare_length = node.is_number() && field.unit.quantity == &quantities::kLength;
    const Plausible judged = is_bare_length && rules_.plausible == Plausible::kScene
                                 ? Plausible::kMeasured
                                 : rules_.plausible;
    if (const auto doubt = doubt_about(*field.unit.quantity, written, judged)) {
      fail(node, field.key,
           doubt->with_remedy("write \"" + doubt->meant + "\"",
                              "write plausible = \"off\" at the top of the file"));
    }
    return written / field.written_per_value;
  }

  double chosen(const UncertainField& field, bool is_exact) const {
    if (is_exact || !rules_.choose) {
      throw std::invalid_argument(
          std::string(rules_.choose ? "has no uncertainty" : "is read exactly here") +
          "; leave out what stands behind +-");
    }
    return rules_.choose(field);
  }

  const toml::node* find(const char* key, bool is_required, const std::string& what) {
    known_.emplace_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr && is_required && missing_.empty()) {
      const auto line = table_.source().begin.line;
      missing_ = file_ + (line > 0 ? ":" + std::to_string(line) : "") + ": '" + prefix_ + key +
                 "' is missing; expected " + what;
    }
    return node;
  }

  // Replaces the values by those that `read_entry` returns, unless an optional key is missing.
  template <typename Value, typename ReadEntry>
  void read_list(const char* key, bool is_required, const std::string& what,
                 std::vector<Value>& values, const ReadEntry& read_entry) {
    const toml::node* node = find(key, is_required, what);
    if (node == nullptr) return;
    if (node->as_array() == nullptr) fail(*node, key, "expected " + what);
    values.clear();
    for (const toml::node& entry : *node->as_array()) {
      values.push_back(read_entry(entry, "." + std::to_string(values.size() + 1)));
    }
  }

  std::string where(const toml::node& node) const {
    return file_ + ":" + std::to_string(node.source().begin.line) + ": ";
  }

  // Of a value; BadNumber is also thrown for a text where a number is expected.
  [[noreturn]] void fail(const toml::node& node, const char* key, const std::string& what) const {
    throw BadNumber(where(node) + prefix_ + key + ": " + what);
  }

  const toml::table& table_;
  std::string file_;
  std::string prefix_;  // "stage."
  const ReadRules& rules_;
  std::vector<std::function<void()>>& finishes_;
  std::vector<std::string> known_;
  bool has_plausible_ = false;  // was read before the fields
  std::string missing_;         // message about the first required key that is missing
};

}  // namespace

bool read_toml_fields(const std::string& text, const std::string& name, const ShowFields& show,
                      const ReadRules& rules) {
  const toml::table table = table_from_toml(text, name);
  ReadRules of_file = rules;
  std::vector<std::function<void()>> finishes;
  TomlReader reader(table, name, "", of_file, finishes);
  const bool accepts_any = reader.accepts_any();
  if (accepts_any) of_file.plausible = Plausible::kOff;
  show(reader);
  reader.refuse_unknown_keys();
  for (const auto& finish : finishes) finish();
  return accepts_any;
}

}  // namespace viscard
