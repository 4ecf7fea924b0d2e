// FEBio viscoelastic, uncoupled viscoelastic. Sources: FEViscoElasticMaterial.cpp, FEBio 4 format.
// Laws of rubber, by FEOgdenMaterial.cpp, FEMooneyRivlin.cpp, FEYeoh.cpp, FEArrudaBoyce.cpp, FEGentMaterial.cpp,
// FEGenericHyperelasticUC.cpp, FEUncoupledViscoElasticMaterial.cpp of FEBio 4 (January 2026):
//   Ogden                   c_i/m_i^2 where viscard has 2 mu_i/alpha_i^2
//   Mooney-Rivlin           c1 = C10, c2 = C01
//   Gent                    G = mu, Jm
//   uncoupled hyperelastic  an energy W of the isochoric invariants I1, I2, which FEBio 3 and later differentiate
//   Yeoh                    since 2023 DevStress sums c_i (I1 - 3)^(i-1) without the factor i (run in 4.11: 27 % too
//                           soft at a stretch of 2), before that with it
//   Arruda-Boyce            its coefficients contain the factor i, which is then applied again (run in 4.11: 65 % too
//                           stiff); no constants repair that
// Yeoh and Arruda-Boyce are therefore written as "uncoupled hyperelastic", which is right in every version. FEBio's own
// parser and derivatives (FECore/MathObject.cpp) gave W and its first two derivatives within 1e-10; the material as a
// whole has not been run. The bulk modulus k is that of the top level; g0 is 1 if it is not given. The recursion of the
// branches on the second Piola-Kirchhoff stress is Simo's. "Ogden unconstrained" equals viscard's foam for nu = 0 only.
#include "io/basics/patterns.h"
#include "io/cards/deck.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/known_mistakes.h"
#include "io/cards/law_numbers.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/xml_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

std::string tag(const std::string& name, double value) {
  return fmt::format("<{0}>{1}</{0}>", name, value);
}

std::string relaxation_tags(double g0, const std::vector<CardBranch>& branches) {
  std::string out = "  " + tag("g0", g0) + "\n";
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    out += "  " + tag("g" + number, branches[i].shear) + tag("t" + number, branches[i].time) + "\n";
  }
  return out;
}

// The stress is g0 times the elastic child's plus a branch for each g_i, so g0 = 1 - sum g beside
// an instantaneous child; g0 defaults to 1. The uncoupled form relaxes the deviatoric part alone;
// Mooney-Rivlin with c2 = 0 has G = 2 c1.
std::string write_febio(const CardBody& body) {
  const CardNumbers& numbers = body.numbers;
  const bool is_uncoupled = body.target.elastic == ElasticForm::kBulkShear;
  std::string out = fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n", body.name,
                                is_uncoupled ? "uncoupled viscoelastic" : "viscoelastic");
  out += relaxation_tags(numbers.equilibrium, numbers.branches);
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

// The density of the elastic child, else of the material, and the branches; returns g0.
std::optional<double> read_relaxation(const XmlElement& material, const XmlElement& child,
                                      ReadCard& card) {
  auto density = child.number("density");
  if (!density) density = material.number("density");
  card.numbers.density = density.value_or(0.0);
  for (int i = 1; i <= 6; ++i) {
    const double g = material.number("g" + std::to_string(i)).value_or(0.0),
                 tau = material.number("t" + std::to_string(i)).value_or(1.0);
    if (g != 0.0) card.numbers.branches.push_back({g, 0.0, tau});
  }
  if (material.child("g7") != nullptr)
    card.add("too-many-terms", "FEBio reads g1 to g6 only; g7 is ignored");
  return material.number("g0");
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
  const std::optional<double> g0 = read_relaxation(material, *child, card);
  card.numbers.equilibrium = g0.value_or(1.0);
  card.add_unread(unread_parts(material));
  if (g0 || card.numbers.branches.empty()) return;
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

// Laws of rubber.

constexpr std::size_t kChainTerms = std::size(kArrudaBoyceSeries);

double factor_of_chain(double mu, double s_m, std::size_t i) {
  return mu * kArrudaBoyceSeries[i] / std::pow(s_m, 2.0 * static_cast<double>(i));
}

// "0.2*(I1-3)+0.03*(I1-3)^2" of Yeoh, "0.175*(I1-3)+0.0054*(I1^2-9)" of Arruda and Boyce.
std::string energy_of(const CardNumbers& law) {
  std::string out;
  const auto add = [&](double factor, const std::string& of) {
    const std::string number = fmt::format("{}", factor);
    out += (out.empty() || number[0] == '-' ? "" : "+") + number + "*" + of;
  };
  if (law.form == HyperelasticForm::kYeoh) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i)
      add(law.moduli[i], i == 0 ? "(I1-3)" : fmt::format("(I1-3)^{}", i + 1));
    return out;
  }
  for (std::size_t i = 0; i < kChainTerms; ++i) {
    add(factor_of_chain(law.moduli[0], law.shapes[0], i),
        i == 0 ? "(I1-3)"
               : fmt::format("(I1^{}-{:.0f})", i + 1, std::pow(3.0, static_cast<double>(i + 1))));
  }
  return out;
}

