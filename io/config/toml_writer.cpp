#include "io/basics/number_text.h"
#include "io/basics/words.h"
#include "io/config/config_fields.h"

#include <fmt/format.h>

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
  explicit TomlWriter(std::string prefix) : prefix_(std::move(prefix)) {}

  void quantity(const QuantityField& field, double& value) override {
    // A positive number that was not given; no reader would take it.
    if (field.range == Range::kPositive && !field.is_required && value == 0.0) return;
    if (field.word != nullptr && value == field.word_value) {
      line(field.key, in_quotes(field.word));
    } else {
      line(field.key, number(value * field.written_per_value));
    }
  }
  void text(const TextField& field, std::string& value) override {
    line(field.key, in_quotes(value));
  }
  void integer(const char* key, std::int64_t, std::int64_t, std::int64_t& value) override {
    line(key, std::to_string(value));
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
    TomlWriter inner(prefix_ + key + ".");
    body(inner);
    sections_ += "\n[" + prefix_ + key + "]\n" + inner.all();
  }
  void list(const char* key, std::size_t size, const std::function<void(std::size_t)>&,
            const std::function<void(FieldVisitor&, std::size_t)>& body) override {
    for (std::size_t i = 0; i < size; ++i) {
      TomlWriter inner(prefix_ + key + ".");
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
    std::vector<std::string> texts;
    for (const auto& value : values) texts.push_back(text_of(value));
    line(key, "[" + listed(texts) + "]");
  }

  std::string prefix_;
  std::string lines_;
  std::string sections_;
};

}  // namespace

std::string toml_from_fields(const ShowFields& show) {
  TomlWriter writer("");
  show(writer);
  return writer.all();
}

}  // namespace viscard
