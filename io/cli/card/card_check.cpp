#include "io/basics/atomic_file.h"
#include "io/cards/card_sum.h"
#include "io/cards/check_card.h"
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/named_material.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/target_table.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <stdexcept>

namespace viscard {
namespace {

void show_keys(ResultVisitor& v, const CardTarget& target) {
  v("name", target.name, "as in --for");
  v("code", target.code, "name of the solver");
  v("extension", target.extension, "of the file");
  v("elastic", to_word(target.elastic), "which elastic constants");
  v("modulus", to_word(target.at), "at which time");
  v("branches", to_word(target.branch), "how terms are stated");
  v("time", to_word(target.time), "how times are stated");
  v("bulk", to_word(target.bulk), "rule of the bulk modulus");
  v("max_terms", target.max_terms, "0: any number");
  v("takes_nu_0_5", target.takes_incompressible, "whether incompressible");
  v("takes_wlf", target.takes_wlf, "WLF shift");
  v("takes_arrhenius", target.takes_arrhenius, "Arrhenius shift");
  v("needs_density", target.needs_density, "whether a density is needed");
  v("conventions", conventions_in_words(target), "all of this in words");
  v("cannot_represent", target.cannot_represent, "what it cannot take; empty: nothing");
  v("states_material", states_material(target), "whether the card is a whole material");
  v("has_band", target.band_note != nullptr, "whether --band applies");
  v.word("evidence", to_word(target.evidence), {"run", "parsed", "source", "documentation", "ours"},
         "how the target was checked");
  v("evidence_note", target.evidence_note, "by what");
  v("advice", target.advice, "for its users");
}

void show_targets(ResultVisitor& v) {
  std::vector<const CardTarget*> targets;  // a target has no default for the list to describe
  for (const CardTarget& target : card_targets()) targets.push_back(&target);
  v.list("targets", "all targets", targets,
         [&](const CardTarget* target) { show_keys(v, *target); });
  v.list("units", "all unit systems", unit_systems(), [&](const UnitSystem& system) {
    v("name", system.name, "as in --units");
    v("description", system.description, "its units");
  });
}

void show_shift(ResultVisitor& v, const TemperatureShift& shift) {
  const bool is_wlf = shift.law == ShiftLaw::kWlf;
  v.word("law", is_wlf ? "wlf" : "arrhenius", {"wlf", "arrhenius"}, "its name");
  v("T_ref_C", shift.T_ref_C, "reference temperature");
  v.when(is_wlf, [&] {
    v("C1", shift.C1, "of a WLF law");
    v("C2_K", shift.C2_K, "of a WLF law");
  });
  v.when(!is_wlf, [&] { v("activation_J_mol", shift.activation_J_mol, "of an Arrhenius law"); });
}

// A card that describes no solid has no values.
bool has_solid(const ReadCard& read) {
  return read.material.E0_Pa > 0.0;
}

void show_material(ResultVisitor& v, const Material& material) {
  v("E0_Pa", material.E0_Pa, "instantaneous modulus");
  v("nu", material.nu, "Poisson ratio");
  v("rho_kg_m3", material.rho_kg_m3, "density; 0: the card states none");
  v.list("terms", "the series", material.terms, [&](const MaterialTerm& term) {
    v("g", term.g, "relative shear modulus");
    v("k", term.k, "relative bulk modulus");
    v("tau_s", term.tau_s, "relaxation time");
  });
  v.when(material.shift.has_value(), [&] {
    v.object("shift", "law of the shift with temperature",
             [&] { show_shift(v, material.shift.value_or(TemperatureShift{})); });
  });
}

// Words of series; "conventions" describes a card that states no whole material.
void show_understood(ResultVisitor& v, const CardTarget& target) {
  const auto word = [&](const char* key, const std::string& value, const char* what) {
    v.or_null(key, target.values == nullptr ? std::optional(value) : std::nullopt, what);
  };
  word("elastic", to_word(target.elastic), "which elastic constants");
  word("modulus", to_word(target.at), "at which time");
  word("branches", to_word(target.branch), "how terms are stated");
  word("time", to_word(target.time), "how times are stated");
  word("bulk", to_word(target.bulk), "rule of the bulk modulus");
  v("conventions", conventions_in_words(target), "all of it in words");
}

void print_findings(const CheckedCard& card, std::ostream& out) {
  for (const CardFinding& finding : card.findings) {
    out << (finding.is_mistake ? "mistake " : "note ") << finding.name << ": " << finding.text
        << "\n";
  }
  out << verdict_of(card) << verdict_hint(card) << "\n";
}

// The check of a card by its file, whose name stands before what it throws.
template <typename Check>
auto checked_file(const CardWords& words, const Check& check) {
  try {
    return check();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(words.check + ": " + error.what());
  }
}

CheckedCard checked(const CardCheck& check) {
  return {check.findings, check.agrees, check.E_difference.has_value(), check.tolerance};
}

void show_check(ResultVisitor& v, const CardCheck& check, const std::string& card) {
  const bool has_values = check.read.understood.values != nullptr;
  v("card", card, "the card");
  v("target", check.read.understood.name, "its solver");
  v("units", check.units, "its unit system");
  v("agrees", check.agrees, "whether card and material agree");
  v("verdict", verdict_of(checked(check)), "what the check found, in words");
  v.object("understood", "how the card was read",
           [&] { show_understood(v, check.read.understood); });
  v.object(
      "material", "what the card means; null: it states no whole material, or no values were read",
      [&] { show_material(v, check.read.material); }, has_values || !has_solid(check.read));
  v.when(has_values, [&] {
    v("frequencies_Hz", check.read.frequencies_Hz, "of a table over frequency");
    v.list("values", "numbers of a card that states no whole material", check.read.values,
           [&](const CardValue& value) {
             v("name", value.name, "its name");
             v("value", value.value, "in SI");
           });
  });
  v("tolerance", check.tolerance, "largest relative difference allowed");
  v("E_difference", number_or_null(check.E_difference),
    "largest relative difference of E(t); null: no material was named");
  v("G_difference", number_or_null(check.G_difference), "the same of G(t)");
  v("E_difference_with_bulk", number_or_null(check.E_difference_with_bulk),
    "the same with the bulk rule of the material");
  v("findings", check.findings, "mistakes and notes");
}

std::string shift_row(const TemperatureShift& shift) {
  if (shift.law == ShiftLaw::kWlf) {
    return fmt::format("  WLF: C1 = {:.9g}, C2 = {:.9g} K, T_ref = {:.9g} C\n", shift.C1,
                       shift.C2_K, shift.T_ref_C);
  }
  return fmt::format("  Arrhenius: E_a = {:.9g} J/mol, T_ref = {:.9g} C\n", shift.activation_J_mol,
                     shift.T_ref_C);
}

void print_numbers(const CardCheck& check, std::ostream& out) {
  const Material& material = check.read.material;
  if (has_solid(check.read)) {
    out << fmt::format("E0 = {:.9g} Pa, nu = {:.9g}, ", material.E0_Pa, material.nu)
        << (material.rho_kg_m3 > 0.0 ? fmt::format("rho = {:.9g} kg/m3\n", material.rho_kg_m3)
                                     : "no density\n");
    for (std::size_t i = 0; i < material.terms.size(); ++i) {
      out << fmt::format("  term {}: g = {:.9g}, k = {:.9g}, tau = {:.9g} s\n", i + 1,
                         material.terms[i].g, material.terms[i].k, material.terms[i].tau_s);
    }
    if (material.shift) out << shift_row(*material.shift);
  }
  constexpr std::size_t kFewValues = 8;  // a reduction, not a table
  if (check.read.values.size() <= kFewValues) {
    for (const CardValue& value : check.read.values) {
      out << fmt::format("  {} = {:.9g}\n", value.name, value.value);
    }
  }
}

void print(const CardCheck& check, const CardWords& words, std::ostream& out) {
  out << words.check << ": " << check.read.understood.code << ", units " << check.units
      << (check.read.units_were_stated || !words.units.empty() ? "" : " (not stated)") << "\n"
      << "understood: " << conventions_in_words(check.read.understood) << "\n";
  print_numbers(check, out);
  if (check.E_difference) {
    const bool is_series = check.read.understood.values == nullptr;
    out << fmt::format("largest difference {}: {:.2e}", is_series ? "in E(t)" : "of a number",
                       *check.E_difference);
    if (check.E_difference_with_bulk && *check.E_difference_with_bulk > 2.0 * *check.E_difference &&
        *check.E_difference_with_bulk > 1e-9) {
      out << fmt::format(" ({:.2e} with the material's own bulk rule)",
                         *check.E_difference_with_bulk);
    }
    out << "\n";
  }
  print_findings(checked(check), out);
}

// Parameters by name, in Pa where they are moduli.
std::vector<CardValue> parameters_of(const ReadRubber& read) {
  std::vector<CardValue> out;
  const HyperelasticLaw& law = read.law;
  for (Eigen::Index i = 0; read.foam && i < read.foam->mu_Pa.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    out.push_back({"mu_" + number + "_Pa", read.foam->mu_Pa[i]});
    out.push_back({"alpha_" + number, read.foam->alpha[i]});
    out.push_back({"nu_" + number, read.foam->nu[i]});
  }
  if (read.foam) return out;
  const auto moduli = modulus_names(law.form), shapes = shape_names(law.form);
  for (std::size_t i = 0; i < moduli.size(); ++i)
    out.push_back({moduli[i], law.moduli_Pa[static_cast<Eigen::Index>(i)]});
  for (std::size_t i = 0; i < shapes.size(); ++i)
    out.push_back({shapes[i], law.shapes[static_cast<Eigen::Index>(i)]});
  return out;
}

CheckedCard checked(const RubberCheck& check) {
  return {check.findings, check.agrees, check.difference.has_value(), check.tolerance, "law"};
}

void show_check(ResultVisitor& v, const RubberCheck& check, const CardWords& words) {
  const ReadRubber& read = check.read;
  v("card", words.check, "the card");
  v("target", words.target, "its solver");
  v("units", read.units == nullptr ? "" : read.units->name, "its unit system");
  v("agrees", check.agrees, "whether card and material agree");
  v("verdict", verdict_of(checked(check)), "what the check found, in words");
  v("law", name_of(read), "name of the law");
  v.word("basis", read.is_long_term ? "long-term" : "instantaneous", {"instantaneous", "long-term"},
         "which law stands in the card");
  v.list("parameters", "the law at once", parameters_of(read), [&](const CardValue& value) {
    v("name", value.name, "its name; moduli in Pa");
    v("value", value.value, "its value");
  });
  v.list("terms", "its terms of relaxation", read.terms, [&](const RubberTerm& term) {
    v("g", term.g, "share of the law at once");
    v("tau_s", term.tau_s, "its time");
  });
  v.when(read.damage.has_value(), [&] {
    const MullinsDamage damage = read.damage.value_or(MullinsDamage{});
    v.object("damage", "softening by the first loading (mullins-or)", [&] {
      v("r", damage.r, "pure number");
      v("m_Pa", damage.m_Pa, "energy per volume");
      v("beta", damage.beta, "pure number");
    });
  });
  v("bulk_modulus_Pa",
    number_or_null(read.bulk_Pa > 0.0 ? std::optional(read.bulk_Pa) : std::nullopt),
    "null: incompressible");
  v("tolerance", check.tolerance, "largest relative difference allowed");
  v("difference", number_or_null(check.difference),
    "largest relative difference of a parameter; null: no law was named");
  v("findings", check.findings, "mistakes and notes");
}

void print(const RubberCheck& check, const CardWords& words, std::ostream& out) {
  const ReadRubber& read = check.read;
  out << words.check << ": " << name_of(read) << " for " << words.target << ", units "
      << read.units->name << (read.units_were_stated || !words.units.empty() ? "" : " (not stated)")
      << "\n";
  if (read.is_long_term) out << "the card has the law after all relaxation; here it is at once:\n";
  for (const CardValue& value : parameters_of(read))
    out << fmt::format("  {} = {:.9g}\n", value.name, value.value);
  for (std::size_t i = 0; i < read.terms.size(); ++i) {
    out << fmt::format("  term {}: g = {:.9g}, tau = {:.9g} s\n", i + 1, read.terms[i].g,
                       read.terms[i].tau_s);
  }
  if (read.damage) {
    out << fmt::format("  damage {}: r = {:.9g}, m = {:.9g} Pa, beta = {:.9g}\n", kMullinsName,
                       read.damage->r, read.damage->m_Pa, read.damage->beta);
  }
  out << (read.bulk_Pa > 0.0 ? fmt::format("  bulk modulus = {:.9g} Pa\n", read.bulk_Pa)
                             : std::string("  incompressible\n"));
  if (check.difference)
    out << fmt::format("largest difference of a parameter: {:.2e}\n", *check.difference);
  print_findings(checked(check), out);
}

// Prints what was found, with --json by its schema.
template <typename Check>
int report_check(const Check& check, const CardWords& words, const char* schema,
                 const std::function<void(ResultVisitor&)>& show, Streams& streams) {
  if (words.json) {
    Words inputs{words.check};
    if (!words.material.empty()) inputs.push_back(words.material);
    print_result({schema, inputs}, show, streams);
  } else {
    print(check, words, FittedText(streams));
  }
  return check.agrees ? kDone : kFailed;
}

void print_list(std::ostream& out) {
  out << "target           terms  nu=.5  evidence       solver: conventions\n";
  for (const CardTarget& target : card_targets()) {
    out << fmt::format("{:<16} {:>5}  {:<5}  {:<13}  {}: {}\n", target.name,
                       target.max_terms > 0 ? std::to_string(target.max_terms) : "any",
                       target.takes_incompressible ? "yes" : "no", to_word(target.evidence),
                       target.code, conventions_in_words(target));
  }
  out << "\nevidence: run = the solver returned the exact answer; parsed = independent "
         "readers found the\nnumbers; source = its open source, not run; documentation = "
         "its manual, not run\n\nunits: ";
  const char* between = "";
  for (const UnitSystem& system : unit_systems()) {
    out << between << system.name << " (" << system.description << ")";
    between = "; ";
  }
  out << "\n";
}

}  // namespace

std::string verdict_of(const CheckedCard& card) {
  const bool has_mistake =
      std::any_of(card.findings.begin(), card.findings.end(),
                  [](const CardFinding& finding) { return finding.is_mistake; });
  if (has_mistake || (!card.agrees && !card.is_compared)) return "the card is wrong";
  if (!card.agrees)
    return fmt::format("the card differs by more than the {:.1e} allowed", card.tolerance);
  if (has_unread_parts(card.findings)) {
    return card.is_compared
               ? fmt::format("what was read of the card agrees with the {}", card.other) +
                     "; nothing is stated of the rest"
               : "not all of the card was read; nothing is stated of it as a whole";
  }
  if (card.is_compared)
    return fmt::format("the card agrees with the {} (within {:.1e})", card.other, card.tolerance);
  return has_edited_finding(card.findings) ? "no known mistake found, but the card was edited"
                                           : "no mistake found";
}

std::string verdict_hint(const CheckedCard& card) {
  if (!card.agrees || card.is_compared || has_unread_parts(card.findings)) return "";
  return fmt::format("; name {} to compare with",
                     card.other == std::string("law") ? "the file of the law" : "a material");
}

std::vector<DescribedResult> results_of_targets() {
  CardCheck check{.read = {.understood = card_targets().front(), .units = unit_systems().front()}};
  CardCheck of_values = check;
  for (const CardTarget& target : card_targets()) {
    if (target.values != nullptr) of_values.read.understood = target;
  }
  DescribedResult checked{"card-check", "viscard card --check", {}};
  for (const CardCheck& one : {check, of_values}) {
    checked.examples.emplace_back([one](ResultVisitor& v) { show_check(v, one, ""); });
  }
  return {{"card-list", "viscard card --list", {show_targets}}, checked};
}

DescribedResult result_of_law_check() {
  RubberCheck check;
  check.read.law.moduli_Pa = Eigen::VectorXd::Zero(n_moduli(check.read.law.form));
  check.read.law.shapes = Eigen::VectorXd::Zero(n_shapes(check.read.law.form));
  return {"card-rubber-check",
          "viscard card --check of a card of rubber",
          {[check](ResultVisitor& v) { show_check(v, check, CardWords{}); }}};
}

std::string card_text_of(const std::string& path, const CardWords& words) {
  const std::string text = read_file(path);
  if (words.material_name.empty()) return text;
  std::string target = words.target.empty() ? stated_rubber_target(text) : words.target;
  const CardTarget* linear = stated_card_target(text);
  if (target.empty() && linear != nullptr) target = linear->name;
  if (target.empty())
    throw UsageError(path + " does not name its solver, as cards by viscard do; add --for TARGET");
  try {
    return material_named(text, target, words.material_name);
  } catch (const std::invalid_argument& error) {
    throw UsageError(path + ": " + error.what());
  }
}

int list_card_targets(const CardWords& words, Streams& streams) {
  if (words.json) {
    print_result({"viscard-card-list/1", {}}, show_targets, streams);
    return kDone;
  }
  if (words.is_long) {
    streams.out << fitted(target_table(), streams.columns);
    return kDone;
  }
  print_list(FittedText(streams));
  return kDone;
}

int check_card_file(const CardWords& words, Streams& streams) {
  const std::string text = card_text_of(words.check, words);
  std::optional<PreparedMaterial> reference;
  std::vector<CardFinding> notes;
  if (!words.material.empty()) reference = stated_material(text, words, notes);
  CardCheck check = checked_file(words, [&] {
    return check_card(text, card_target(words.target),
                      {.units = words.units,
                       .tolerance = words.tolerance,
                       .band = words.band,
                       .plausible = words.plausible},
                      reference ? &reference->material : nullptr);
  });
  check.findings.insert(check.findings.begin(), notes.begin(), notes.end());
  return report_check(
      check, words, "viscard-card-check/1",
      [&](ResultVisitor& v) { show_check(v, check, words.check); }, streams);
}

int check_law_file(const CardWords& words, Streams& streams) {
  std::optional<HyperelasticFile> file;
  if (!words.material.empty()) file = read_hyperelastic(words.material, words.plausible);
  const RubberCheck check = checked_file(words, [&] {
    return check_rubber_card(card_text_of(words.check, words), file ? &*file : nullptr,
                             {.target = words.target,
                              .units = words.units,
                              .tolerance = words.tolerance,
                              .bulk_Pa = words.bulk_Pa,
                              .density_kg_m3 = words.density_kg_m3,
                              .plausible = words.plausible,
                              .elastic_only = words.elastic_only});
  });
  return report_check(
      check, words, "viscard-card-rubber-check/1",
      [&](ResultVisitor& v) { show_check(v, check, words); }, streams);
}

}  // namespace viscard