// The factors of (I1-3)^n, or of I1^n - 3^n if it has one of them.
struct EnergyTerms {
  std::array<double, 5> powers_of_excess{}, powers{};
  bool is_chain = false;
};

EnergyTerms terms_of(const XmlElement& energy) {
  const std::string number = "([-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][-+]?\\d+)?)";
  EnergyTerms out;
  std::string rest = energy.text;
  std::erase_if(rest, [](unsigned char c) { return c <= ' '; });
  const auto power_of = [](const std::string& text) { return text.empty() ? 1U : text[0] - '0'; };
  while (!rest.empty()) {
    const auto term =
        first_match(rest, "^" + number + "\\*\\(I1(?:\\^([1-5]))?-(\\d+)\\)(?:\\^([1-5]))?");
    if (!term || (!term->group[2].empty() && !term->group[4].empty())) {
      throw std::runtime_error(at_line(
          energy.place(), "'" + rest +
                              "' is not read: W is read as a sum of terms 0.2*(I1-3)^2, or of "
                              "terms 0.2*(I1^2-9) of Arruda and Boyce"));
    }
    const double factor = card_number(term->group[1], energy.place(), "a factor of W");
    const auto inner = power_of(term->group[2]), outer = power_of(term->group[4]);
    const double constant = card_number(term->group[3], energy.place(), "a constant of W");
    if (constant != std::pow(3.0, inner)) {
      throw std::runtime_error(at_line(
          energy.place(), fmt::format("'{}': W is not 0 at rest, where I1^{} is {:.0f} and not {}",
                                      term->group[0], inner, std::pow(3.0, inner), constant)));
    }
    out.is_chain = out.is_chain || inner > 1;
    (inner > 1 ? out.powers : out.powers_of_excess)[(inner > 1 ? inner : outer) - 1] += factor;
    rest.erase(0, term->group[0].size());
  }
  return out;
}

void take_energy(const XmlElement& law, CardNumbers& out) {
  const XmlElement* energy = law.child("W");
  if (energy == nullptr) throw std::runtime_error("the card has no <W>");
  EnergyTerms terms = terms_of(*energy);
  if (!terms.is_chain) {
    const auto& C = terms.powers_of_excess;
    if (C[3] != 0.0 || C[4] != 0.0)
      throw std::runtime_error(at_line(energy->place(), "W has powers of I1 - 3 above the third"));
    return take_invariant_law({C[0], 0.0, C[1], 0.0, 0.0, C[2]}, out);
  }
  terms.powers[0] = terms.powers_of_excess[0];
  const double mu = terms.powers[0] / kArrudaBoyceSeries[0];
  const double s_m = std::sqrt(factor_of_chain(mu, 1.0, 1) / terms.powers[1]);
  take_law(HyperelasticForm::kArrudaBoyce, {mu}, {s_m}, out);
  for (std::size_t i = 2; i < kChainTerms; ++i) {
    const double expected = factor_of_chain(mu, s_m, i);
    if (std::abs(terms.powers[i] / expected - 1.0) <= 1e-6) continue;
    throw std::runtime_error(at_line(
        energy->place(),
        fmt::format(
            "the factor of I1^{0} is {1:.9g}, {2:.4g} times the {3:.9g} that Arruda and Boyce's "
            "law has with mu and s_m of the first two terms",
            i + 1, terms.powers[i], terms.powers[i] / expected, expected)));
  }
}

// Numbers of the tags c1, c2 ... or m1, m2 ...
std::vector<double> numbered(const XmlElement& element, const std::string& name) {
  std::vector<double> out;
  for (int i = 1; i <= 6; ++i) {
    const auto value = element.number(name + std::to_string(i));
    if (!value) break;
    out.push_back(*value);
  }
  return out;
}

