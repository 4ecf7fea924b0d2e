// Readers of FEBio, MFront, MOOSE and JSON texts.
#include "io/cards/card_lines.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <regex>
#include <stdexcept>

namespace viscard {
namespace {

CardLine line_of(const std::string& text, std::size_t at) {
  const auto newlines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return {static_cast<int>(newlines) + 1, ""};
}

// XML without its comments, newlines kept so that line numbers hold.
std::string without_xml_comments(std::string text) {
  for (std::size_t at = text.find("<!--"); at != std::string::npos; at = text.find("<!--", at)) {
    const std::size_t end = text.find("-->", at);
    const std::size_t stop = end == std::string::npos ? text.size() : end + 3;
    for (std::size_t i = at; i < stop; ++i) {
      if (text[i] != '\n') text[i] = ' ';
    }
  }
  return text;
}

// The number in <tag ...>number</tag>.
std::optional<double> tag_value(const std::string& text, const std::string& tag) {
  const std::regex pattern("<" + tag + "(\\s[^>]*)?>([^<]*)</" + tag + ">");
  std::smatch match;
  if (!std::regex_search(text, match, pattern)) return std::nullopt;
  return card_number(trimmed(match[2].str()),
                     line_of(text, static_cast<std::size_t>(match.position(2))), tag);
}

double required_tag(const std::string& text, const std::string& tag) {
  const std::optional<double> value = tag_value(text, tag);
  if (!value) throw std::runtime_error("the card has no <" + tag + ">");
  return *value;
}

void read_febio_child(const std::string& text, ReadCard& card) {
  const bool is_uncoupled = card.understood.elastic == ElasticForm::kBulkShear;
  if (!is_uncoupled) {
    card.numbers.young = required_tag(text, "E");
    card.numbers.poisson = required_tag(text, "v");
    return;
  }
  card.numbers.shear = 2.0 * (required_tag(text, "c1") + tag_value(text, "c2").value_or(0.0));
  card.numbers.bulk = required_tag(text, "k");
}

}  // namespace

// The first viscoelastic material, as a text of its own; all of the text when there is none, so
// that the reader says what it found instead. Newlines before it are kept.
std::string viscoelastic_material(const std::string& text) {
  const std::regex one("<material\\s[^>]*type\\s*=\\s*[\"'](uncoupled )?viscoelastic[\"']");
  std::smatch match;
  if (!std::regex_search(text, match, one)) return text;
  const auto begin = static_cast<std::size_t>(match.position(0));
  const std::size_t end = text.find("</material>", begin);
  const std::string before(static_cast<std::size_t>(line_of(text, begin).number - 1), '\n');
  return before + text.substr(begin, end == std::string::npos ? end : end - begin);
}

void read_febio(const std::string& commented, ReadCard& card) {
  const std::string text = viscoelastic_material(without_xml_comments(commented));
  std::smatch match;
  if (!std::regex_search(text, match,
                         std::regex("<material\\s[^>]*type\\s*=\\s*[\"']([^\"']*)[\"']"))) {
    throw std::runtime_error("the card has no <material type=\"...\">");
  }
  const std::string type = match[1].str();
  if (type == "uncoupled viscoelastic") {
    card.understood = card_target("febio-uncoupled");
  } else if (type == "viscoelastic") {
    card.understood = card_target("febio");
  } else {
    throw std::runtime_error("the material is of type '" + type +
                             "'; only 'viscoelastic' and 'uncoupled viscoelastic' can be read");
  }
  if (std::regex_search(text, match,
                        std::regex("<material\\s[^>]*name\\s*=\\s*[\"']([^\"']*)[\"']"))) {
    card.name = match[1].str();
  }
  read_febio_child(text, card);
  card.numbers.density = tag_value(text, "density").value_or(0.0);
  double sum = 0.0;
  for (int i = 1; i <= 6; ++i) {
    const double g = tag_value(text, "g" + std::to_string(i)).value_or(0.0);
    if (g == 0.0) continue;
    card.numbers.branches.push_back(
        {g, 0.0, tag_value(text, "t" + std::to_string(i)).value_or(1.0)});
    sum += g;
  }
  if (tag_value(text, "g7")) {
    card.findings.push_back({"too-many-terms", "FEBio reads g1 to g6 only; g7 is ignored", true});
  }
  const std::optional<double> g0 = tag_value(text, "g0");
  card.numbers.equilibrium = g0.value_or(1.0);
  if (!g0 && sum > 0.0) {
    card.findings.push_back(
        {"g0-default",
         "g0 is not given, so FEBio takes 1: the modulus at t = 0 is (1 + sum g) "
         "times that of the elastic child",
         false});
  }
}

namespace {

std::vector<double> numbers_in(const std::string& list, const CardLine& line) {
  std::vector<double> out;
  const std::regex word("[^\\s,{}'\"]+");
  for (std::sregex_iterator it(list.begin(), list.end(), word), end; it != end; ++it) {
    out.push_back(card_number(it->str(), line, "number"));
  }
  return out;
}

using Named = std::map<std::string, std::vector<double>>;

// Everything `pattern` finds, its first group the name and its second the list of numbers.
Named named_lists(const std::string& text, const std::string& pattern) {
  Named out;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    out[(*it)[1].str()] =
        numbers_in((*it)[2].str(), line_of(text, static_cast<std::size_t>(it->position(2))));
  }
  return out;
}

double one_of(const Named& named, const std::string& name) {
  const auto found = named.find(name);
  if (found == named.end() || found->second.size() != 1) {
    throw std::runtime_error("the card has no " + name + " (one number)");
  }
  return found->second.front();
}

const std::vector<double>& list_of(const Named& named, const std::string& name,
                                   std::size_t expected) {
  static const std::vector<double> kNone;
  const auto found = named.find(name);
  const std::vector<double>& list = found == named.end() ? kNone : found->second;
  if (list.size() != expected) {
    throw std::runtime_error("the card has " + std::to_string(list.size()) + " numbers in " + name +
                             " where " + std::to_string(expected) + " are expected");
  }
  return list;
}

std::string without_line_comments(const std::string& text, const std::string& comment) {
  std::string out;
  for (const CardLine& line : card_lines(text, "\n")) {
    out += line.text.substr(0, line.text.find(comment)) + "\n";
  }
  return out;
}

void read_gallery(const std::string& text, ReadCard& card) {
  card.understood = mfront_gallery_target();
  const Named named = named_lists(
      text, "@MaterialProperty\\s*<\\s*constant\\s*>\\s*['\"]([^'\"]*)['\"]\\s*([^;]*);");
  card.numbers.bulk = one_of(named, "BulkModulus");
  card.numbers.shear = one_of(named, "ShearModulus");
  for (std::size_t i = 0;; ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    if (named.count("TimeScale" + index) == 0) break;
    card.numbers.branches.push_back({one_of(named, "ViscoelasticShearModulus" + index),
                                     one_of(named, "ViscoelasticBulkModulus" + index),
                                     one_of(named, "TimeScale" + index)});
  }
}

}  // namespace

