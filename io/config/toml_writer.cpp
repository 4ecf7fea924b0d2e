#include "io/basics/number_text.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{:04X}", byte);
    } else {
      out += c;
    }
  }
  return out + "\"";
}

// TOML reads 1 as an integer and 1.0 as a number.
std::string number(double value) {
  std::string out = text_from_number(value);
  if (out.find_first_not_of("-0123456789") == std::string::npos) out += ".0";
  return out;
}

class TomlWriter final : public FieldVisitor {
 public:
  TomlWriter(std::string prefix, Empty empty) : prefix_(std::move(prefix)), empty_(empty) {}

  void quantity(const QuantityField& field, double& value) override {
    // A positive number that was not given; no reader would take it.
    if (field.range == Range::kPositive && !field.is_required && value == 0.0) return;
    if (std::isnan(value)) return;  // not given
    if (field.word != nullptr && value == field.word_value) {
      line(field.key, in_quotes(field.word));
    } else {
      line(field.key, number(value * field.written_per_value));
    }
  }
  void text(const TextField& field, std::string& value) override {
    if (value.empty() && empty_ == Empty::kLeftOut) return;
    line(field.key, in_quotes(value));
  }
  void word(const TextField& field, const std::vector<std::string>&, std::string& value) override {
    if (!value.empty()) text(field, value);
  }
  void integer(const char* key, std::int64_t low, std::int64_t, std::int64_t& value) override {
    if (value >= low) line(key, std::to_string(value));
  }
  void boolean(const char* key, bool& value) override { line(key, value ? "true" : "false"); }

  void texts(const TextField& field, std::vector<std::string>& values) override {
    list_line(field.key, values, in_quotes);
  }
  void quantities(const QuantityField& field, std::vector<double>& values) override {
    list_line(field.key, values,
              [&](double value) { return number(value * field.written_per_value); });
  }
  void quantity_pairs(const char* key, QuantityOrUnit, QuantityOrUnit,
                      std::vector<std::pair<double, double>>& values) override {
    list_line(key, values, [](const auto& pair) {
      return "[" + number(pair.first) + ", " + number(pair.second) + "]";
    });
  }

  void section(const char* key, const std::function<void(FieldVisitor&)>& body) override {
    TomlWriter inner(prefix_ + key + ".", empty_);
    body(inner);
    if (inner.lines_.empty() && empty_ == Empty::kLeftOut) {
      sections_ += inner.sections_;
      return;
    }
    sections_ += "\n[" + prefix_ + key + "]\n" + inner.all();
  }
  void list(const char* key, std::size_t size, const std::function<void(std::size_t)>&,
            const std::function<void(FieldVisitor&, std::size_t)>& body) override {
    for (std::size_t i = 0; i < size; ++i) {
      TomlWriter inner(prefix_ + key + ".", empty_);
      body(inner, i);
      sections_ += "\n[[" + prefix_ + key + "]]\n" + inner.all();
    }
  }

  // Plain keys come before the sections, as TOML requires; they may be shown in any order.
  std::string all() const { return lines_ + sections_; }

 private:
  void line(const char* key, const std::string& value) {
    lines_ += std::string(key) + " = " + value + "\n";
  }
  template <typename Values, typename TextOf>
  void list_line(const char* key, const Values& values, const TextOf& text_of) {
    if (values.empty() && empty_ == Empty::kLeftOut) return;
    std::vector<std::string> texts;
    for (const auto& value : values) texts.push_back(text_of(value));
    line(key, "[" + listed(texts) + "]");
  }

  std::string prefix_;
  Empty empty_;
  std::string lines_;
  std::string sections_;
};

// Every key with what it may hold.
class KeyLister final : public FieldVisitor {
 public:
  KeyLister(std::string prefix, std::vector<FieldKey>& keys)
      : prefix_(std::move(prefix)), keys_(keys) {}

  void quantity(const QuantityField& field, double&) override { add(field.key, text_of(field)); }
  void text(const TextField& field, std::string&) override {
    add(field.key, std::string("a text, such as \"") + field.example + "\"");
  }
  void word(const TextField& field, const std::vector<std::string>& known, std::string&) override {
    add(field.key, "one of: " + listed(known));
  }
  void integer(const char* key, std::int64_t low, std::int64_t high, std::int64_t&) override {
    add(key, fmt::format("a whole number from {} to {}", low, high));
  }
  void boolean(const char* key, bool&) override { add(key, "true or false"); }
  void texts(const TextField& field, std::vector<std::string>& values) override {
    add(field.key, std::string("a list of texts, such as [\"") + field.example + "\"]");
    add_entries(field.key, values.size(), "an entry of the list");
  }
  void quantities(const QuantityField& field, std::vector<double>& values) override {
    add(field.key, "a list, each entry " + text_of(field));
    add_entries(field.key, values.size(), text_of(field));
  }
  void quantity_pairs(const char* key, QuantityOrUnit first, QuantityOrUnit second,
                      std::vector<std::pair<double, double>>& values) override {
    add(key,
        fmt::format("a list of pairs, {} and {}", text_of({key, first}), text_of({key, second})));
    for (std::size_t i = 1; i <= values.size(); ++i) {
      const std::string entry = std::string(key) + "." + std::to_string(i);
      add(entry + ".1", text_of({key, first}));
      add(entry + ".2", text_of({key, second}));
    }
  }
  void section(const char* key, const std::function<void(FieldVisitor&)>& body) override {
    KeyLister inner(prefix_ + key + ".", keys_);
    body(inner);
  }
  void list(const char* key, std::size_t size, const std::function<void(std::size_t)>& resize,
            const std::function<void(FieldVisitor&, std::size_t)>& body) override {
    if (size == 0) resize(1);
    for (std::size_t i = 0; i < std::max<std::size_t>(size, 1); ++i) {
      KeyLister inner(prefix_ + key + "." + std::to_string(i + 1) + ".", keys_);
      body(inner, i);
    }
    if (size == 0) resize(0);
  }

 private:
  void add(const std::string& key, const std::string& holds) {
    keys_.push_back({prefix_ + key, holds});
  }
  void add_entries(const char* key, std::size_t size, const std::string& holds) {
    for (std::size_t i = 1; i <= size; ++i) add(std::string(key) + "." + std::to_string(i), holds);
  }

  std::string prefix_;
  std::vector<FieldKey>& keys_;
};

}  // namespace

std::string text_of(const QuantityField& field) {
  constexpr const char* kRanges[] = {"a finite number", "a positive number",
                                     "a number that is not negative", "a number from 0 to 1"};
  std::string what = kRanges[static_cast<std::size_t>(field.range)];
  if (std::string(field.unit.si) != "1") what += std::string(" with a unit of ") + field.unit.si;
  if (field.word != nullptr) what += std::string(", or \"") + field.word + "\"";
  return what;
}

std::string toml_from_fields(const ShowFields& show, Empty empty) {
  TomlWriter writer("", empty);
  show(writer);
  return writer.all();
}

std::vector<FieldKey> keys_of_fields(const ShowFields& show) {
  std::vector<FieldKey> keys;
  KeyLister lister("", keys);
  show(lister);
  return keys;
}

}  // namespace viscard
