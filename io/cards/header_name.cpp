#include "io/cards/header_name.h"

#include <fmt/format.h>

#include <cctype>

namespace viscard {
namespace {

// Whether "%XX" stands there.
bool is_escape(const std::string& text, std::size_t at) {
  return at + 2 < text.size() && text[at] == '%' &&
         std::isxdigit(static_cast<unsigned char>(text[at + 1])) != 0 &&
         std::isxdigit(static_cast<unsigned char>(text[at + 2])) != 0;
}

}  // namespace

std::string name_in_header(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool is_printable = c >= ' ' && c <= '~';
    const bool is_second_dash = c == '-' && out.ends_with('-');
    const bool is_last_blank = c == ' ' && i + 1 == name.size();  // readers trim the end
    const bool is_plain = is_printable && c != '"' && c != '\\' && !is_second_dash &&
                          !is_last_blank && !is_escape(name, i);
    out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string name_from_header(const std::string& text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_escape(text, i)) {
      name += text[i];
      continue;
    }
    name += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return name_in_header(name) == text ? name : text;
}

std::size_t behind_mark(const std::string& header, std::string_view mark) {
  for (std::size_t at = header.find(mark); at != std::string::npos;
       at = header.find(mark, at + 1)) {
    std::size_t begin = at;
    const auto is_in_line = [&](std::size_t i) {
      return header[i] != '\n' && std::isalnum(static_cast<unsigned char>(header[i])) == 0;
    };
    while (begin > 0 && is_in_line(begin - 1)) --begin;
    if (begin == 0 || header[begin - 1] == '\n') return at + mark.size();
  }
  return std::string::npos;
}

}  // namespace viscard
