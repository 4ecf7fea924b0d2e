#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/cards/card.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"
#include "io/materials/material_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

void show_card(ResultVisitor& v, const Card& card, const CardWords& words) {
  v("target", words.target, "solver of the card");
  v("units", words.units.empty() ? "SI" : words.units, "unit system");
  v("out", words.out, "the card; empty: stdout");
  v("n_terms", card.written.terms.size(), "number of terms");
  v("E0_Pa", card.written.E0_Pa, "instantaneous modulus of the card");
  v("E_inf_Pa", derived_moduli(card.written).E_inf_Pa, "equilibrium modulus of the card");
  v("largest_difference", card.largest_difference,
    "largest relative difference of E(t) between card and material");
  v("warnings", card.warnings, "what the user of the card should know");
  v.list("fidelity", "what the target takes exactly, approximately or not at all", card.fidelity,
         [&](const FidelityItem& item) {
           v("item", item.item, "its name");
           v("mapping", to_word(item.mapping), "exact, approximated, dropped ...");
           v("text", item.text, "in words");
         });
  v.when(words.out.empty(), [&] {
    v("card", card.text, "the card itself, without --out");
    v.list("companions", "files that the card reads beside it, without --out", card.companions,
           [&](const CompanionFile& file) {
             v("suffix", file.suffix, "in the place of the card's extension");
             v("text", file.text, "its contents");
           });
  });
}

void report_losses(const Card& card, Streams& streams) {
  for (const std::string& warning : card.warnings) {
    streams.err << "viscard: warning: " << warning << "\n";
  }
  for (const FidelityItem& item : card.fidelity) {
    if (item.mapping == Mapping::kExact) continue;
    streams.err << "viscard: " << item.item << " " << to_word(item.mapping) << ": " << item.text
                << "\n";
  }
}

std::string companion_path(const std::string& out, const std::string& suffix) {
  return std::filesystem::path(out).replace_extension().string() + suffix;
}

void require_law_target(const CardWords& words) {
  const auto& known = rubber_card_targets();
  if (std::find(known.begin(), known.end(), words.target) != known.end()) return;
  throw UsageError(words.material + " is a law of rubber, and --for " + words.target +
                   " has no card of rubber; use " + listed(known));
}

void show_law_card(ResultVisitor& v, const HyperelasticFile& file, const CardWords& words,
                   const std::string& doubt, const std::string& text) {
  v("target", words.target, "solver of the card");
  v("units", words.units.empty() ? "SI" : words.units, "unit system");
  v("out", words.out, "the card; empty: stdout");
  v("law", name_of(file), "name of the law");
  v("E0_Pa", file.E0_Pa, "Young's modulus at rest, at once");
  v("E_inf_Pa", file.E_inf_Pa, "Young's modulus at rest after all relaxation; E0_Pa without terms");
  v("terms", words.elastic_only.empty() ? file.terms.size() : 0,
    "number of terms of relaxation in the card; 0 for an elastic law and with --elastic-only");
  v.when(file.damage.has_value(),
         [&] { v("damage", kMullinsName, "softening by the first loading, beside the law"); });
  v("warnings", doubt.empty() ? Words{} : Words{doubt}, "what is doubtful about the card");
  v.when(words.out.empty(), [&] { v("card", text, "the card itself, without --out"); });
}

}  // namespace

PreparedMaterial prepared_material(const CardWords& words) {
  if (looks_like_ratio_file(words.material)) {
    const RatioFit fit = read_ratio_fit(words.material, words.plausible);
    if (!words.ratio) {
      std::string measured;
      for (const double ratio : fit.best.ratios) {
        measured += fmt::format("{}{:g}", measured.empty() ? "" : ", ", ratio);
      }
      throw UsageError(words.material + " is a joint fit; name the mixing ratio with --ratio R (" +
                       measured + " were measured, others between them follow the law)");
    }
  } else if (words.ratio) {
    throw UsageError(words.material +
                     " is one material; --ratio needs a joint fit (viscard fit --joint)");
  }
  return prepare_card_material({.material = words.material,
                                .target = words.target,
                                .bound = words.bound,
                                .elastic_only = words.elastic_only,
                                .terms = words.terms,
                                .ratio = words.ratio,
                                .temperature_C = words.temperature_C,
                                .plausible = words.plausible,
                                .may_extrapolate = words.may_extrapolate,
                                .may_approximate = words.may_approximate});
}

