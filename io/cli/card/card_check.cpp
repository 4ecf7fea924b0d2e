#include "io/basics/atomic_file.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/target_table.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

nlohmann::ordered_json json_of(const CardTarget& target) {
  return {{"name", target.name},
          {"code", target.code},
          {"extension", target.extension},
          {"elastic", to_word(target.elastic)},
          {"modulus", to_word(target.at)},
          {"branches", to_word(target.branch)},
          {"time", to_word(target.time)},
          {"bulk", to_word(target.bulk)},
          {"max_terms", target.max_terms},
          {"takes_nu_0_5", target.takes_incompressible},
          {"takes_wlf", target.takes_wlf},
          {"takes_arrhenius", target.takes_arrhenius},
          {"needs_density", target.needs_density},
          {"conventions", conventions_in_words(target)},
          {"cannot_represent", target.cannot_represent},
          {"states_material", states_material(target)},
          {"has_band", target.band_note != nullptr},
          {"evidence", to_word(target.evidence)},
          {"evidence_note", target.evidence_note},
          {"advice", target.advice}};
}

nlohmann::ordered_json optional_json(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const Material& material) {
  nlohmann::ordered_json out{
      {"E0_Pa", material.E0_Pa}, {"nu", material.nu}, {"rho_kg_m3", material.rho_kg_m3}};
  out["terms"] = nlohmann::ordered_json::array();
  for (const MaterialTerm& term : material.terms) {
    out["terms"].push_back({{"g", term.g}, {"k", term.k}, {"tau_s", term.tau_s}});
  }
  if (const auto& shift = material.shift; shift && shift->law == ShiftLaw::kWlf) {
    out["shift"] = {
        {"law", "wlf"}, {"T_ref_C", shift->T_ref_C}, {"C1", shift->C1}, {"C2_K", shift->C2_K}};
  } else if (shift) {
    out["shift"] = {{"law", "arrhenius"},
                    {"T_ref_C", shift->T_ref_C},
                    {"activation_J_mol", shift->activation_J_mol}};
  }
  return out;
}

nlohmann::ordered_json json_of(const CardCheck& check, const CardWords& words) {
  nlohmann::ordered_json json;
  json["card"] = words.check;
  json["target"] = check.read.understood.name;
  json["units"] = check.units;
  json["agrees"] = check.agrees;
  json["understood"] = {{"elastic", to_word(check.read.understood.elastic)},
                        {"modulus", to_word(check.read.understood.at)},
                        {"branches", to_word(check.read.understood.branch)},
                        {"time", to_word(check.read.understood.time)},
                        {"bulk", to_word(check.read.understood.bulk)},
                        {"conventions", conventions_in_words(check.read.understood)}};
  json["material"] = json_of(check.read.material);
  if (check.read.understood.values != nullptr) {
    json["material"] = nullptr;  // no whole material can be read from such a card
    for (const char* key : {"elastic", "modulus", "branches", "time", "bulk"}) {
      json["understood"][key] = nullptr;  // words of series; "conventions" describes this card
    }
    json["frequencies_Hz"] = check.read.frequencies_Hz;
    json["values"] = nlohmann::ordered_json::array();
    for (const CardValue& value : check.read.values) {
      json["values"].push_back({{"name", value.name}, {"value", value.value}});
    }
  }
  json["tolerance"] = check.tolerance;
  json["E_difference"] = optional_json(check.E_difference);
  json["G_difference"] = optional_json(check.G_difference);
  json["E_difference_with_bulk"] = optional_json(check.E_difference_with_bulk);
  json["findings"] = nlohmann::ordered_json::array();
  for (const CardFinding& finding : check.findings) {
    json["findings"].push_back(
        {{"name", finding.name}, {"mistake", finding.is_mistake}, {"text", finding.text}});
  }
  return json;
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
  if (material.E0_Pa > 0.0) {
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
  for (const CardFinding& finding : check.findings) {
    out << (finding.is_mistake ? "mistake " : "note ") << finding.name << ": " << finding.text
        << "\n";
  }
  const bool has_mistake =
      std::any_of(check.findings.begin(), check.findings.end(),
                  [](const CardFinding& finding) { return finding.is_mistake; });
  if (has_mistake || (!check.agrees && !check.E_difference)) {
    out << "the card is wrong\n";
  } else if (!check.agrees) {
    out << fmt::format("the card differs by more than the {:.1e} allowed\n", check.tolerance);
  } else if (check.E_difference) {
    out << fmt::format("the card agrees with the material (within {:.1e})\n", check.tolerance);
  } else {
    out << "no mistake found; name a material to compare with\n";
  }
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

int list_card_targets(const CardWords& words, Streams& streams) {
  if (words.json) {
    nlohmann::ordered_json json;
    json["targets"] = nlohmann::ordered_json::array();
    for (const CardTarget& target : card_targets()) json["targets"].push_back(json_of(target));
    json["units"] = nlohmann::ordered_json::array();
    for (const UnitSystem& system : unit_systems()) {
      json["units"].push_back({{"name", system.name}, {"description", system.description}});
    }
    print_json({"viscard-card-list/1", {}}, json, streams);
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
  const std::string text = read_file(words.check);
  std::optional<PreparedMaterial> reference;
  std::vector<CardFinding> notes;
  if (!words.material.empty()) reference = stated_material(text, words, notes);
  CardCheck check = [&] {
    try {
      return check_card(text, card_target(words.target),
                        {.units = words.units, .tolerance = words.tolerance, .band = words.band},
                        reference ? &reference->material : nullptr);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(words.check + ": " + error.what());
    }
  }();
  check.findings.insert(check.findings.begin(), notes.begin(), notes.end());
  if (words.json) {
    Words inputs{words.check};
    if (!words.material.empty()) inputs.push_back(words.material);
    print_json({"viscard-card-check/1", inputs}, json_of(check, words), streams);
  } else {
    print(check, words, FittedText(streams));
  }
  return check.agrees ? kDone : kFailed;
}

}  // namespace viscard
