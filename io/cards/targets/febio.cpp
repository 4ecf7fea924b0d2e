// FEBio viscoelastic, uncoupled viscoelastic. Sources: FEViscoElasticMaterial.cpp, FEBio 4 format.
#include "io/cards/deck.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/xml_card.h"

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

// The elastic child decides what its numbers mean.
void check_child(const std::string& type, const char* wanted, ReadCard& card) {
  if (type == wanted) return;
  card.add("elastic-type", "the elastic child is '" + type +
                               "'; its numbers are read as those of '" + wanted + "'");
}

void read_child(const XmlElement& material, const XmlElement& child, ReadCard& card) {
  const std::string type = material.attribute("type"), law = child.attribute("type");
  if (type == "uncoupled viscoelastic") {
    card.understood = febio_uncoupled_target();
    check_child(law, "Mooney-Rivlin", card);
    card.numbers.shear = 2.0 * (child.required("c1") + child.number("c2").value_or(0.0));
    const auto outer = material.number("k"), inner = child.number("k");
    if (!outer && !inner) throw std::runtime_error("the card has no <k>");
    card.numbers.bulk = outer.value_or(inner.value_or(0.0));
    if (inner) {
      card.add("bulk-in-child",
               "<k> stands in the elastic child; FEBio 4 takes that of the top level and warns",
               outer.has_value());
    }
  } else {
    card.understood = febio_target();
    check_child(law, "isotropic elastic", card);
    card.numbers.young = child.required("E");
    card.numbers.poisson = child.required("v");
  }
}

const XmlElement& viscoelastic_in(const std::vector<const XmlElement*>& all, ReadCard& card) {
  const XmlElement* found = nullptr;
  for (const XmlElement* one : all) {
    const std::string type = one->attribute("type");
    if (type != "viscoelastic" && type != "uncoupled viscoelastic") continue;
    if (found == nullptr) {
      found = one;
    } else {
      card.add(
          "second-element",
          at_line(one->place(),
                  "a second viscoelastic <material>; keep one, or choose one by --material-name"));
    }
  }
  if (found != nullptr) return *found;
  if (all.empty()) throw std::runtime_error("the card has no <material type=\"...\">");
  throw std::runtime_error("the material is of type '" + all.front()->attribute("type") +
                           "'; only 'viscoelastic' and 'uncoupled viscoelastic' can be read");
}

void read_febio(const std::string& text, ReadCard& card) {
  const XmlElement root = xml_of(text);
  const XmlElement& material = viscoelastic_in(elements_of(root, "material"), card);
  material.is_read = true;
  material.attribute("id");
  card.name = material.attribute("name");
  const XmlElement* child = material.child("elastic");
  if (child == nullptr) throw std::runtime_error("the card has no <elastic>");
  read_child(material, *child, card);
  auto density = child->number("density");
  if (!density) density = material.number("density");
  card.numbers.density = density.value_or(0.0);
  double sum = 0.0;
  for (int i = 1; i <= 6; ++i) {
    const double g = material.number("g" + std::to_string(i)).value_or(0.0),
                 tau = material.number("t" + std::to_string(i)).value_or(1.0);
    if (g == 0.0) continue;
    card.numbers.branches.push_back({g, 0.0, tau});
    sum += g;
  }
  if (material.child("g7") != nullptr)
    card.add("too-many-terms", "FEBio reads g1 to g6 only; g7 is ignored");
  const std::optional<double> g0 = material.number("g0");
  card.numbers.equilibrium = g0.value_or(1.0);
  card.add_unread(unread_parts(material));
  if (g0 || !(sum > 0.0)) return;
  card.add(
      "g0-default",
      "g0 is not given, so FEBio takes 1: the modulus at t = 0 is (1 + sum g) times that of the "
      "elastic child",
      false);
}

// The unit cube and its rollers.
std::string febio_mesh(const std::string& material, bool is_confined) {
  std::string out = "<Mesh>\n<Nodes name=\"nodes\">\n";
  int id = 0;
  for (const auto& [x, y, z] : kCubeCorners) {
    out += fmt::format("<node id=\"{}\">{},{},{}</node>\n", ++id, x, y, z);
  }
  out +=
      "</Nodes>\n<Elements type=\"hex8\" name=\"cube\"><elem id=\"1\">1,2,3,4,5,6,7,8</elem>"
      "</Elements>\n<NodeSet name=\"x0\">1,4,5,8</NodeSet>\n<NodeSet "
      "name=\"y0\">1,2,5,6</NodeSet>\n"
      "<NodeSet name=\"z0\">1,2,3,4</NodeSet>\n<NodeSet name=\"z1\">5,6,7,8</NodeSet>\n"
      "<NodeSet name=\"x1\">2,3,6,7</NodeSet>\n<NodeSet name=\"y1\">3,4,7,8</NodeSet>\n</Mesh>\n"
      "<MeshDomains><SolidDomain name=\"cube\" mat=\"" +
      material + "\"/></MeshDomains>\n<Boundary>\n";
  std::vector<std::string> faces{"x0", "y0", "z0"};
  if (is_confined) faces.insert(faces.end(), {"x1", "y1"});
  for (const std::string& face : faces) {
    out += fmt::format(
        "<bc name=\"fix {0}\" node_set=\"{0}\" type=\"zero displacement\">"
        "<x_dof>{1}</x_dof><y_dof>{2}</y_dof><z_dof>{3}</z_dof></bc>\n",
        face, face[0] == 'x' ? 1 : 0, face[0] == 'y' ? 1 : 0, face[0] == 'z' ? 1 : 0);
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
               input.card.text + "</Material>\n" +
               febio_mesh(input.card.name, input.is_confined()) + pull(input) + steps(input) +
               "<Output><logfile>" +
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
