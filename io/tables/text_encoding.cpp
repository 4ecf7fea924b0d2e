#include "io/tables/text_encoding.h"

#include "io/basics/words.h"
#include "io/tables/column_names.h"
#include "io/tables/csv_header.h"

#include <iconv.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

void append_utf8(std::string& out, char32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    out += static_cast<char>(0xe0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    out += static_cast<char>(0xf0 | (code >> 18));
    out += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
}

unsigned char byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

std::string from_utf16(std::string_view bytes, bool is_big_endian) {
  std::string out;
  out.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t i) {
    const unsigned high = byte_at(bytes, is_big_endian ? i : i + 1);
    const unsigned low = byte_at(bytes, is_big_endian ? i + 1 : i);
    return static_cast<char32_t>(high << 8 | low);
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t code = unit(i);
    if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size()) {  // a surrogate pair
      code = 0x10000 + ((code - 0xd800) << 10) + ((unit(i + 2) - 0xdc00) & 0x3ff);
      i += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

bool is_utf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint64_t eight = 0x80;
    if (i + 8 <= bytes.size()) std::memcpy(&eight, bytes.data() + i, 8);
    if ((eight & 0x8080808080808080u) == 0) {
      i += 8;
      continue;
    }
    const std::size_t length = utf8_length(bytes, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

// Byte order of UTF-16 by its BOM, or without one because every other byte of the first characters
// is zero; nothing for other encodings.
std::optional<bool> is_big_endian_utf16(std::string_view bytes) {
  if (bytes.size() >= 2 && byte_at(bytes, 0) == 0xff && byte_at(bytes, 1) == 0xfe) return false;
  if (bytes.size() >= 2 && byte_at(bytes, 0) == 0xfe && byte_at(bytes, 1) == 0xff) return true;
  if (bytes.size() < 4) return std::nullopt;
  const bool odd = bytes[1] == 0 && bytes[3] == 0 && bytes[0] != 0 && bytes[2] != 0;
  const bool even = bytes[0] == 0 && bytes[2] == 0 && bytes[1] != 0 && bytes[3] != 0;
  if (!odd && !even) return std::nullopt;
  return even;
}

// In Chinese text bytes above 0x7f come in pairs, or in fours; in Latin-1 mostly one by one.
bool has_pairs_only(std::string_view bytes) {
  const auto is_high = [](char byte) { return static_cast<unsigned char>(byte) >= 0x80; };
  for (auto at = bytes.begin(); at != bytes.end();) {
    const auto first = std::find_if(at, bytes.end(), is_high);
    at = std::find_if_not(first, bytes.end(), is_high);
    if ((at - first) % 2 != 0) return false;
  }
  return true;
}

// Text in UTF-8 from another encoding, by iconv; nothing if the bytes are none of it.
std::optional<std::string> from_encoding(std::string_view bytes, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  // (iconv_t)-1 as POSIX has it: this system does not know the encoding.
  if (reinterpret_cast<std::intptr_t>(converter) == -1) return std::nullopt;
  std::string in(bytes), out(3 * bytes.size() + 4, '\0');
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  const bool is_whole = iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (!is_whole) return std::nullopt;
  out.resize(out.size() - room);
  return out;
}

// How many letters of names of quantities a text has that ASCII lacks: "Zeit" counts nothing, "время"
// five.
std::size_t n_known_letters(const std::string& text) {
  const std::string lower = lower_case(text);
  std::size_t count = 0;
  for (const ColumnKind& kind : column_kinds()) {
    for (const char* alias : kind.aliases) {
      const std::string_view name = alias;
      const auto n_letters =
          static_cast<std::size_t>(std::count_if(name.begin(), name.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xc0) == 0xc0;
          }));
      if (n_letters > 0 && lower.find(name) != std::string::npos) count += n_letters;
    }
  }
  return count;
}

// What neither Unicode nor plain ASCII is: the encoding in which most names of quantities are known; without
// any, Chinese if bytes above 0x7f come in pairs only, else Latin-1, in which old instruments write the micro
// sign.
std::string from_old_encoding(std::string_view bytes) {
  constexpr std::size_t kHead = 8192;  // notes and header
  const std::string_view whole_lines = bytes.substr(0, bytes.rfind('\n', kHead));
  const std::string_view head = whole_lines.substr(0, std::min(whole_lines.size(), kHead));
  const char* best =
      has_pairs_only(bytes) && from_encoding(bytes, "GB18030") ? "GB18030" : "ISO-8859-1";
  std::size_t most = 0;
  for (const char* encoding :
       {"ISO-8859-1", "GB18030", "CP932", "CP1251", "CP1250", "KOI8-R", "BIG5"}) {
    const auto text = from_encoding(head, encoding);
    const std::size_t count = text ? n_known_letters(*text) : 0;
    if (count <= most || !from_encoding(bytes, encoding)) continue;
    most = count;
    best = encoding;
  }
  return from_encoding(bytes, best).value_or(std::string());
}

}  // namespace

std::string_view utf8_view(std::string_view bytes, const std::string& name,
                           std::string& converted) {
  if (const auto is_big_endian = is_big_endian_utf16(bytes)) {
    converted = from_utf16(bytes, *is_big_endian);
    if (converted.rfind("\xef\xbb\xbf", 0) == 0) converted.erase(0, 3);
    if (converted.find('\0') == std::string::npos) return converted;
  }
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  if (bytes.find('\0') != std::string_view::npos) {
    throw std::runtime_error(name +
                             ": is not a text table (it contains NUL bytes); export it as CSV");
  }
  if (is_utf8(bytes)) return bytes;
  converted = from_old_encoding(bytes);
  return converted;
}

}  // namespace viscard
