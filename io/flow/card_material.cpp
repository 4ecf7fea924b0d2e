#include "io/flow/card_material.h"

#include "fit/reduce_terms.h"
#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/card.h"
#include "io/cards/targets/card_targets.h"
#include "io/materials/material_file.h"
#include "io/materials/plausible_numbers.h"
#include "models/material/liquid.h"
#include "models/material/material_bound.h"
#include "models/material/series_band.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace viscard {
namespace {

// Without a covariance: E0 and E_inf are taken at the same end of their intervals, and the
// difference is shared among the terms in the fitted proportions. Taking every modulus at its own
// end would leave the joint interval, because the moduli of one fit are correlated.
void take_both_ends(const CardMaterialRequest& request, IntervalEnd end,
                    PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const double E0_Pa = end_of_E0_Pa(material, end), E_inf_Pa = end_of_E_inf_Pa(material, end);
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
      request.bound,
      material.uncertainty->systematic_relative > 0.0 ? ", systematic part included" : "",
      is_between ? "" : "; the shares g are as fitted"));
  material.uncertainty.reset();
}

void take_bound(const CardMaterialRequest& request, PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const IntervalEnd end = request.bound == "lower" ? IntervalEnd::kLower : IntervalEnd::kUpper;
  if (!material.uncertainty || !(material.uncertainty->E0_Pa_95.high > 0.0)) {
    throw std::runtime_error(request.material +
                             " states no intervals, so it has no bounds; fit it from data first");
  }
  const double E0_Pa = end_of_E0_Pa(material, end);
  if (!(E0_Pa > 0.0) || !std::isfinite(E0_Pa)) {
    throw std::runtime_error("the " + request.bound + " bound of E0 is no modulus (" +
                             fmt::format("{:g}", E0_Pa) + " Pa); the data do not show it");
  }
  if (!has_band(material)) return take_both_ends(request, end, prepared);
  const bool has_systematic = material.uncertainty->systematic_relative > 0.0;
  material = material_at_end(material, end);
  prepared.notes.push_back(fmt::format(
      "bound: E0 at the {} end of the 95 % interval{}; all other parameters follow by their "
      "covariance with it",
      request.bound, has_systematic ? ", systematic part included" : ""));
}

// The material at one temperature, without its shift.
void take_temperature(double temperature_C, PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const Material shifted = material_at_temperature(material, temperature_C);
  const TemperatureShift& shift = *material.shift;
  const bool is_outside = (shift.T_min_C != 0.0 || shift.T_max_C != 0.0) &&
                          (temperature_C < shift.T_min_C || temperature_C > shift.T_max_C);
  prepared.notes.push_back(fmt::format(
      "temperature: the card holds at {:g} C only; the times are {:.6g} of those at {:g} C{}",
      temperature_C, std::exp(ln_shift_factor(shift, temperature_C)), shift.T_ref_C,
      is_outside ? fmt::format(", EXTRAPOLATED from {:g} to {:g} C", shift.T_min_C, shift.T_max_C)
                 : ""));
  const double a_T = std::exp(ln_shift_factor(shift, temperature_C));
  material = shifted;
  if (!material.uncertainty) return;
  for (TermUncertainty& term : material.uncertainty->terms) {
    term.tau_s_95 = {term.tau_s_95.low * a_T, term.tau_s_95.high * a_T};
  }
}

void leave_relaxation_out(const CardMaterialRequest& request, PreparedMaterial& prepared) {
  Material& material = prepared.material;
  const DerivedModuli moduli = derived_moduli(material);
  if (request.elastic_only == "long-term") {
    material.E0_Pa = moduli.E_inf_Pa;
    material.nu = moduli.nu_inf;
  }
  prepared.terms_change = fmt::format("{} relaxation terms left out, the {} modulus kept",
                                      material.terms.size(), request.elastic_only);
  prepared.are_terms_dropped = true;
  material.terms.clear();
  material.uncertainty.reset();
  material.flags.clear();
}

