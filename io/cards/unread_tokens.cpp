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

using Words = std::vector<std::string>;

// Whether the words of a keyword begin with those of the model, not of the material: "STATIC" of "STATIC, DIRECT".
bool is_one_of(const std::string& keyword, const Words& model) {
  const std::string first = keyword.substr(0, keyword.find_first_of(" ,_/+\t"));
  return std::find(model.begin(), model.end(), first) != model.end();
}

bool is_model_keyword(const std::string& keyword) {
  static const Words kWords{
      "NODE",     "ELEMENT",     "NSET",        "ELSET",   "SOLID",    "SHELL",    "SECTION",
      "BOUNDARY", "STEP",        "AMPLITUDE",   "PART",    "ASSEMBLY", "INSTANCE", "END",
      "HEADING",  "PREPRINT",    "SURFACE",     "INITIAL", "PHYSICAL", "STATIC",   "VISCO",
      "CLOAD",    "DLOAD",       "OUTPUT",      "NGROUP",  "EGROUP",   "SOLUTION", "WRITE",
      "SOLVER",   "TEMPERATURE", "ORIENTATION", "CONTACT", "RESTART",  "VERSION",  "EL",
      "FILE",     "SGROUP",      "EQUATION",    "RIGID",   "COUPLING", "DYNAMIC",  "CONTROLS"};
  return is_one_of(keyword, kWords);
}

// Keywords of a model of LS-DYNA and of OpenRadioss: the rest may change the stress.
const Words kDynaModel{"KEYWORD",     "NODE",      "ELEMENT",   "PART",      "SECTION",   "SET",
                       "BOUNDARY",    "LOAD",      "DEFINE",    "CONTROL",   "DATABASE",  "END",
                       "TITLE",       "CASE",      "INITIAL",   "HOURGLASS", "PARAMETER", "CONTACT",
                       "CONSTRAINED", "RIGIDWALL", "INTERFACE", "COMMENT"};
const Words kRadiossModel{"BEGIN",  "NODE",   "BRICK",   "SHELL",   "PART",   "PROP",  "GRNOD",
                          "GRBRIC", "BCS",    "FUNCT",   "IMPDISP", "IMPVEL", "CLOAD", "TH",
                          "END",    "TITLE",  "SUBSET",  "SURF",    "SKEW",   "FRAME", "ANALY",
                          "DEF",    "IOFLAG", "SPMD",    "INTER",   "RWALL",  "GRAV",  "INIVEL",
                          "SENSOR", "TETRA4", "TETRA10", "RBODY"};

// Of a file in columns: the rows of its material, and the lines of keywords that no reader knows.
std::vector<CardLine> column_lines(const std::vector<CardLine>& lines, bool is_dyna) {
  std::vector<CardLine> out;
  bool is_inside = false, is_title = false;
  for (const CardLine& line : lines) {
    const std::string word = upper(trimmed(line.text));
    if (!word.empty() && word[0] == (is_dyna ? '*' : '/')) {
      const std::string keyword = word.substr(1);
      const bool is_added = is_dyna && keyword.rfind("MAT_ADD", 0) == 0;
      const bool is_damage = !is_dyna && keyword.rfind("FAIL/MULLINS_OR/", 0) == 0;
      is_inside = !is_added && (keyword.rfind(is_dyna ? "MAT_" : "MAT/", 0) == 0 || is_damage ||
                                (!is_dyna && keyword.rfind("UNIT/", 0) == 0));
      is_title = is_inside && !is_damage && (!is_dyna || word.find("_TITLE") != std::string::npos);
      if (is_damage) out.push_back(line);
      if (!is_inside && !is_one_of(keyword, is_dyna ? kDynaModel : kRadiossModel))
        out.push_back(line);
      continue;
    }
    if (is_inside && !is_title) out.push_back(line);
    is_title = false;
  }
  return out;
}

struct AccountedLines {
  std::vector<CardLine> lines;
  Words neutral;  // in upper case: words that say what is so anyway
};

AccountedLines accounted_lines(const std::string& text, const std::string& target) {
  AccountedLines out;
  const bool is_frontistr = target == "frontistr", is_dyna = target.rfind("lsdyna", 0) == 0;
  if (target == "ansys") {
    out.neutral = {"1", "R5"};
    for (CardLine line : card_lines(text, "!")) {
      line.text = line.text.substr(0, line.text.find('!'));
      const std::string command = upper(trimmed(line.text)).substr(0, 4);
      const bool is_table = command.rfind("TB", 0) == 0 || command.rfind("MP", 0) == 0;
      // A temperature that no second one stands beside says nothing.
      if (is_table && command != "TBTE" && command != "MPTE") out.lines.push_back(line);
    }
  } else if (is_dyna || target == "openradioss") {
    out.lines = column_lines(card_lines(text, is_dyna ? "$" : "#"), is_dyna);
    // The number of the material of LS-DYNA, in columns of any width or before a comma.
    const std::string_view first = out.lines.empty() ? "" : trimmed(out.lines.front().text);
    if (is_dyna && !first.starts_with('*'))
      out.neutral = {std::string(first.substr(0, first.find_first_of(" ,")))};
  } else if (is_frontistr || target == "calculix" || target.rfind("abaqus", 0) == 0) {
    out.neutral = {"N",    "TYPE", "ISOTROPIC",     "ISO",     "MODULI", "INSTANTANEOUS",
                   "LONG", "TERM", "INFINITESIMAL", "INFINITE"};
    // Densities of overlaid materials that add nothing to that of the first.
    if (target == "calculix") out.neutral.insert(out.neutral.end(), {"DENSITY", "1E-30", "1.E-30"});
    out.lines =
        material_lines(card_lines(text, is_frontistr ? "#" : "**"), is_frontistr ? '!' : '*');
    std::erase_if(out.lines, [](const CardLine& line) {
      const std::string word = upper(trimmed(line.text));
      return word.rfind("*MATERIAL", 0) == 0 || word.rfind("!MATERIAL", 0) == 0 ||
             word.rfind("!!", 0) == 0;
    });
    if (target != "abaqus-table") return out;
    // The rows of a table over frequency are read to their last number.
    bool is_row = false;
    std::erase_if(out.lines, [&](const CardLine& line) {
      const std::string word = upper(trimmed(line.text));
      const bool is_keyword = word.rfind('*', 0) == 0;
      if (is_keyword) is_row = word.rfind("*VISCOELASTIC", 0) == 0;
      return is_row && !is_keyword;
    });
  }
  return out;
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
    const std::string& text, const std::string& target,
    const std::function<std::string(const std::string&)>& reading) {
  const auto [lines, neutral] = accounted_lines(text, target);
  if (lines.empty()) return {};
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
