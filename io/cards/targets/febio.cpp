// FEBio viscoelastic, uncoupled viscoelastic. Sources: FEViscoElasticMaterial.cpp, FEBio 4 format.
#include "io/basics/patterns.h"
#include "io/cards/deck.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/named_values.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

std::string tag(const char* name, double value) {
  return fmt::format("<{0}>{1}</{0}>", name, value);
}

// The stress is g0 times the elastic child's plus a branch for each g_i, so g0 = 1 - sum g beside
// an instantaneous child; g0 defaults to 1. The uncoupled form relaxes the deviatoric part alone;
// Mooney-Rivlin with c2 = 0 has G = 2 c1.
std::string write_febio(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const bool is_uncoupled = body.target.elastic == ElasticForm::kBulkShear;
  std::string out = fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n", body.name,
                                is_uncoupled ? "uncoupled viscoelastic" : "viscoelastic");
  out += "  " + tag("g0", numbers.equilibrium) + "\n";
  for (std::size_t i = 0; i < numbers.branches.size(); ++i) {
    out += fmt::format("  <g{0}>{1}</g{0}><t{0}>{2}</t{0}>\n", i + 1, numbers.branches[i].shear,
                       numbers.branches[i].time);
  }
  // FEBio takes the bulk modulus of an uncoupled material from its top level and warns that it
  // ignores that of the child.
  if (is_uncoupled) out += "  " + tag("k", numbers.bulk) + "\n";
  out += is_uncoupled ? "  <elastic type=\"Mooney-Rivlin\">\n    "
                      : "  <elastic type=\"isotropic elastic\">\n    ";
  if (numbers.density > 0.0) out += tag("density", numbers.density);
  if (is_uncoupled) {
    out += tag("c1", 0.5 * numbers.shear) + "<c2>0</c2>";
  } else {
    out += tag("E", numbers.young) + tag("v", numbers.poisson);
  }
  return out + "\n  </elastic>\n</material>\n";
}

// XML without its comments; the newlines stay, so that line numbers are right.
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
  const auto match = first_match(text, "<" + tag + "(\\s[^>]*)?>([^<]*)</" + tag + ">");
  if (!match) return std::nullopt;
  return card_number(std::string(trimmed(match->group[2])), line_of(text, match->at[2]), tag);
}

double required_tag(const std::string& text, const std::string& tag) {
  const std::optional<double> value = tag_value(text, tag);
  if (!value) throw std::runtime_error("the card has no <" + tag + ">");
  return *value;
}

// The first viscoelastic material as a separate text, with the newlines before it. If there is
// none, the whole text: the reader then reports the type that it finds.
std::string viscoelastic_material(const std::string& text) {
  const auto match =
      first_match(text, "<material\\s[^>]*type\\s*=\\s*[\"'](uncoupled )?viscoelastic[\"']");
  if (!match) return text;
  const std::size_t begin = match->at[0];
  const std::size_t end = text.find("</material>", begin);
  const std::string before(static_cast<std::size_t>(line_of(text, begin).number - 1), '\n');
  return before + text.substr(begin, end == std::string::npos ? end : end - begin);
}

// Throws unless every opened element of the text is closed in order.
void check_nesting(const std::string& text) {
  std::vector<std::string> open;
  for (const Match& match : all_matches(text, "<(/?)([A-Za-z_][\\w.-]*)([^<>]*)>")) {
    const bool is_single = !match.group[3].empty() && match.group[3].back() == '/';
    if (is_single) continue;
    if (match.group[1].empty()) {
      open.push_back(match.group[2]);
    } else if (open.empty() || open.back() != match.group[2]) {
      throw std::runtime_error(
          at_line(line_of(text, match.at[0]), "</" + match.group[2] + "> closes no open element"));
    } else {
      open.pop_back();
    }
  }
  if (!open.empty()) throw std::runtime_error("<" + open.back() + "> is not closed");
}

// The material without its elastic child, and the child.
struct FebioParts {
  std::string outside, child;
};