void take_febio_law(const XmlElement& law, const std::string& type, ReadCard& card) {
  CardNumbers& out = card.numbers;
  if (type == "uncoupled hyperelastic") return take_energy(law, out);
  std::vector<double> c = numbered(law, "c");
  if (type == "Ogden") {
    const std::vector<double> m = numbered(law, "m");
    if (m.size() < c.size())
      throw std::runtime_error(at_line(law.place(), "Ogden has " + std::to_string(m.size()) +
                                                        " exponents m, not " +
                                                        std::to_string(c.size())));
    for (double& value : c) value /= 2.0;  // c/m^2 is 2 mu/alpha^2
    take_ogden(c, m, out);
  } else if (type == "Mooney-Rivlin") {
    take_invariant_law({law.required("c1"), law.number("c2").value_or(0.0)}, out);
  } else if (type == "Gent") {
    take_law(HyperelasticForm::kGent, {law.required("G")}, {law.required("Jm")}, out);
  } else if (type == "Yeoh") {
    c.resize(std::max<std::size_t>(c.size(), 3), 0.0);
    if (c.size() > 3)
      throw std::runtime_error(at_line(law.place(), "Yeoh has more than three constants"));
    take_law(HyperelasticForm::kYeoh, {c[0], c[1] / 2.0, c[2] / 3.0}, {}, out);
    card.add("version-of-febio",
             "FEBio since 2023 (run in 4.11) has c_i (I1 - 3)^(i - 1) in the stress of 'Yeoh', "
             "without the factor i: read as C_i0 = c_i/i. Earlier versions take c_i for C_i0. "
             "'uncoupled hyperelastic' with the energy W is right in both",
             false);
  } else {  // Arruda-Boyce
    take_law(HyperelasticForm::kArrudaBoyce, {law.required("mu")}, {std::sqrt(law.required("N"))},
             out);
    card.add("febio-arruda-boyce",
             "the stress of FEBio's 'Arruda-Boyce' has the factor i of its series twice (65 % too "
             "stiff at a stretch of 2 in 4.11), and no constants repair that; write the law as "
             "'uncoupled hyperelastic' with its energy W, as viscard does");
  }
}

bool is_law(const std::string& type) {
  static const std::array<const char*, 6> kTypes{
      "Ogden", "Mooney-Rivlin", "Gent", "Yeoh", "Arruda-Boyce", "uncoupled hyperelastic"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end();
}

// The material of rubber: a law, or one that has it as its elastic child.
struct FebioMaterial {
  const XmlElement *material = nullptr, *law = nullptr;
};

FebioMaterial material_in(const XmlElement& root, ReadCard& card) {
  FebioMaterial found;
  std::string types;
  for (const XmlElement* one : elements_of(root, "material")) {
    const std::string type = one->attribute("type");
    const bool has_child = type == "uncoupled viscoelastic" || type == "viscoelastic";
    const XmlElement* law = has_child ? one->child("elastic") : one;
    const std::string name = law == nullptr ? "" : law->attribute("type");
    types += (types.empty() ? "'" : ", '") + (has_child ? name : type) + "'";
    if (!is_law(name)) continue;
    if (found.material != nullptr) {
      card.add("several-materials",
               at_line(one->place(),
                       "a second material of rubber begins; choose one by --material-name"));
      return found;
    }
    found = {one, law};
    if (type == "viscoelastic") {
      card.add(
          "coupled-parent",
          at_line(one->place(),
                  "'viscoelastic' takes coupled laws alone, and '" + name +
                      "' is uncoupled: FEBio stops; the type must be 'uncoupled viscoelastic'"));
    }
  }
  if (found.material == nullptr) {
    throw std::runtime_error(
        "the card has no Ogden, Mooney-Rivlin, Gent, Yeoh, Arruda-Boyce or uncoupled hyperelastic; "
        "it has " +
        (types.empty() ? std::string("no <material>") : types));
  }
  return found;
}

std::string write_febio_law(const CardBody& card) {
  const CardNumbers& law = card.numbers;
  std::string type, body;
  const auto add = [&](const std::string& name, double value) {
    body += "  " + tag(name, value) + "\n";
  };
  if (law.density > 0.0) add("density", law.density);
  if (is_ogden(law.form)) {
    type = "Ogden";
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      add(fmt::format("c{}", i + 1), 2.0 * law.moduli[i]);
      add(fmt::format("m{}", i + 1), law.shapes[i]);
    }
  } else if (law.form == HyperelasticForm::kArrudaBoyce || law.form == HyperelasticForm::kYeoh) {
    type = "uncoupled hyperelastic";
    body += "  <W>" + energy_of(law) + "</W>\n";
  } else if (law.form == HyperelasticForm::kGent) {
    type = "Gent";
    add("G", law.moduli[0]);
    add("Jm", law.shapes[0]);
  } else {  // Neo-Hooke is Mooney-Rivlin without its second constant
    type = "Mooney-Rivlin";
    add("c1", law.moduli[0]);
    add("c2", law.moduli.size() > 1 ? law.moduli[1] : 0.0);
  }
  const std::string bulk = "  " + tag("k", law.bulk) + "\n";
  if (law.branches.empty()) {
    return fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n{}{}</material>\n", card.name,
                       type, body, bulk);
  }
  // FEBio takes the bulk modulus of an uncoupled material from its top level.
  return fmt::format(
      "<material id=\"1\" name=\"{}\" type=\"uncoupled viscoelastic\">\n{}{}"
      "<elastic type=\"{}\">\n{}</elastic>\n</material>\n",
      card.name, relaxation_tags(law.long_term_share(), law.branches), bulk, type, body);
}