void read_mfront(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "//");
  if (text.find("@MaterialProperty") != std::string::npos &&
      text.find("ViscoelasticShearModulus[") != std::string::npos) {
    return read_gallery(text, card);
  }
  const Named named =
      named_lists(text, "@Parameter\\s+\\w+\\s+(\\w+)\\s*(?:\\[\\s*\\w+\\s*\\])?\\s*=\\s*([^;]*);");
  std::smatch match;
  if (std::regex_search(text, match, std::regex("@Behaviour\\s+(\\w+)")))
    card.name = match[1].str();
  card.numbers.young = one_of(named, "E0");
  card.numbers.poisson = one_of(named, "nu0");
  const std::size_t count = named.count("tau") > 0 ? named.at("tau").size() : 0;
  const auto& g = list_of(named, "g", count);
  const auto& k = list_of(named, "k", count);
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({g[i], k[i], named.at("tau")[i]});
  }
}

void read_moose(const std::string& commented, ReadCard& card) {
  const std::string text = without_line_comments(commented, "#");
  const Named named = named_lists(
      text,
      "(young_modulus|youngs_modulus|poisson_ratio|poissons_ratio|creep_modulus|"
      "creep_viscosity|creep_ratio|prop_values)\\s*=\\s*('[^']*'|\"[^\"]*\"|[^\\s\\[]+)");
  std::smatch match;
  if (std::regex_search(text, match,
                        std::regex("\\[(?:\\./)?(\\w+)\\]\\s*type\\s*=\\s*(Gen|ComputeIso)"))) {
    card.name = match[1].str();
  }
  const bool is_elastic = named.count("young_modulus") == 0;
  card.numbers.young = one_of(named, is_elastic ? "youngs_modulus" : "young_modulus");
  card.numbers.poisson = one_of(named, is_elastic ? "poissons_ratio" : "poisson_ratio");
  if (std::regex_search(text, std::regex("prop_names\\s*=\\s*['\"]?density"))) {
    card.numbers.density = one_of(named, "prop_values");
  }
  const std::size_t count =
      named.count("creep_viscosity") > 0 ? named.at("creep_viscosity").size() : 0;
  const auto& modulus = list_of(named, "creep_modulus", count);
  for (std::size_t i = 0; i < count; ++i) {
    card.numbers.branches.push_back({modulus[i], 0.0, named.at("creep_viscosity")[i]});
  }
  if (named.count("creep_ratio") > 0) {
    card.findings.push_back({"creep-ratio",
                             "creep_ratio is set; the branches are read with "
                             "poisson_ratio",
                             false});
  }
  if (!is_elastic && text.find("LinearViscoelasticityManager") == std::string::npos) {
    card.findings.push_back({"missing-user-object",
                             "there is no LinearViscoelasticityManager: the coefficients of time "
                             "stepping stay frozen",
                             true});
  }
}

void read_card_json(const std::string& text, ReadCard& card) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.value("schema", "") != "viscard-card/1") {
      throw std::runtime_error("the card is not of schema viscard-card/1");
    }
    card.units = unit_system(json.at("units").at("system").get<std::string>());
    card.units_were_stated = true;
    card.name = json.value("name", "");
    card.numbers.young = json.at("E0").get<double>();
    card.numbers.poisson = json.at("nu").get<double>();
    card.numbers.density = json.value("rho", 0.0);
    const auto g = json.at("g").get<std::vector<double>>(),
               k = json.at("k").get<std::vector<double>>();
    const auto tau = json.at("tau").get<std::vector<double>>();
    if (g.size() != tau.size() || k.size() != tau.size()) {
      throw std::runtime_error("g, k and tau are of different lengths");
    }
    for (std::size_t i = 0; i < g.size(); ++i)
      card.numbers.branches.push_back({g[i], k[i], tau[i]});
    if (json.contains("shift")) {
      const nlohmann::json& shift = json["shift"];
      card.numbers.shift = TemperatureShift{.T_ref_C = shift.at("T_ref_C").get<double>(),
                                            .C1 = shift.at("C1").get<double>(),
                                            .C2_K = shift.at("C2_K").get<double>()};
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(std::string("not a JSON card: ") + error.what());
  }
}

}  // namespace viscard
