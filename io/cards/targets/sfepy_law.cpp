// Modules for SfePy of laws of rubber: the sum of its terms, dw_tl_he_neohook with mu = 2 C10, dw_tl_he_mooney_rivlin with
// kappa = 2 C01, dw_tl_he_genyeoh with (C_p0, p) for each power p, dw_tl_he_ogden with Ogden's own
// (2 mu_i/alpha_i, alpha_i), dw_tl_bulk_penalty with K. It has no term of Arruda and Boyce or of Gent, and none with a
// memory: the module integrates Simo's rule in numpy. Source: sfepy/terms/terms_hyperelastic_tl.py of SfePy 2021.4; run
// there by the tests.
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/law_numbers.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/program_law.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

namespace viscard {
namespace {

constexpr const char* kSfepyMemory = R"py(

def elastic_stress(F):
    """Deviatoric second Piola-Kirchhoff stress of the law at once; F has the shape (points, 3, 3)."""
    squares, axes = np.linalg.eigh(np.swapaxes(F, 1, 2) @ F)
    s = np.sqrt(squares) / np.linalg.det(F)[:, None] ** (1.0 / 3.0)
    x = np.sum(s**2, axis=1, keepdims=True) - 3.0
    kirchhoff = np.zeros_like(s)
    for _, name in TERMS:
        value = VALUES[name]
        if name == "mu":
            kirchhoff += value * s**2
        elif name == "kappa":
            kirchhoff -= value * s**-2
        elif name.startswith("ogden"):
            kirchhoff += value[0][0] * s ** value[0][1]
        elif name.startswith("yeoh"):
            factor, power = value[0]
            kirchhoff += 2.0 * factor * power * x ** (power - 1) * s**2
    kirchhoff -= kirchhoff.mean(axis=1, keepdims=True)
    return np.einsum("pia,pa,pja->pij", axes, kirchhoff / squares, axes)


class Memory:
    """The law with its terms at all points (Simo 1987). After each step: advance(dt, stress) with
    elastic_stress(F), or SfePy's own stress. stress() is the deviatoric second Piola-Kirchhoff stress; the
    pressure is that of the body. Exact for a stress that is linear in each step; dt = 0 is a jump."""

    def __init__(self, points):
        self.elastic = np.zeros((points, 3, 3))
        self.branches = np.zeros((len(TAU), points, 3, 3))

    def advance(self, dt, elastic):
        x = dt / np.array(TAU)
        mean = -np.expm1(-x) / x if dt > 0.0 else np.ones_like(x)
        for i, branch in enumerate(self.branches):
            self.branches[i] = np.exp(-x[i]) * branch + mean[i] * (elastic - self.elastic)
        self.elastic = np.array(elastic)

    def stress(self):
        return (1.0 - sum(G)) * self.elastic + np.tensordot(G, self.branches, 1)
)py";

// A term of SfePy, and the number or numbers that it takes.
struct SfepyTerm {
  const char* term;
  std::string name;   // of its parameter
  std::string value;  // in Python
};

std::vector<SfepyTerm> sfepy_terms(const CardNumbers& law) {
  const auto pair = [](double factor, double exponent) {
    return fmt::format("[[{}, {}]]", factor, exponent);
  };
  std::vector<SfepyTerm> out;
  if (is_ogden(law.form)) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      out.push_back({"dw_tl_he_ogden", fmt::format("ogden{}", i + 1),
                     pair(own_moduli(law)[i], law.shapes[i])});
    }
  } else if (law.form == HyperelasticForm::kYeoh) {
    for (std::size_t i = 0; i < law.moduli.size(); ++i) {
      out.push_back({"dw_tl_he_genyeoh", fmt::format("yeoh{}", i + 1),
                     pair(law.moduli[i], static_cast<double>(i + 1))});
    }
  } else {
    out.push_back({"dw_tl_he_neohook", "mu", fmt::format("{}", 2.0 * law.moduli[0])});
    if (law.moduli.size() > 1) {
      out.push_back({"dw_tl_he_mooney_rivlin", "kappa", fmt::format("{}", 2.0 * law.moduli[1])});
    }
  }
  out.push_back({"dw_tl_bulk_penalty", "K", fmt::format("{}", law.bulk)});
  return out;
}

// Rows of the dictionary VALUES and of the list TERMS of a module for SfePy, and its other lists.
struct SfepyModule {
  NamedNumbers values, others;
  std::vector<std::pair<std::string, std::string>> terms;  // of SfePy, and the value it takes
};

SfepyModule sfepy_module(const std::string& commented) {
  SfepyModule out;
  for (const CardLine& line : card_lines(without_line_comments(commented, "#"), "\n")) {
    if (const auto row =
            first_match(line.text, "^\\s+[\"'](\\w+)[\"']\\s*:\\s*([-+.\\deE, \\[\\]]+)$"))
      out.values[row->group[1]] = numbers_of_list(row->group[2], line);
    if (const auto row = first_match(
            line.text, "^\\s+\\(\\s*[\"'](dw_\\w+)[\"']\\s*,\\s*[\"'](\\w+)[\"']\\s*\\),?\\s*$"))
      out.terms.emplace_back(row->group[1], row->group[2]);
    if (const auto row = first_match(line.text, "^(G|TAU|DENSITY)\\s*=\\s*([-+.\\deE, \\[\\]]+)$"))
      out.others[row->group[1]] = numbers_of_list(row->group[2], line);
  }
  return out;
}