void reduce_to_target(const CardMaterialRequest& request, PreparedMaterial& prepared) {
  const int limit = card_target(request.target).max_terms;
  const int given = static_cast<int>(prepared.material.terms.size());
  int wanted = request.terms.value_or(given);
  if (limit > 0) wanted = std::min(wanted, limit);
  if (request.terms && *request.terms > given) {
    prepared.notes.push_back(fmt::format("--terms {} left the material as it is, with {}",
                                         *request.terms,
                                         counted(static_cast<std::size_t>(given), "term")));
  }
  if (!request.may_approximate || wanted >= given) return;
  const ReducedMaterial reduced = reduce_material(prepared.material, wanted);
  prepared.terms_change =
      fmt::format("{} refitted to {}, E(t) within {:.2e} from {:g} s to {:g} s", given, wanted,
                  reduced.largest_error, reduced.t_min_s, reduced.t_max_s);
  prepared.original = prepared.material;
  prepared.material = reduced.material;
  prepared.material.valid.t_min_s = reduced.t_min_s;
  prepared.material.valid.t_max_s = reduced.t_max_s;
}

// The material of a joint fit at one ratio, with notes for the header of the card.
void take_ratio(const CardMaterialRequest& request, PreparedMaterial& prepared) {
  const RatioFit fit = read_ratio_fit(request.material, request.plausible);
  if (!request.ratio)
    throw std::invalid_argument(request.material + " is a joint fit; it needs a ratio");
  prepared.material = material_at_ratio(fit, *request.ratio, request.may_extrapolate);
  refuse_implausible(request.material + fmt::format(" at ratio {:g}", *request.ratio),
                     prepared.material, request.plausible);
  const auto& ratios = fit.best.ratios;
  const bool is_measured = std::find(ratios.begin(), ratios.end(), *request.ratio) != ratios.end();
  const bool is_outside = *request.ratio < ratios.front() || *request.ratio > ratios.back();
  const RatioModel& model = is_measured ? fit.best : fit.law;
  prepared.notes.push_back(
      fmt::format("mixing ratio {:g}: {}, from {} at {} ({:g} to {:g})", *request.ratio,
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

// A misspelt word would otherwise count as one of these.
void check_word(const char* option, const std::string& word,
                const std::vector<std::string>& known) {
  if (word.empty() || std::find(known.begin(), known.end(), word) != known.end()) return;
  throw std::invalid_argument(no_such_word(option, word, known));
}

void take_changes(const CardMaterialRequest& request, PreparedMaterial& prepared) {
  check_word("--bound", request.bound, {"lower", "upper"});
  check_word("--elastic-only", request.elastic_only, {"instantaneous", "long-term"});
  if (prepared.material.name.empty()) {
    prepared.material.name = std::filesystem::path(request.material).stem().string();
  }
  if (request.temperature_C) take_temperature(*request.temperature_C, prepared);
  if (!request.bound.empty()) take_bound(request, prepared);
  if (!request.elastic_only.empty()) leave_relaxation_out(request, prepared);
  reduce_to_target(request, prepared);
}

}  // namespace

PreparedMaterial prepare_card_material(const CardMaterialRequest& request) {
  PreparedMaterial prepared;
  if (looks_like_ratio_file(request.material)) {
    take_ratio(request, prepared);
  } else {
    if (request.ratio)
      throw std::invalid_argument(request.material + " is one material; it has no ratio");
    prepared.material = read_material(request.material, request.plausible).material;
    refuse_liquid(prepared.material, request.material);
  }
  prepared.sha256 = sha256_as_read(request.material);
  prepared.file = std::filesystem::path(request.material).filename().string();
  take_changes(request, prepared);
  return prepared;
}

PreparedMaterial prepare_card_material(const Material& material,
                                       const CardMaterialRequest& request) {
  PreparedMaterial prepared;
  prepared.material = material;
  refuse_liquid(material, request.material);
  take_changes(request, prepared);
  return prepared;
}

void state_changes(const PreparedMaterial& prepared, CardOptions& options) {
  options.material_sha256 = prepared.sha256;
  options.material_file = prepared.file;
  options.notes = prepared.notes;
  options.original = prepared.original;
  if (!prepared.terms_change) return;
  options.done_before.push_back(
      {"terms", prepared.are_terms_dropped ? Mapping::kDropped : Mapping::kApproximated,
       *prepared.terms_change});
}

}  // namespace viscard
