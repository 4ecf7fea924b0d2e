#include "io/cards/named_material.h"

#include "io/basics/patterns.h"
#include "io/basics/words.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/unread_tokens.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

// A material, or a part of one that names its number alone (/VISC/PRONY/1, *MAT_ADD_EROSION).
struct FoundMaterial {
  std::string name, number;
  std::vector<int> lines;  // from 1

  bool is(const std::string& wanted) const { return wanted == name || wanted == number; }
};
using Materials = std::vector<FoundMaterial>;

Materials keyword_materials(const std::string& text, char mark) {
  Materials out;
  for (const CardLine& line : material_lines(card_lines(text, mark == '*' ? "**" : "#"), mark)) {
    const std::string word = upper(trimmed(line.text));
    if (word.rfind(std::string(1, mark) + "MATERIAL", 0) == 0)
      out.push_back({keyword_blocks({line}, mark).front().name(), "", {}});
    if (!out.empty()) out.back().lines.push_back(line.number);
  }
  return out;
}

Materials febio_materials(const std::string& text) {
  Materials out;
  bool is_inside = false;
  for (const CardLine& line : card_lines(text, "\n")) {
    if (line.text.find("<material ") != std::string::npos) {
      const auto name = first_match(line.text, "name\\s*=\\s*[\"']([^\"']*)"),
                 id = first_match(line.text, "\\sid\\s*=\\s*[\"']([^\"']*)");
      out.push_back({name ? name->group[1] : "", id ? id->group[1] : "", {}});
      is_inside = true;
    }
    if (is_inside) out.back().lines.push_back(line.number);
    is_inside = is_inside && line.text.find("</material>") == std::string::npos;
  }
  return out;
}

Materials dyna_materials(const std::string& text) {
  Materials out;
  bool is_inside = false, wants_title = false, wants_number = false;
  for (const CardLine& line : card_lines(text, "$")) {
    const std::string word = upper(trimmed(line.text));
    if (word.rfind('*', 0) == 0) {
      is_inside = wants_number = word.rfind("*MAT_", 0) == 0;
      wants_title = is_inside && word.find("_TITLE") != std::string::npos;
      if (is_inside) out.emplace_back();
    } else if (wants_title) {
      out.back().name = trimmed(line.text);
      wants_title = false;
    } else if (wants_number) {
      const std::string_view row = trimmed(line.text);
      out.back().number = row.substr(0, row.find_first_of(" ,"));
      wants_number = false;
    }
    if (is_inside) out.back().lines.push_back(line.number);
  }
  return out;
}

Materials radioss_materials(const std::string& text) {
  Materials out;
  bool is_inside = false, wants_title = false;
  for (const CardLine& line : card_lines(text, "#")) {
    const std::string word = upper(trimmed(line.text));
    if (word.rfind('/', 0) == 0) {
      const auto parts = cells(word, '/');  // "", MAT, LAW40, 1, 2
      wants_title = parts.size() > 3 && parts[1] == "MAT";
      is_inside = wants_title || (parts.size() > 3 && (parts[1] == "VISC" || parts[1] == "FAIL"));
      if (is_inside) out.push_back({"", parts[3], {}});
    } else if (wants_title) {
      out.back().name = trimmed(line.text);
      wants_title = false;
    }
    if (is_inside) out.back().lines.push_back(line.number);
  }
  return out;
}

// Materials have numbers; TBDATA and the like belong to the TB before.
Materials ansys_materials(const std::string& text) {
  Materials out;
  std::string number;
  for (const CardLine& line : card_lines(text, "!")) {
    const auto row = cells(line.text.substr(0, line.text.find('!')), ',');
    const std::string command = upper(row[0]).substr(0, 4);
    const bool is_export = row.size() > 4 && command == "MPDA" && upper(row[1]).rfind('R', 0) == 0;
    if (command == "MP" || command == "TB" || command == "MPDA")
      number = row.size() > 4 && is_export ? row[4] : row.size() > 2 ? row[2] : "";
    else if (command != "TBDA" && command != "TBTE" && command != "TBPT")
      continue;
    const auto known = std::find_if(out.begin(), out.end(),
                                    [&](const FoundMaterial& one) { return one.number == number; });
    FoundMaterial& material = known == out.end() ? out.emplace_back() : *known;
    material.number = number;
    material.lines.push_back(line.number);
  }
  return out;
}

