#include "io/basics/words.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitute});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

// Of ASCII letters.
std::string in_lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return text;
}

// "\x1b".
std::string shown_byte(unsigned char byte) {
  constexpr char kDigits[] = "0123456789abcdef";
  return std::string("\\x") + kDigits[byte >> 4] + kDigits[byte & 15];
}

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  // Half of the letters must agree: "SI" is not near "mm", "nix" not near "rig".
  std::size_t best_distance =
      std::min(std::max<std::size_t>(2, word.size() / 3), word.size() / 2) + 1;
  const std::string lower = in_lower_case(word);
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(lower, in_lower_case(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known,
                         const char* otherwise) {
  const std::string near = nearest_word(word, known);
  return near.empty() ? otherwise : "; did you mean '" + near + "'?";
}

std::string no_such_word(const std::string& kind, const std::string& word,
                         const std::vector<std::string>& known) {
  const std::string begin = "there is no " + kind + " '" + word + "'";
  if (known.empty()) return begin + "; there are none";
  return begin + did_you_mean(word, known) + " There are: " + listed(known);
}

std::string quoted_for_shell(const std::vector<std::string>& words) {
  const std::string plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789@%_-+=:,./";
  std::string line;
  for (const std::string& word : words) {
    if (!line.empty()) line += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(at), second = byte(at + 1);
  if (lead < 0x80) return 1;
  const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  // Too long a form, half of a surrogate pair, or beyond the last character.
  const bool is_bad = lead > 0xF4 || (lead == 0xE0 && second < 0xA0) ||
                      (lead == 0xED && second > 0x9F) || (lead == 0xF0 && second < 0x90) ||
                      (lead == 0xF4 && second > 0x8F);
  if (is_bad || at + length > text.size()) return 0;
  const std::string_view rest = text.substr(at, length).substr(std::min<std::size_t>(1, length));
  return std::all_of(rest.begin(), rest.end(), continues_character) ? length : 0;
}

std::string utf8_on_one_line(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    if (length == 0) {
      out += shown_byte(byte);
    } else if (byte < 0x20 || byte == 0x7f) {
      out += ' ';
    } else {
      out += text.substr(i, length);
    }
    i += std::max<std::size_t>(1, length);
  }
  return out;
}

std::string with_shown_controls(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    const bool is_ascii_control = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f;
    // U+0080 to U+009F, which some terminals obey, too.
    const bool is_late_control =
        byte == 0xC2 && length == 2 && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (length == 0 || is_ascii_control) {
      out += shown_byte(byte);
    } else if (is_late_control) {
      out += shown_byte(byte) + shown_byte(static_cast<unsigned char>(text[i + 1]));
    } else {
      out += text.substr(i, length);
    }
    i += std::max<std::size_t>(1, length);
  }
  return out;
}

std::size_t length_in_characters(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues_character));
}

std::string superscript(int exponent) {
  static const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

}  // namespace viscard