// Pairs of a factor and an exponent.
void take_pairs(const std::vector<double>& numbers, std::vector<double>& factors,
                std::vector<double>& exponents) {
  if (numbers.size() % 2 != 0) throw std::runtime_error("a list of pairs has an odd number");
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    factors.push_back(numbers[i]);
    exponents.push_back(numbers[i + 1]);
  }
}

// Yeoh's constants from the powers of I1 - 3.
std::vector<double> yeoh_of(const std::vector<double>& factors, const std::vector<double>& powers) {
  std::vector<double> out(3, 0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (powers[i] != 1.0 && powers[i] != 2.0 && powers[i] != 3.0)
      throw std::runtime_error("Yeoh's law has the powers 1, 2 and 3 of I1 - 3");
    out[static_cast<std::size_t>(powers[i]) - 1] += factors[i];
  }
  return out;
}

}  // namespace

std::string write_sfepy_law(const CardBody& body) {
  const CardNumbers& law = body.numbers;
  std::string values, terms, memory;
  for (const SfepyTerm& term : sfepy_terms(law)) {
    values += fmt::format("    \"{}\": {},\n", term.name, term.value);
    terms += fmt::format("    (\"{}\", \"{}\"),\n", term.term, term.name);
  }
  std::string text = law.branches.empty() ? "" : "import numpy as np\n\n";
  text += "VALUES = {\n" + values + "}\nTERMS = (\n" + terms + ")\n";
  if (law.density > 0.0) text += "DENSITY = " + fmt::format("{}", law.density) + "\n";
  if (is_ogden(law.form)) {
    text +=
        "# SfePy 2021.4 takes the exponents of whole stretches instead of isochoric ones: its "
        "stress is "
        "off\n# by about (J - 1) (2 - alpha)/3, so K must be large beside the shear modulus.\n";
  }
  if (!law.branches.empty()) {
    memory =
        fmt::format("\n\nG = [{}]\nTAU = [{}]\n", joined(law.branches, &CardBranch::shear, ", "),
                    joined(law.branches, &CardBranch::time, ", ")) +
        kSfepyMemory;
  }
  return text +
         "\n\ndef material():\n"
         "    \"\"\"Values of a Material, or of an entry of `materials` in a problem file.\"\"\"\n"
         "    return dict(VALUES)\n"
         "\n\ndef terms(name=\"rubber\", virtual=\"v\", state=\"u\"):\n"
         "    \"\"\"Expressions for Term.new(); name is that of the Material.\"\"\"\n"
         "    return [f\"{term}({name}.{value}, {virtual}, {state})\" for term, value in TERMS]\n"
         "\n\ndef equation(name=\"rubber\", integral=\"i\", region=\"Omega\", virtual=\"v\", "
         "state=\"u\"):\n"
         "    \"\"\"Virtual work of the stress, for `equations` of a problem file.\"\"\"\n"
         "    return \" + \".join(\n"
         "        f\"{term}.{integral}.{region}({name}.{value}, {virtual}, {state})\" for term, "
         "value "
         "in TERMS\n"
         "    )\n" +
         memory;
}

void read_sfepy_law(const std::string& text, ReadCard& card) {
  const SfepyModule module = sfepy_module(text);
  CardNumbers& law = card.numbers;
  std::map<std::string, std::vector<double>> factors, exponents;
  double mu = 0.0, kappa = 0.0;
  for (const auto& [term, name] : module.terms) {
    if (term == "dw_tl_he_neohook") {
      mu += one_of(module.values, name);
    } else if (term == "dw_tl_he_mooney_rivlin") {
      kappa += one_of(module.values, name);
    } else if (term == "dw_tl_bulk_penalty") {
      law.bulk += one_of(module.values, name);
    } else if (term == "dw_tl_he_ogden" || term == "dw_tl_he_genyeoh") {
      const auto pairs = module.values.find(name);
      if (pairs == module.values.end()) throw std::runtime_error("the card has no " + name);
      take_pairs(pairs->second, factors[term], exponents[term]);
    } else {
      throw std::runtime_error("the term " + term + " of SfePy is not read");
    }
  }
  const bool has_invariants = mu != 0.0 || kappa != 0.0;
  if (factors.size() + (has_invariants ? 1 : 0) != 1)
    throw std::runtime_error(
        "the card has no terms dw_tl_he_... of one law in its TERMS, or those of several");
  if (has_invariants) {
    take_invariant_law({mu / 2.0, kappa / 2.0}, law);
  } else if (auto own = factors.find("dw_tl_he_ogden"); own != factors.end()) {
    take_own_ogden(own->second, exponents.at(own->first), law);
  } else {
    take_law(HyperelasticForm::kYeoh,
             yeoh_of(factors.at("dw_tl_he_genyeoh"), exponents.at("dw_tl_he_genyeoh")), {}, law);
  }
  if (module.others.contains("DENSITY")) law.density = one_of(module.others, "DENSITY");
  take_program_terms(module.others, "G", "TAU", law);
  const auto lines_of = [](const std::string& program) {
    const std::string list = "[-+.\\deE, \\[\\]]+$";
    const std::string pattern =
        "^\\s+[\"']\\w+[\"']\\s*:\\s*" + list +
        "|^\\s+\\(\\s*[\"']dw_\\w+[\"']\\s*,\\s*[\"']\\w+[\"']\\s*\\),?\\s*$" +
        "|^(G|TAU|DENSITY)\\s*=\\s*" + list;
    return computing_lines(program, "#", pattern.c_str(), true);
  };
  // A module of values alone computes nothing by itself.
  const auto found = lines_of(text);
  if (found.size() > 4)
    require_formula(
        found, lines_of(write_sfepy_law({"", law, card.understood, card.units, card.material})));
}

}  // namespace viscard
