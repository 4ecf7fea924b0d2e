#include "io/cards/hyperelastic/read_rubber.h"

#include "io/basics/words.h"
#include "io/cards/card_lines.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/hyperelastic/rubber_targets.h"
#include "io/cards/named_material.h"
#include "io/cards/unit_system.h"
#include "io/cards/unread_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

// Everything that was read, as text.
std::string reading_of(const RubberText& read) {
  std::string out = fmt::format("{} {} {} {}", static_cast<int>(read.numbers.form),
                                read.numbers.bulk, read.numbers.density, read.poisson);
  const auto add = [&](double value) { out += fmt::format(" {}", value); };
  for (const double modulus : read.numbers.moduli) add(modulus);
  for (const double shape : read.numbers.shapes) add(shape);
  for (const RubberNumbers::FoamTerm& term : read.numbers.foam) {
    add(term.mu);
    add(term.alpha);
    add(term.nu);
  }
  for (const RubberNumbers::Term& term : read.numbers.terms) {
    add(term.g);
    add(term.time);
  }
  if (const auto& damage = read.numbers.damage) {
    out += fmt::format(" damage {} {} {}", damage->r, damage->m, damage->beta);
  }
  out += (read.is_long_term ? " long" : " once") + read.also_read + read.units;
  for (const CardFinding& finding : read.findings) out += " " + finding.text;
  return out;
}

// A foam; terms of one alpha and nu are one term, such as the halves that CalculiX needs.
void take_foam(const RubberNumbers& numbers, double stress_Pa, ReadRubber& out) {
  std::vector<RubberNumbers::FoamTerm> terms;
  for (const RubberNumbers::FoamTerm& term : numbers.foam) {
    const auto same = std::find_if(terms.begin(), terms.end(), [&](const auto& other) {
      return other.alpha == term.alpha && other.nu == term.nu;
    });
    if (same != terms.end()) {
      same->mu += term.mu;
    } else {
      terms.push_back(term);
    }
  }
  const auto n = static_cast<Eigen::Index>(terms.size());
  FoamLaw law{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& term = terms[static_cast<std::size_t>(i)];
    law.mu_Pa[i] = term.mu * stress_Pa;
    law.alpha[i] = term.alpha;
    law.nu[i] = term.nu;
  }
  validate(law);
  out.foam = law;
  out.bulk_Pa = bulk_modulus_Pa(law);
}

// The damage of a card in SI, and what is wrong with it.
void take_damage(const RubberNumbers& numbers, double stress_Pa, ReadRubber& out) {
  if (!numbers.damage) return;
  if (out.foam) {
    out.findings.push_back({"damage-beside-foam",
                            "damage by the first loading stands beside a foam: its energy would be "
                            "the whole one, with the volume, "
                            "which is not computed here",
                            true});
  }
  out.damage =
      MullinsDamage{numbers.damage->r, numbers.damage->m * stress_Pa, numbers.damage->beta};
  try {
    validate(*out.damage);
  } catch (const std::invalid_argument& error) {
    out.findings.push_back({"damage-out-of-range", error.what(), true});
  }
  if (out.terms.empty()) return;
  out.findings.push_back(
      {"damage-beside-terms",
       "damage stands beside terms of relaxation: solvers let it act on different "
       "parts of such a law, and viscard has none with both",
       true});
}

RubberText text_of_target(const std::string& text, const std::string& target) {
  return rubber_target(target).read(text);
}

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

// Moduli and shares of the law at once, from those that stand in the card.
void take_at_once(const RubberText& read, double stress_Pa, ReadRubber& out) {
  const RubberNumbers& numbers = read.numbers;
  out.law.form = numbers.form;
  out.law.moduli_Pa = vector_of(numbers.moduli) * stress_Pa;
  out.law.shapes = vector_of(numbers.shapes);
  out.is_long_term = read.is_long_term;
  validate(out.law);
  const double shear_Pa = youngs_modulus_Pa(out.law) / 3.0;
  if (read.has_poisson && read.poisson > -1.0 && read.poisson < 0.5) {
    out.bulk_Pa = 2.0 * shear_Pa * (1.0 + read.poisson) / (3.0 * (1.0 - 2.0 * read.poisson));
    out.poisson = read.poisson;
  }
  for (const RubberNumbers::Term& term : numbers.terms)
    out.terms.push_back({term.g, from_card(term.time, out.units->time_exponent)});
  double sum = 0.0;
  for (RubberTerm& term : out.terms) {
    if (read.has_absolute_terms) term.g *= stress_Pa / shear_Pa;  // of the law after all relaxation
    sum += term.g;
  }
  if (!out.is_long_term) return;
  if (read.has_absolute_terms) {
    out.law.moduli_Pa *= 1.0 + sum;
    for (RubberTerm& term : out.terms) term.g /= 1.0 + sum;
  } else if (sum < 1.0) {
    out.law.moduli_Pa /= 1.0 - sum;
  } else {
    throw std::runtime_error("the shares of the terms sum to " + std::to_string(sum) +
                             ": nothing is left after all relaxation");
  }
}

}  // namespace

