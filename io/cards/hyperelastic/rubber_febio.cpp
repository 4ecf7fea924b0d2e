// Laws of rubber in FEBio, written and read. Source: FEOgdenMaterial.cpp, FEMooneyRivlin.cpp, FEYeoh.cpp,
// FEArrudaBoyce.cpp, FEGentMaterial.cpp, FEGenericHyperelasticUC.cpp of FEBio 4 (January 2026).
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
// whole has not been run. The bulk modulus k is that of the top level; g0 is 1 if it is not given.
#include "io/basics/patterns.h"
#include "io/cards/hyperelastic/rubber_readers.h"
#include "io/cards/hyperelastic/rubber_rows.h"
#include "io/cards/hyperelastic/rubber_terms.h"
#include "io/cards/keyword_lines.h"
#include "io/cards/xml_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Form = HyperelasticForm;

std::string tag(const std::string& name, double value) {
  return fmt::format("  <{0}>{1}</{0}>\n", name, number_of_20(value));
}

// Coefficients of Arruda and Boyce's series of I1^i - 3^i.
constexpr std::array<double, 5> kChain{1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0,
                                       519.0 / 673750.0};

double factor_of_chain(double mu, double s_m, std::size_t i) {
  return mu * kChain[i] / std::pow(s_m, 2.0 * static_cast<double>(i));
}