void read_febio_law(const std::string& text, ReadCard& card) {
  CardNumbers& numbers = card.numbers;
  const XmlElement root = xml_of(text);
  const auto [material, law] = material_in(root, card);
  material->is_read = law->is_read = true;
  material->attribute("id");
  card.name = material->attribute("name");
  take_febio_law(*law, law->attribute("type"), card);
  const auto outer = material->number("k");
  numbers.bulk = outer ? *outer : law->number("k").value_or(0.0);
  if (!(numbers.bulk > 0.0)) {
    card.add("missing-bulk-modulus",
             "<k> is not above 0: FEBio stops, an uncoupled material needs its bulk modulus");
  } else if (!outer) {
    card.add("bulk-in-child",
             "<k> stands in the elastic child; FEBio 4 takes that of the top level");
  }
  if (material == law) {
    numbers.density = law->number("density").value_or(0.0);
  } else {
    // At once the child counts g0 + sum g times; g0 is 1 if it is not given.
    double whole = read_relaxation(*material, *law, card).value_or(1.0);
    for (const CardBranch& branch : numbers.branches) whole += branch.shear;
    for (double& modulus : numbers.moduli) modulus *= whole;
    for (CardBranch& branch : numbers.branches) branch.shear /= whole;
  }
  card.add_unread(unread_parts(*material));
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
  return {
      .name = "febio",
      .code = "FEBio viscoelastic",
      .extension = ".feb",
      .comment = "<!--",
      .write = write_febio,
      .read = read_febio,
      .deck = DeckWriter{febio_deck, "febio4 -i {}.feb"},
      .laws =
          LawColumn{
              .write = write_febio_law,
              .read = read_febio_law,
              .keywords = {"Mooney-Rivlin: c1 = C10, c2 = 0", "Mooney-Rivlin: c1 = C10, c2 = C01",
                           "uncoupled hyperelastic: W of I1", "Ogden: c_i = 2 mu_i, m_i = alpha_i",
                           "uncoupled hyperelastic: W of I1", "Gent: G = mu, Jm = J_m"},
              .volume = "k/2 (ln J)^2, FEBio's pressure_model 0",
              .takes_terms = true,
              .most_terms = 6,
              .terms = "the law at once with g0 = 1 - sum g, g_i, t_i = tau_i, constant bulk "
                       "modulus; Simo's rule at large strain, run in FEBio 4.11 with Ogden",
              .damage = {"",
                         "its elastic damage softens the first loading, too, and is another "
                         "law"},
              .evidence = "Ogden, Mooney-Rivlin and Gent run in FEBio 4.11; of 'uncoupled "
                          "hyperelastic' (Yeoh, Arruda-Boyce) FEBio's parser and derivatives of "
                          "W were run, the material not"},
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
  target.laws.reset();  // cards of both are uncoupled
  target.code = "FEBio uncoupled viscoelastic";
  target.add_mistakes = add_uncoupled_mistakes;
  target.elastic = ElasticForm::kBulkShear;
  target.bulk = BulkRule::kConstantBulk;
  target.evidence_note = "FEBio 4 on one element, ramp and hold: 2.2e-9";
  return target;
}

}  // namespace viscard