std::string name_of(const ReadRubber& read) {
  return read.foam ? foam_name(read.foam->mu_Pa.size()) : name_of(read.law.form);
}

bool looks_like_rubber_card(const std::string& text) {
  if (!stated_rubber_target(text).empty()) return true;
  // Abaqus/CAE writes "*Hyperelastic", MAPDL "TB,HYPE".
  static const std::vector<std::string> kWords{"*HYPERELASTIC",
                                               "*HYPERFOAM",
                                               "*MAT_HILL_FOAM",
                                               "*MAT_177",
                                               "TB,HYPE",
                                               "*MAT_OGDEN_RUBBER",
                                               "*MAT_077",
                                               "*MAT_HYPERELASTIC",
                                               "/MAT/LAW62",
                                               "/MAT/LAW82",
                                               "/MAT/LAW92",
                                               "/MAT/LAW94",
                                               "/MAT/LAW100",
                                               "\"OGDEN\"",
                                               "\"YEOH\"",
                                               "\"ARRUDA-BOYCE\"",
                                               "\"GENT\"",
                                               "\"OGDENUNCONSTRAINED\"",
                                               "'OGDEN'",
                                               "'YEOH'",
                                               "'ARRUDA-BOYCE'",
                                               "'GENT'",
                                               "UNCOUPLEDHYPERELASTIC",
                                               "!HYPERELASTIC",
                                               "DW_TL_HE_",
                                               "COMPUTENEOHOOKEANSTRESS",
                                               "DEFAULTFINITESTRAIN"};
  std::string plain = upper(text);
  std::erase_if(plain, [](char c) { return c == ' ' || c == '\t'; });
  const auto has = [&](const std::string& word) { return plain.find(word) != std::string::npos; };
  // FEBio's Mooney-Rivlin with one constant, in an uncoupled parent, stands for linear materials too.
  if (has("TYPE=\"VISCOELASTIC\"") && has("\"MOONEY-RIVLIN\"")) return true;
  return std::any_of(kWords.begin(), kWords.end(), has);
}

std::string stated_rubber_target(const std::string& text) {
  const std::string mark = "viscard card: ";
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return "";
  const std::string line = text.substr(at, text.find('\n', at) - at);
  for (const std::string& target : rubber_card_targets()) {
    if (const std::size_t found = line.find(" for " + target); found != std::string::npos)
      return target;
  }
  return "";
}

ReadRubber read_rubber_card(const std::string& text, const std::string& target,
                            const std::string& units) {
  const RubberText read = text_of_target(text, target);
  const std::string stated = stated_unit_system(text);
  ReadRubber out;
  out.units_were_stated = !stated.empty();
  if (read.has_own_units) {
    out.units = &unit_system("SI");
    out.units_were_stated = true;
  } else {
    if (!read.units.empty()) out.units_were_stated = true;
    out.units = &unit_system(!units.empty()        ? units
                             : !read.units.empty() ? read.units
                             : !stated.empty()     ? stated
                                                   : "SI");
  }
  if (read.numbers.bulk > 0.0)
    out.bulk_Pa = from_card(read.numbers.bulk, out.units->stress_exponent);
  if (read.numbers.density > 0.0)
    out.density_kg_m3 = from_card(read.numbers.density, out.units->density_exponent);
  out.findings = read.findings;
  const auto names = material_names(text, target);
  const bool is_named = std::any_of(out.findings.begin(), out.findings.end(), [](const auto& one) {
    return one.name == "several-materials";
  });
  if (names.size() > 1 && !is_named)
    out.findings.push_back(
        {"several-materials",
         "the file has the materials " + listed(names) + "; choose one by --material-name", true});
  add_unread_parts(unread_tokens(text, target,
                                 [&](const std::string& changed) {
                                   return reading_of(text_of_target(changed, target));
                                 }),
                   out.findings);
  const double stress_Pa = from_card(1.0, out.units->stress_exponent);
  if (read.numbers.foam.empty()) take_at_once(read, stress_Pa, out);
  if (!read.numbers.foam.empty()) take_foam(read.numbers, stress_Pa, out);
  take_damage(read.numbers, stress_Pa, out);
  return out;
}

}  // namespace viscard
