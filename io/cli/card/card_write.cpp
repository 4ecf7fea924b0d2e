#include "fit/reduce_terms.h"
#include "io/basics/atomic_file.h"
#include "io/basics/sha256.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/write_card.h"
#include "io/cli/card/card_words.h"
#include "io/materials/material_file.h"
#include "io/materials/ratio_file.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

std::string now_iso8601() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

// E0 and E_inf at the same end of their own intervals, what lies between them shared among the
// terms as fitted. Every modulus at its own end would be further out than any interval says, for
// the moduli of one fit are correlated.
void take_bound(const CardWords& words, PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const bool is_lower = words.bound == "lower";
  if (!material.uncertainty || !(material.uncertainty->E0_Pa_95.high > 0.0)) {
    throw std::runtime_error(words.material +
                             " states no intervals, so it has no bounds; fit it from data first");
  }
  const MaterialUncertainty& found = *material.uncertainty;
  const auto end_Pa = [&](const Interval& interval) {
    const double scale = 1.0 + (is_lower ? -1.0 : 1.0) * found.systematic_relative;
    return (is_lower ? interval.low : interval.high) * scale;
  };
  const double E0_Pa = end_Pa(found.E0_Pa_95), E_inf_Pa = end_Pa(found.E_inf_Pa_95);
  if (!(E0_Pa > 0.0) || !std::isfinite(E0_Pa)) {
    throw std::runtime_error("the " + words.bound + " bound of E0 is no modulus (" +
                             fmt::format("{:g}", E0_Pa) + " Pa); the data do not tell it");
  }
  const double sum_g = derived_moduli(material).sum_g;
  const double relaxing = 1.0 - E_inf_Pa / E0_Pa;  // share of E0
  const bool is_between = E_inf_Pa > 0.0 && relaxing > 0.0 && sum_g > 0.0;
  for (MaterialTerm& term : material.terms) {
    if (!is_between) break;  // the ends cross: the shares stay as fitted
    term.g *= relaxing / sum_g;
    term.k *= relaxing / sum_g;
  }
  material.E0_Pa = E0_Pa;
  prepared.notes.push_back(fmt::format(
      "bound: E0 {}at the {} end of the 95 % interval{}{}", is_between ? "and E_inf " : "",
      words.bound, found.systematic_relative > 0.0 ? ", systematic part included" : "",
      is_between ? "" : "; the shares g are as fitted"));
  material.uncertainty.reset();
}

void leave_relaxation_out(const CardWords& words, PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const DerivedModuli moduli = derived_moduli(material);
  if (words.elastic_only == "long-term") {
    material.E0_Pa = moduli.E_inf_Pa;
    material.nu = moduli.nu_inf;
  }
  prepared.terms_change = fmt::format("{} relaxation terms left out, the {} modulus kept",
                                      material.terms.size(), words.elastic_only);
  prepared.are_terms_dropped = true;
  material.terms.clear();
  material.uncertainty.reset();
  material.flags.clear();
}

void reduce_to_target(const CardWords& words, PreparedMaterial& prepared) {
  const int limit = card_target(words.target).max_terms;
  const int given = static_cast<int>(prepared.material.terms.size());
  int wanted = words.terms.value_or(given);
  if (limit > 0) wanted = std::min(wanted, limit);
  if (words.terms && *words.terms > given) {
    prepared.notes.push_back(fmt::format("--terms {} left the material as it is, with {}",
                                         *words.terms,
                                         counted(static_cast<std::size_t>(given), "term")));
  }
  if (!words.may_approximate || wanted >= given) return;
  const ReducedMaterial reduced = reduce_material(prepared.material, wanted);
  prepared.terms_change =
      fmt::format("{} refitted to {}, E(t) within {:.2e} from {:g} s to {:g} s", given, wanted,
                  reduced.largest_error, reduced.t_min_s, reduced.t_max_s);
  prepared.material = reduced.material;
  prepared.material.valid.t_min_s = reduced.t_min_s;
  prepared.material.valid.t_max_s = reduced.t_max_s;
}

nlohmann::ordered_json json_of(const Card& card, const CardWords& words, bool with_text) {
  nlohmann::ordered_json json;
  json["target"] = words.target;
  json["units"] = words.units.empty() ? "SI" : words.units;
  json["out"] = words.out;
  json["n_terms"] = card.written.terms.size();
  json["E0_Pa"] = card.written.E0_Pa;
  json["E_inf_Pa"] = derived_moduli(card.written).E_inf_Pa;
  json["largest_difference"] = card.largest_difference;
  json["fidelity"] = nlohmann::ordered_json::array();
  for (const FidelityItem& item : card.fidelity) {
    json["fidelity"].push_back(
        {{"item", item.item}, {"mapping", to_word(item.mapping)}, {"text", item.text}});
  }
  if (with_text) json["card"] = card.text;
  return json;
}