CardOptions card_options(const CardWords& words, const PreparedMaterial& prepared) {
  CardOptions options;
  options.units = words.units.empty() ? "SI" : words.units;
  options.is_reproducible = words.is_reproducible;
  options.may_approximate = words.may_approximate;
  options.accepts_flags = words.accepts_flags;
  options.clamped_nu = words.clamped_nu;
  options.band = words.band;
  options.created_at = now_iso8601();
  options.command = words.command_line;
  state_changes(prepared, options);
  return options;
}

std::vector<DescribedResult> results_of_cards() {
  return {
      {"card-write", "viscard card", {[](ResultVisitor& v) { show_card(v, Card{}, CardWords{}); }}},
      {"card-rubber", "viscard card of a law of rubber", {[](ResultVisitor& v) {
         show_law_card(v, {}, {}, "", "");
       }}}};
}

int write_card_file(const CardWords& words, Streams& streams) {
  const PreparedMaterial prepared = prepared_material(words);
  const Card card =
      write_card(prepared.material, card_target(words.target), card_options(words, prepared));
  if (!words.out.empty()) {
    // The companions first: they are refused before the card itself appears.
    for (const CompanionFile& companion : card.companions) {
      const std::string path = companion_path(words.out, companion.suffix);
      if (!words.force && std::filesystem::exists(words.out)) break;
      write_file(path, companion.text, words.force);
    }
    write_file(words.out, card.text, words.force);
  }
  if (words.json) {
    print_result(
        {"viscard-card-write/1", {words.material}},
        [&](ResultVisitor& v) { show_card(v, card, words); }, streams);
    return kDone;
  }
  if (words.out.empty()) {
    streams.out << card.text;
  } else {
    streams.out << "wrote " << words.out;
    for (const CompanionFile& companion : card.companions) {
      streams.out << " and " << companion_path(words.out, companion.suffix);
    }
    streams.out << (states_material(card_target(words.target))
                        ? fmt::format(" ({}, read back; E(t) within {:.1e} of the material)\n",
                                      counted(card.written.terms.size(), "term"),
                                      card.largest_difference)
                        : std::string(" (read back)\n"));
  }
  report_losses(card, streams);
  return kDone;
}

int write_law_card(const CardWords& words, Streams& streams) {
  require_law_target(words);
  const HyperelasticFile file = read_hyperelastic(words.material, words.plausible);
  const bool has_density = law_target(words.target).states_density;
  if (!has_density && words.density_kg_m3) {
    throw UsageError("cards for " + words.target +
                     " have no place for a density, the solver that uses them has; omit --density");
  }
  RubberCardOptions options;
  options.file_sha256 = sha256_as_read(words.material);
  options.file_name = std::filesystem::path(words.material).filename().string();
  if (!words.is_reproducible) {
    options.created_at = now_iso8601();
    options.command = words.command_line;
  }
  options.target = words.target;
  options.units = words.units.empty() ? "SI" : words.units;
  options.bulk_Pa = words.bulk_Pa ? words.bulk_Pa : file.bulk_Pa;
  options.density_kg_m3 = words.density_kg_m3 ? words.density_kg_m3 : file.density_kg_m3;
  if (!has_density) options.density_kg_m3.reset();
  options.accepts_flags = words.accepts_flags;
  options.may_approximate = words.may_approximate;
  options.elastic_only = words.elastic_only;
  options.plausible = words.plausible;
  try {
    refuse_bulk_modulus(file, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--bulk-modulus: " + std::string(error.what()));
  }
  const std::string doubt = doubtful_bulk_modulus(file, options);
  const std::string text = rubber_file_card(file, words.material, options);
  if (!words.out.empty()) write_file(words.out, text, words.force);
  if (words.json) {
    print_result(
        {"viscard-card-rubber/1", {words.material}},
        [&](ResultVisitor& v) { show_law_card(v, file, words, doubt, text); }, streams);
  } else if (words.out.empty()) {
    streams.out << text;
  } else {
    streams.out << "wrote " << words.out << "\n";
  }
  if (!doubt.empty()) streams.err << "viscard: warning: " << doubt << "\n";
  return kDone;
}

}  // namespace viscard