Materials comsol_materials(const std::string& text) {
  Materials out;
  for (const CardLine& line : card_lines(text, "%")) {
    // Other parameters of a model have other endings.
    const auto row = first_match(
        line.text, "^\\s*(\\w+)_(?:Einf|E|nu|mu|C10|C01|kappa|rho|G\\d*|g\\d*|K\\d*|tau\\d*)\\s");
    if (!row) continue;
    const auto known = std::find_if(out.begin(), out.end(), [&](const FoundMaterial& one) {
      return one.name == row->group[1];
    });
    FoundMaterial& material = known == out.end() ? out.emplace_back() : *known;
    material.name = row->group[1];
    material.lines.push_back(line.number);
  }
  return out;
}

// Nothing for a target whose materials are not told apart.
std::optional<Materials> materials_in(const std::string& text, const std::string& target) {
  if (target == "frontistr") return keyword_materials(text, '!');
  if (target == "calculix" || target.rfind("abaqus", 0) == 0) return keyword_materials(text, '*');
  if (target.rfind("febio", 0) == 0) return febio_materials(text);
  if (target.rfind("lsdyna", 0) == 0) return dyna_materials(text);
  if (target == "openradioss") return radioss_materials(text);
  if (target == "ansys") return ansys_materials(text);
  if (target.rfind("comsol", 0) == 0) return comsol_materials(text);
  return std::nullopt;
}

const char* comment_of(const std::string& target) {
  if (target.rfind("febio", 0) == 0) return "";
  if (target.rfind("lsdyna", 0) == 0) return "$";
  if (target.rfind("comsol", 0) == 0) return "%";
  if (target == "ansys") return "!";
  return target == "frontistr" || target == "openradioss" ? "#" : "**";
}

}  // namespace

std::vector<std::string> material_names(const std::string& text, const std::string& target) {
  std::vector<std::string> out, numbers;
  for (const FoundMaterial& one : materials_in(text, target).value_or(Materials{})) {
    const std::string& name = one.name.empty() ? one.number : one.name;
    const bool is_part =
        one.name.empty() && std::find(numbers.begin(), numbers.end(), one.number) != numbers.end();
    if (!name.empty() && !is_part) out.push_back(name);
    numbers.push_back(one.number);
  }
  return out;
}

std::string material_named(const std::string& text, const std::string& target,
                           const std::string& name) {
  const auto found = materials_in(text, target);
  if (!found)
    throw std::invalid_argument("materials in files for " + target +
                                " are not distinguished by name");
  const Materials& all = *found;
  const auto is_overlay = [&](const FoundMaterial& one) {
    return target == "calculix" && one.name.rfind(name + "_", 0) == 0;
  };
  const auto wanted = std::find_if(all.begin(), all.end(), [&](const FoundMaterial& one) {
    return one.is(name) || is_overlay(one);
  });
  if (wanted == all.end()) {
    const auto names = material_names(text, target);
    throw std::invalid_argument("there is no material '" + name + "'; " +
                                (names.empty() ? std::string("the file has none with a name")
                                               : "the file has " + listed(names)));
  }
  std::vector<std::string> lines;
  for (const std::string_view line : split(text, '\n')) lines.emplace_back(line);
  for (const FoundMaterial& one : all) {
    const bool is_same_number = !wanted->number.empty() && one.number == wanted->number;
    if (&one == &*wanted || is_overlay(one) || is_same_number) continue;
    for (const int number : one.lines)
      lines[static_cast<std::size_t>(number) - 1] = comment_of(target);
  }
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  out.pop_back();
  return out;
}

}  // namespace viscard
