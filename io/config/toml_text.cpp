#include "io/config/toml_text.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

std::string line_of(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i < number && std::getline(lines, line); ++i) continue;
  return line;
}

// The first word in single quotes of the library's text: a key that stands twice.
std::string quoted_word(const std::string& text) {
  const std::size_t open = text.find('\'');
  const std::size_t close = text.find('\'', open + 1);
  return open == std::string::npos || close == std::string::npos
             ? ""
             : text.substr(open, close - open + 1);
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool begins_number(std::string_view value) {
  const std::size_t sign = value.front() == '-' || value.front() == '+' ? 1 : 0;
  return value.size() > sign && (is_digit(value[sign]) || value[sign] == '.');
}

bool has_decimal_comma(std::string_view value) {
  const std::size_t comma = value.find(',');
  return comma != std::string_view::npos && comma > 0 && comma + 1 < value.size() &&
         is_digit(value[comma - 1]) && is_digit(value[comma + 1]) &&
         value.find(',', comma + 1) == std::string_view::npos;
}

// Describes a wrong value of a key; empty if no known mistake fits.
std::string reason_of_value(const std::string& key, std::string_view value) {
  if (value.empty() || value.front() == '#') return "the value of '" + key + "' is missing";
  const bool is_text = value.front() == '"' || value.front() == '\'';
  if (is_text && std::count(value.begin(), value.end(), value.front()) % 2 != 0) {
    return "a quote (" + std::string(1, value.front()) + ") is missing";
  }
  if (value.front() == '[' || value.front() == '{') {
    const char close = value.front() == '[' ? ']' : '}';
    const bool is_open = value.find(close) == std::string_view::npos;
    return is_open ? "the bracket of '" + std::string(value) + "' is not closed" : "";
  }
  if (is_text) return "";
  const std::string_view bare = trimmed(value.substr(0, value.find('#')));
  if (bare.front() == '=') return "'=' stands twice behind '" + key + "'";
  if (begins_number(bare) && has_decimal_comma(bare)) {
    return "'" + std::string(bare) + "' has a decimal comma; write a point";
  }
  return "'" + std::string(bare) + "' needs quotes, as in " + key + " = \"" + std::string(bare) +
         "\"";
}

std::string reason(const std::string& line, const std::string& description) {
  if (description.find("redefine") != std::string::npos) {
    return quoted_word(description) + " is given twice";
  }
  const std::string_view text = trimmed(line);
  const std::size_t equals = text.find('=');
  if (!text.empty() && text.front() == '[' && text.find(']') == std::string_view::npos) {
    return "the bracket of '" + std::string(text) + "' is not closed";
  }
  if (equals == std::string_view::npos || equals == 0) {
    return "expected key = value or [section], found '" + std::string(text) + "'";
  }
  std::string of_value = reason_of_value(std::string(trimmed(text.substr(0, equals))),
                                         trimmed(text.substr(equals + 1)));
  if (!of_value.empty()) return of_value;
  if (description.find("nested value depth") != std::string::npos)
    return "lists or tables inside each other are nested deeper than the limit of 256";
  constexpr std::string_view kBegin = "Error while ";
  return description.starts_with(kBegin) ? description.substr(kBegin.size()) : description;
}

}  // namespace

namespace {

// Goes over TOML and measures its keys. Only the shape matters: a run of sections joined by dots is a key, a
// number or a date.
class KeyMeasure {
 public:
  explicit KeyMeasure(const std::string& text) : text_(text) {}

  // The first line with a key beyond the limits, and which; 0: none.
  std::size_t line_beyond(std::string& limit) {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == '"' || c == '\'') {
        take_string(c);
      } else {
        take_plain(c);
      }
      if (n_dots_ >= kDeepestKey) limit = std::to_string(kDeepestKey) + " sections";
      if (length_ > kLongestKey) limit = std::to_string(kLongestKey) + " characters";
      if (!limit.empty()) return line_;
    }
    return 0;
  }

 private:
  void take_plain(char c) {
    ++at_;
    if (c == '\n') ++line_;
    if (c == ' ' || c == '\t') return;  // may stand around a dot
    const bool is_key = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    if (c == '.') ++n_dots_;
    if (!is_key && c != '.') n_dots_ = 0;
    length_ = is_key ? length_ + 1 : 0;
  }
  // A text, or a section in quotation marks if a dot, '=' or ']' follows.
  void take_string(char quote) {
    const std::size_t begin = at_;
    const std::string three(3, quote);
    const bool is_long = text_.compare(at_, 3, three) == 0;
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      if (text_[at_] == '\\' && quote == '"') {
        at_ += 2;
        continue;
      }
      if (is_long ? text_.compare(at_, 3, three) == 0 : text_[at_] == quote) break;
      if (text_[at_] == '\n') {
        ++line_;
        if (!is_long) return;  // not closed, which the library reports
      }
      ++at_;
    }
    at_ = std::min(text_.size(), at_ + (is_long ? 3 : 1));
    const std::size_t next = text_.find_first_not_of(" \t", at_);
    const bool is_section = next != std::string::npos && (text_[next] == '.' || text_[next] == '=');
    length_ = is_section ? at_ - begin : 0;
  }

  const std::string& text_;
  std::size_t at_ = 0, line_ = 1, n_dots_ = 0, length_ = 0;
};

}  // namespace

void refuse_endless_toml(const std::string& text, const std::string& name) {
  if (text.size() > kMostTomlBytes) {
    throw std::runtime_error(name + ": has " + std::to_string(text.size() >> 20) +
                             " MiB; at most " + std::to_string(kMostTomlBytes >> 20) +
                             " MiB of TOML are read. Is it the file that was meant?");
  }
  std::string limit;
  const std::size_t line = KeyMeasure(text).line_beyond(limit);
  if (line == 0) return;
  throw std::runtime_error(name + ":" + std::to_string(line) + ": a key is longer than " + limit +
                           ", the limit; shorten it");
}

namespace {

bool holds_nul(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get().find('\0') != std::string::npos;
  if (const auto* list = node.as_array()) return std::any_of(list->begin(), list->end(), holds_nul);
  const auto* table = node.as_table();
  if (table == nullptr) return false;
  return std::any_of(table->begin(), table->end(), [](const auto& entry) {
    return entry.first.str().find('\0') != std::string_view::npos || holds_nul(entry.second);
  });
}

}  // namespace

toml::table parsed_toml(const std::string& text, const std::string& name) {
  refuse_endless_toml(text, name);
  toml::table table = toml::parse(text, name);
  // C cuts texts there, those of messages as well.
  if (holds_nul(table)) {
    throw std::runtime_error(name + ": a text or key has the character \\u0000; remove it");
  }
  return table;
}

toml::table table_from_toml(const std::string& text, const std::string& name) {
  try {
    return parsed_toml(text, name);
  } catch (const toml::parse_error& error) {
    const std::size_t line = error.source().begin.line;
    throw std::runtime_error(name + ":" + std::to_string(line) + ": not TOML: " +
                             reason(line_of(text, line), std::string(error.description())));
  }
}

}  // namespace viscard