// "0.2*(I1-3)+0.03*(I1-3)^2" of Yeoh, "0.175*(I1-3)+0.0054*(I1^2-9)" of Arruda and Boyce.
std::string energy_of(const RubberNumbers& law) {
  std::string out;
  const auto add = [&](double factor, const std::string& of) {
    const std::string number = number_of_20(factor);
    out += (out.empty() || number[0] == '-' ? "" : "+") + number + "*" + of;
  };
  if (law.form == Form::kYeoh) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i)
      add(law.moduli[i], i == 0 ? "(I1-3)" : fmt::format("(I1-3)^{}", i + 1));
    return out;
  }
  for (std::size_t i = 0; i < kChain.size(); ++i) {
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

void take_energy(const XmlElement& law, RubberNumbers& out) {
  const XmlElement* energy = law.child("W");
  if (energy == nullptr) throw std::runtime_error("the card has no <W>");
  EnergyTerms terms = terms_of(*energy);
  if (!terms.is_chain) {
    const auto& C = terms.powers_of_excess;
    if (C[3] != 0.0 || C[4] != 0.0)
      throw std::runtime_error(at_line(energy->place(), "W has powers of I1 - 3 above the third"));
    out.form = C[1] == 0.0 && C[2] == 0.0 ? Form::kNeoHooke : Form::kYeoh;
    out.moduli = {C[0]};
    if (out.form == Form::kYeoh) out.moduli = {C[0], C[1], C[2]};
    return;
  }
  terms.powers[0] = terms.powers_of_excess[0];
  out.form = Form::kArrudaBoyce;
  out.moduli = {terms.powers[0] / kChain[0]};
  out.shapes = {std::sqrt(factor_of_chain(out.moduli[0], 1.0, 1) / terms.powers[1])};
  for (std::size_t i = 2; i < kChain.size(); ++i) {
    const double expected = factor_of_chain(out.moduli[0], out.shapes[0], i);
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

void take_law(const XmlElement& law, const std::string& type, RubberText& read) {
  RubberNumbers& out = read.numbers;
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
    out.form = Form::kGent;
    out.moduli = {law.required("G")};
    out.shapes = {law.required("Jm")};
  } else if (type == "Yeoh") {
    c.resize(std::max<std::size_t>(c.size(), 3), 0.0);
    if (c.size() > 3)
      throw std::runtime_error(at_line(law.place(), "Yeoh has more than three constants"));
    for (std::size_t i = 0; i < c.size(); ++i) c[i] /= static_cast<double>(i + 1);
    out.form = Form::kYeoh;
    out.moduli = c;
    read.findings.push_back({"version-of-febio",
                             "FEBio since 2023 (run in 4.11) has c_i (I1 - 3)^(i - 1) in the "
                             "stress of 'Yeoh', without the "
                             "factor i: read as C_i0 = c_i/i. Earlier versions take c_i for C_i0. "
                             "'uncoupled hyperelastic' "
                             "with the energy W is right in both",
                             false});
  } else {  // Arruda-Boyce
    out.form = Form::kArrudaBoyce;
    out.moduli = {law.required("mu")};
    out.shapes = {std::sqrt(law.required("N"))};
    read.findings.push_back({"febio-arruda-boyce",
                             "the stress of FEBio's 'Arruda-Boyce' has the factor i of its series "
                             "twice (65 % too stiff at "
                             "a stretch of 2 in 4.11), and no constants repair that; write the law "
                             "as 'uncoupled hyperelastic' "
                             "with its energy W, as viscard does",
                             true});
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

FebioMaterial material_in(const XmlElement& root, RubberText& out) {
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
      out.findings.push_back(
          {"several-materials",
           at_line(one->place(),
                   "a second material of rubber begins; choose one by --material-name"),
           true});
      return found;
    }
    found = {one, law};
    if (type == "viscoelastic") {
      out.findings.push_back(
          {"coupled-parent",
           at_line(one->place(),
                   "'viscoelastic' takes coupled laws alone, and '" + name +
                       "' is uncoupled: FEBio stops; the type must be 'uncoupled viscoelastic'"),
           true});
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

}  // namespace

std::string febio_rubber(const RubberNumbers& law, const std::string& material) {
  std::string type, body;
  const std::size_t n = law.moduli.size();
  if (is_ogden(law.form)) {
    type = "Ogden";
    for (std::size_t i = 0; i < n; ++i) {
      body += tag(fmt::format("c{}", i + 1), 2.0 * law.moduli[i]) +
              tag(fmt::format("m{}", i + 1), law.shapes[i]);
    }
  } else if (law.form == Form::kArrudaBoyce || law.form == Form::kYeoh) {
    type = "uncoupled hyperelastic";
    body = "  <W>" + energy_of(law) + "</W>\n";
  } else if (law.form == Form::kGent) {
    type = "Gent";
    body = tag("G", law.moduli[0]) + tag("Jm", law.shapes[0]);
  } else {  // Neo-Hooke is Mooney-Rivlin without its second constant
    type = "Mooney-Rivlin";
    body = tag("c1", law.moduli[0]) + tag("c2", n > 1 ? law.moduli[1] : 0.0);
  }
  if (law.density > 0.0) body = tag("density", law.density) + body;
  if (law.terms.empty()) {
    return fmt::format("<material id=\"1\" name=\"{}\" type=\"{}\">\n{}{}</material>\n", material,
                       type, body, tag("k", law.bulk));
  }
  // FEBio takes the bulk modulus of an uncoupled material from its top level.
  return fmt::format(
      "<material id=\"1\" name=\"{}\" type=\"uncoupled viscoelastic\">\n{}{}"
      "<elastic type=\"{}\">\n{}</elastic>\n</material>\n",
      material, febio_terms(law), tag("k", law.bulk), type, body);
}

RubberText read_febio_rubber(const std::string& text) {
  RubberText out;
  RubberNumbers& numbers = out.numbers;
  const XmlElement root = xml_of(text);
  const auto [material, law] = material_in(root, out);
  material->is_read = law->is_read = true;
  material->attribute("id");
  material->attribute("name");
  take_law(*law, law->attribute("type"), out);
  const auto outer = material->number("k");
  numbers.bulk = outer ? *outer : law->number("k").value_or(0.0);
  if (!(numbers.bulk > 0.0)) {
    out.findings.push_back(
        {"missing-bulk-modulus",
         "<k> is not above 0: FEBio stops, an uncoupled material needs its bulk modulus", true});
  } else if (!outer) {
    out.findings.push_back({"bulk-in-child",
                            "<k> stands in the elastic child; FEBio 4 takes that of the top level",
                            true});
  }
  auto density = law->number("density");
  if (!density && material != law) density = material->number("density");
  numbers.density = density.value_or(0.0);
  if (material != law) {
    const std::vector<double> g = numbered(*material, "g"), t = numbered(*material, "t");
    if (t.size() < g.size())
      throw std::runtime_error("the card has g1 to g" + std::to_string(g.size()) + " and " +
                               std::to_string(t.size()) + " times t");
    // At once the child counts g0 + sum g times; g0 is 1 if it is not given.
    double whole = material->number("g0").value_or(1.0);
    for (const double share : g) whole += share;
    for (double& modulus : numbers.moduli) modulus *= whole;
    for (std::size_t i = 0; i < g.size(); ++i) numbers.terms.push_back({g[i] / whole, t[i]});
  }
  add_unread_parts(unread_parts(*material), out.findings);
  return out;
}

}  // namespace viscard