FebioParts parts_of(const std::string& text) {
  const std::size_t begin = text.find("<elastic"), end = text.find("</elastic>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {text, ""};
  return {text.substr(0, begin) + text.substr(end), text.substr(begin, end - begin)};
}

// The elastic child decides what its numbers mean.
void check_child(const std::string& text, const char* wanted, ReadCard& card) {
  const auto child = first_match(text, "<elastic\\s[^>]*type\\s*=\\s*[\"']([^\"']*)[\"']");
  if (child && child->group[1] == wanted) return;
  card.add("elastic-type", "the elastic child is '" + (child ? child->group[1] : std::string()) +
                               "'; its numbers are read as those of '" + wanted + "'");
}

void read_child(const FebioParts& parts, const std::string& type, ReadCard& card) {
  const std::string& text = parts.child;
  if (type == "uncoupled viscoelastic") {
    card.understood = febio_uncoupled_target();
    check_child(text, "Mooney-Rivlin", card);
    card.numbers.shear = 2.0 * (required_tag(text, "c1") + tag_value(text, "c2").value_or(0.0));
    const auto outer = tag_value(parts.outside, "k"), inner = tag_value(text, "k");
    if (!outer && !inner) throw std::runtime_error("the card has no <k>");
    card.numbers.bulk = outer.value_or(inner.value_or(0.0));
    if (inner) {
      card.add("bulk-in-child",
               "<k> stands in the elastic child; FEBio 4 takes that of the top level and warns",
               outer.has_value());
    }
  } else if (type == "viscoelastic") {
    card.understood = febio_target();
    check_child(text, "isotropic elastic", card);
    card.numbers.young = required_tag(text, "E");
    card.numbers.poisson = required_tag(text, "v");
  } else {
    throw std::runtime_error("the material is of type '" + type +
                             "'; only 'viscoelastic' and 'uncoupled viscoelastic' can be read");
  }
}

void read_febio(const std::string& commented, ReadCard& card) {
  (void)card_lines(commented, "\n");  // refuses lines that are too long to match
  const std::string whole = without_xml_comments(commented);
  check_nesting(whole);
  check_single_element(whole, "<material\\s[^>]*type\\s*=\\s*[\"'](uncoupled )?viscoelastic[\"']",
                       "<material> of a viscoelastic type", card);
  std::string text = viscoelastic_material(whole);
  const auto type = first_match(text, "<material\\s[^>]*type\\s*=\\s*[\"']([^\"']*)[\"']");
  if (!type) throw std::runtime_error("the card has no <material type=\"...\">");
  const FebioParts parts = parts_of(text);
  read_child(parts, type->group[1], card);
  const auto name = first_match(text, "<material\\s[^>]*name\\s*=\\s*[\"']([^\"']*)[\"']");
  if (name) card.name = name->group[1];
  card.numbers.density =
      tag_value(parts.child, "density").value_or(tag_value(text, "density").value_or(0.0));
  text = parts.outside;
  double sum = 0.0;
  for (int i = 1; i <= 6; ++i) {
    const double g = tag_value(text, "g" + std::to_string(i)).value_or(0.0);
    if (g == 0.0) continue;
    card.numbers.branches.push_back(
        {g, 0.0, tag_value(text, "t" + std::to_string(i)).value_or(1.0)});
    sum += g;
  }
  if (tag_value(text, "g7")) card.add("too-many-terms", "FEBio reads g1 to g6 only; g7 is ignored");
  const std::optional<double> g0 = tag_value(text, "g0");
  card.numbers.equilibrium = g0.value_or(1.0);
  if (g0 || !(sum > 0.0)) return;
  card.add(
      "g0-default",
      "g0 is not given, so FEBio takes 1: the modulus at t = 0 is (1 + sum g) times that of the "
      "elastic child",
      false);
}

// The unit cube and its rollers.
std::string febio_mesh(const std::string& material) {
  std::string out = "<Mesh>\n<Nodes name=\"nodes\">\n";
  int id = 0;
  for (const auto& [x, y, z] : kCubeCorners) {
    out += fmt::format("<node id=\"{}\">{},{},{}</node>\n", ++id, x, y, z);
  }
  out +=
      "</Nodes>\n<Elements type=\"hex8\" name=\"cube\"><elem id=\"1\">1,2,3,4,5,6,7,8</elem>"
      "</Elements>\n<NodeSet name=\"x0\">1,4,5,8</NodeSet>\n<NodeSet "
      "name=\"y0\">1,2,5,6</NodeSet>\n"
      "<NodeSet name=\"z0\">1,2,3,4</NodeSet>\n<NodeSet name=\"z1\">5,6,7,8</NodeSet>\n</Mesh>\n"
      "<MeshDomains><SolidDomain name=\"cube\" mat=\"" +
      material + "\"/></MeshDomains>\n<Boundary>\n";
  for (const char axis : {'x', 'y', 'z'}) {
    out += fmt::format(
        "<bc name=\"fix {0}\" node_set=\"{0}0\" type=\"zero displacement\">"
        "<x_dof>{1}</x_dof><y_dof>{2}</y_dof><z_dof>{3}</z_dof></bc>\n",
        axis, axis == 'x' ? 1 : 0, axis == 'y' ? 1 : 0, axis == 'z' ? 1 : 0);
  }
  return out;
}

// Closes <Boundary>.
std::string pull(const DeckInput& input) {
  const std::string pulled =
      input.is_creep()
          ? fmt::format(
                "</Boundary>\n<Loads>\n<nodal_load name=\"pull\" node_set=\"z1\" "
                "type=\"nodal_load\"><dof>z</dof><scale lc=\"1\">{}</scale></nodal_load>\n"
                "</Loads>\n",
                input.pull())
          : fmt::format(
                "<bc name=\"pull\" node_set=\"z1\" type=\"prescribed displacement\">"
                "<dof>z</dof><value lc=\"1\">{}</value><relative>0</relative></bc>\n"
                "</Boundary>\n",
                input.pull());
  return pulled + fmt::format(
                      "<LoadData><load_controller id=\"1\" type=\"loadcurve\">"
                      "<interpolate>LINEAR</interpolate><extend>CONSTANT</extend>"
                      "<points><pt>0,0</pt><pt>{},1</pt><pt>{},1</pt></points></load_controller>"
                      "</LoadData>\n",
                      input.ramp(), 2.0 * input.end());
}

// Every <step> has its own <Control>; steps follow each other.
std::string steps(const DeckInput& input) {
  std::string out = "<Step>\n";
  int id = 0;
  for (const DeckBlock& block : input.blocks()) {
    out += fmt::format(
        "<step id=\"{0}\" name=\"block {0}\"><Control><analysis>STATIC</analysis>"
        "<time_steps>{1}</time_steps><step_size>{2}</step_size>"
        "<solver type=\"solid\"><dtol>1e-9</dtol><etol>1e-12</etol><rtol>0</rtol>"
        "</solver></Control></step>\n",
        ++id, block.increments, block.step);
  }
  return out + "</Step>\n";
}

std::vector<DeckFile> febio_deck(const DeckInput& input, const std::string& name) {
  return {{name + ".feb",
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
           "<Module type=\"solid\"/>\n<Material>\n" +
               input.card.text + "</Material>\n" + febio_mesh(input.card.name) + pull(input) +
               steps(input) + "<Output><logfile>" +
               (input.is_creep() ? "<node_data data=\"uz\" file=\"uz.txt\">7</node_data>"
                                 : "<element_data data=\"sz\" file=\"sz.txt\">1</element_data>") +
               "</logfile></Output>\n</febio_spec>\n"}};
}

// Inserted before "E-for-G", which it equals at nu = 0.
void add_uncoupled_mistakes(const CardContext&, std::vector<CardMistake>& list) {
  const auto at = std::find_if(list.begin(), list.end(), [](const CardMistake& mistake) {
    return mistake.name == "G-for-E";
  });
  list.insert(at, {"G-for-c1", "c1 is the shear modulus; c1 of a Mooney-Rivlin child is half of it",
                   [](CardNumbers& n) { n.shear *= 2.0; }});
}

}  // namespace

CardTarget febio_target() {
  return {.name = "febio",
          .code = "FEBio viscoelastic",
          .extension = ".feb",
          .comment = "<!--",
          .write = write_febio,
          .read = read_febio,
          .deck = DeckWriter{febio_deck, "febio4 -i {}.feb"},
          .bulk = BulkRule::kConstantPoisson,
          .states_equilibrium = true,
          .max_terms = 6,
          .evidence = Evidence::kRun,
          .evidence_note = "FEBio 4 on one element, ramp and hold: 1.5e-9",
          .advice = "Paste the element into <Material>; g0 must stay, FEBio's default is 1."};
}

CardTarget febio_uncoupled_target() {
  CardTarget target = febio_target();
  target.name = "febio-uncoupled";
  target.code = "FEBio uncoupled viscoelastic";
  target.add_mistakes = add_uncoupled_mistakes;
  target.elastic = ElasticForm::kBulkShear;
  target.bulk = BulkRule::kConstantBulk;
  target.evidence_note = "FEBio 4 on one element, ramp and hold: 2.2e-9";
  return target;
}

}  // namespace viscard
