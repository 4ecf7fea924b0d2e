#include "io/cards/hyperelastic/read_rubber.h"

#include "io/basics/words.h"
#include "io/cards/card_lines.h"
#include "io/cards/header_name.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/named_material.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace viscard {
namespace {

// A foam; terms of one alpha and nu are one term, such as the halves that CalculiX needs.
void take_foam(const CardNumbers& numbers, double stress_Pa, ReadRubber& out) {
  std::vector<CardNumbers::FoamTerm> terms;
  for (const CardNumbers::FoamTerm& term : numbers.foam) {
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
void take_damage(const CardNumbers& numbers, double stress_Pa, ReadRubber& out) {
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

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

// Moduli and shares of the law at once, from those that stand in the card.
void take_at_once(const ReadCard& read, double stress_Pa, ReadRubber& out) {
  const CardNumbers& numbers = read.numbers;
  out.law.form = numbers.form;
  out.law.moduli_Pa = vector_of(numbers.moduli) * stress_Pa;
  out.law.shapes = vector_of(numbers.shapes);
  out.is_long_term = read.understood.at == ModulusAt::kLongTerm;
  validate(out.law);
  const double shear_Pa = youngs_modulus_Pa(out.law) / 3.0;
  const double nu = numbers.poisson;
  if (read.understood.elastic == ElasticForm::kPoissonOnly && nu > -1.0 && nu < 0.5) {
    out.bulk_Pa = 2.0 * shear_Pa * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
    out.poisson = nu;
  }
  for (const CardBranch& branch : numbers.branches)
    out.terms.push_back({branch.shear, from_card(branch.time, out.units->time_exponent)});
  const bool is_absolute = read.understood.branch == BranchNumber::kAbsoluteShear;
  double sum = 0.0;
  for (RubberTerm& term : out.terms) {
    if (is_absolute) term.g *= stress_Pa / shear_Pa;  // of the law after all relaxation
    sum += term.g;
  }
  if (!out.is_long_term) return;
  if (is_absolute) {
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
  const std::size_t at = behind_mark(text, "viscard card: ");
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
  const CardTarget& row = law_target(target);
  const ReadCard read = read_law_numbers(text, row, units);
  ReadRubber out;
  out.units = &unit_system(read.units.name);
  out.units_were_stated = read.units_were_stated;
  if (read.numbers.bulk > 0.0)
    out.bulk_Pa = from_card(read.numbers.bulk, out.units->stress_exponent);
  if (read.numbers.density > 0.0)
    out.density_kg_m3 = from_card(read.numbers.density, out.units->density_exponent);
  out.findings = read.findings;
  // The names, if they distinguish the materials, instead of what the reader noticed at the second one.
  if (const auto names = material_names(text, target);
      std::set<std::string>(names.begin(), names.end()).size() > 1) {
    std::erase_if(out.findings, [](const CardFinding& one) {
      return one.name == "several-materials" || one.name == "material-number-differs";
    });
    out.findings.insert(
        out.findings.begin(),
        {"several-materials",
         "the file has the materials " + listed(names) + "; choose one by --material-name", true});
  }
  note_unread_of_law(text, row, units, out.findings);
  const double stress_Pa = from_card(1.0, out.units->stress_exponent);
  if (read.numbers.foam.empty()) take_at_once(read, stress_Pa, out);
  if (!read.numbers.foam.empty()) take_foam(read.numbers, stress_Pa, out);
  take_damage(read.numbers, stress_Pa, out);
  return out;
}

}  // namespace viscard