void report_losses(const Card& card, Streams& streams) {
  for (const FidelityItem& item : card.fidelity) {
    if (item.mapping == Mapping::kExact) continue;
    streams.err << "viscard: " << item.item << " " << to_word(item.mapping) << ": " << item.text
                << "\n";
  }
}

std::string companion_path(const std::string& out, const std::string& suffix) {
  return std::filesystem::path(out).replace_extension().string() + suffix;
}

}  // namespace

namespace {

// The material of a joint fit at one ratio, and what the header should say of it.
void take_ratio(const CardWords& words, PreparedMaterial& prepared) {
  const RatioFit fit = read_ratio_fit(words.material);
  if (!words.ratio) {
    std::string measured;
    for (const double ratio : fit.best.ratios) {
      measured += fmt::format("{}{:g}", measured.empty() ? "" : ", ", ratio);
    }
    throw UsageError(words.material + " is a joint fit; name the mixing ratio with --ratio R (" +
                     measured + " were measured, others between them follow the law)");
  }
  prepared.material = material_at_ratio(fit, *words.ratio, words.may_extrapolate);
  const auto& ratios = fit.best.ratios;
  const bool is_measured = std::find(ratios.begin(), ratios.end(), *words.ratio) != ratios.end();
  const bool is_outside = *words.ratio < ratios.front() || *words.ratio > ratios.back();
  const RatioModel& model = is_measured ? fit.best : fit.law;
  prepared.notes.push_back(
      fmt::format("mixing ratio {:g}: {}, from {} at {} ({:g} to {:g})", *words.ratio,
                  is_measured  ? "measured"
                  : is_outside ? "EXTRAPOLATED by the law in the ratio"
                               : "interpolated by the law in the ratio",
                  counted(static_cast<std::size_t>(model.n_specimens), "specimen"),
                  counted(ratios.size(), "ratio"), ratios.front(), ratios.back()));
  prepared.notes.push_back("form: " + form_in_words(model.form));
  const auto& flags = prepared.material.flags;
  const bool is_spread_known = std::none_of(
      flags.begin(), flags.end(), [](const MaterialFlag& f) { return f.name == "spread-unknown"; });
  if (is_spread_known) {
    prepared.notes.push_back(
        "the intervals are those of a new specimen: error of the law and scatter between "
        "specimens");
  }
}

}  // namespace

PreparedMaterial prepare_card_material(const CardWords& words) {
  PreparedMaterial prepared;
  if (looks_like_ratio_file(words.material)) {
    take_ratio(words, prepared);
  } else {
    if (words.ratio) {
      throw UsageError(words.material +
                       " is one material; --ratio needs a joint fit (viscard fit --joint)");
    }
    prepared.material = read_material(words.material).material;
  }
  prepared.sha256 = sha256_of_file(words.material);
  if (prepared.material.name.empty()) {
    prepared.material.name = std::filesystem::path(words.material).stem().string();
  }
  if (!words.bound.empty()) take_bound(words, prepared);
  if (!words.elastic_only.empty()) leave_relaxation_out(words, prepared);
  reduce_to_target(words, prepared);
  return prepared;
}

CardOptions card_options(const CardWords& words, const PreparedMaterial& prepared) {
  CardOptions options;
  options.units = words.units.empty() ? "SI" : words.units;
  options.is_reproducible = words.is_reproducible;
  options.may_approximate = words.may_approximate;
  options.accepts_flags = words.accepts_flags;
  options.clamped_nu = words.clamped_nu;
  options.created_at = now_iso8601();
  options.command = words.command_line;
  options.material_sha256 = prepared.sha256;
  options.notes = prepared.notes;
  if (prepared.terms_change) {
    options.done_before.push_back(
        {"terms", prepared.are_terms_dropped ? Mapping::kDropped : Mapping::kApproximated,
         *prepared.terms_change});
  }
  return options;
}

int write_card_file(const CardWords& words, Streams& streams) {
  const PreparedMaterial prepared = prepare_card_material(words);
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
    streams.out << json_of(card, words, words.out.empty()).dump(2) << "\n";
    return kDone;
  }
  if (words.out.empty()) {
    streams.out << card.text;
  } else {
    streams.out << "wrote " << words.out;
    for (const CompanionFile& companion : card.companions) {
      streams.out << " and " << companion_path(words.out, companion.suffix);
    }
    streams.out << fmt::format(" ({}, read back; E(t) within {:.1e} of the material)\n",
                               counted(card.written.terms.size(), "term"), card.largest_difference);
  }
  report_losses(card, streams);
  return kDone;
}

}  // namespace viscard
