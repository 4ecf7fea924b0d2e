#include "io/cards/unread_tokens.h"

#include "io/basics/patterns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kToken = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eEdD][-+]?\\d+)?|[A-Za-z_][\\w-]*";

bool is_word(const std::string& token) {
  return std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_';
}

// Of the same length, so that columns stay: another first letter, or another leading digit.
std::string changed(std::string token) {
  for (char& c : token) {
    if (is_word(token)) {
      c = c == 'Q' || c == 'q' ? 'Z' : 'Q';
      return token;
    }
    if (c >= '1' && c <= '9') {
      c = c == '9' ? '1' : static_cast<char>(c + 1);
      return token;
    }
  }
  return token;  // a zero
}

// Where the lines of a text begin, from the first.
std::vector<std::size_t> line_starts(const std::string& text) {
  std::vector<std::size_t> out{0};
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    out.push_back(at + 1);
  return out;
}

bool is_model_keyword(const std::string& keyword) {
  static const std::array<const char*, 34> kWords{
      "NODE",     "ELEMENT",     "NSET",        "ELSET",   "SOLID",    "SHELL",    "SECTION",
      "BOUNDARY", "STEP",        "AMPLITUDE",   "PART",    "ASSEMBLY", "INSTANCE", "END",
      "HEADING",  "PREPRINT",    "SURFACE",     "INITIAL", "PHYSICAL", "STATIC",   "VISCO",
      "CLOAD",    "DLOAD",       "OUTPUT",      "NGROUP",  "EGROUP",   "SOLUTION", "WRITE",
      "SOLVER",   "TEMPERATURE", "ORIENTATION", "CONTACT", "RESTART",  "VERSION"};
  return std::any_of(kWords.begin(), kWords.end(),
                     [&](const char* word) { return keyword.rfind(word, 0) == 0; });
}

}  // namespace

std::vector<CardLine> material_lines(const std::vector<CardLine>& lines, char mark) {
  const auto keyword_of = [&](const CardLine& line) {
    const std::string_view text = trimmed(line.text);
    return text.empty() || text[0] != mark ? std::string() : upper(text.substr(1));
  };
  const bool has_material = std::any_of(lines.begin(), lines.end(), [&](const CardLine& line) {
    return keyword_of(line).rfind("MATERIAL", 0) == 0;
  });
  std::vector<CardLine> out;
  bool is_inside = !has_material;
  for (const CardLine& line : lines) {
    const std::string keyword = keyword_of(line);
    if (!keyword.empty())
      is_inside = keyword.rfind("MATERIAL", 0) == 0 || (is_inside && !is_model_keyword(keyword));
    if (is_inside) out.push_back(line);
  }
  return out;
}

std::vector<std::string> unread_tokens(
    const std::string& text, const std::vector<CardLine>& lines,
    const std::vector<std::string>& neutral,
    const std::function<std::string(const std::string&)>& reading) {
  constexpr std::size_t kMostLines = 200;  // a material has fewer; a model would take minutes
  const std::vector<std::size_t> starts = line_starts(text);
  const std::string right = reading(text);
  std::vector<std::string> out;
  for (std::size_t n = 0; n < std::min(lines.size(), kMostLines); ++n) {
    const CardLine& line = lines[n];
    if (line.number < 1 || static_cast<std::size_t>(line.number) > starts.size()) continue;
    const std::size_t start = starts[static_cast<std::size_t>(line.number) - 1];
    std::string unread;
    std::size_t n_tokens = 0, n_unread = 0;
    for (const Match& match : all_matches(line.text, kToken)) {
      const std::string& token = match.group[0];
      const std::string other = changed(token);
      if (other == token ||
          std::find(neutral.begin(), neutral.end(), upper(token)) != neutral.end())
        continue;
      ++n_tokens;
      std::string edited = text;
      edited.replace(start + match.at[0], token.size(), other);
      try {
        if (reading(edited) != right) continue;
      } catch (const std::exception&) {
        continue;
      }
      ++n_unread;
      unread += (unread.empty() ? "'" : ", '") + token + "'";
    }
    if (n_unread == 0) continue;
    out.push_back(
        at_line(line, n_unread == n_tokens ? "'" + std::string(trimmed(line.text)) + "'" : unread));
  }
  return out;
}

}  // namespace viscard
