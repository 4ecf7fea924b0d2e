#include "fit/assembly/bench_doubt.h"

#include "fit/assembly/stage_specimen.h"
#include "models/contact/punch_contact.h"

#include <cmath>

namespace viscard {
namespace {

constexpr double kSmallShare = 1e-3;  // of a standard deviation, so that effects are to first order

PronySeries scaled_series(PronySeries series, double factor) {
  series.equilibrium_modulus_Pa *= factor;
  for (MaxwellTerm& term : series.terms) term.modulus_Pa *= factor;
  return series;
}

// Relative changes from one series to another with as many terms, per standard deviation.
SystematicPart changes_between(const PronySeries& from, const PronySeries& to,
                               const std::string& cause) {
  const auto change = [](double before, double after) {
    return before > 0.0 && after > 0.0 ? std::log(after / before) / kSmallShare : 0.0;
  };
  const double from_0 = instantaneous_modulus_Pa(from), to_0 = instantaneous_modulus_Pa(to);
  SystematicPart part{cause, change(from_0, to_0), {}, {}};
  for (std::size_t i = 0; i < from.terms.size() && to.terms.size() == from.terms.size(); ++i) {
    const MaxwellTerm &a = from.terms[i], &b = to.terms[i];
    part.g.push_back(change(a.modulus_Pa / from_0, b.modulus_Pa / to_0));
    part.tau.push_back(change(a.relaxation_time_s, b.relaxation_time_s));
  }
  return part;
}

}  // namespace

std::vector<SystematicPart> systematic_parts_from(const PronySeries& specimen_N_m,
                                                  const BenchDoubt& doubt) {
  const double frame_N_m = doubt.frame_stiffness_N_m;
  const bool has_frame = frame_N_m > 0.0;
  const double s = has_frame ? instantaneous_modulus_Pa(specimen_N_m) / frame_N_m : 0.0;
  // A series without an equilibrium modulus reports only the change of E0.
  const bool is_solid = specimen_N_m.equilibrium_modulus_Pa > 0.0;
  const PronySeries stage_N_m = is_solid ? stage_series(specimen_N_m, frame_N_m) : PronySeries{};
  const auto part = [&](double relative_u, double forces, double frame, double of_E0,
                        const char* cause) {
    if (!has_frame || !is_solid) return SystematicPart{cause, of_E0 * relative_u, {}, {}};
    const double step = kSmallShare * relative_u;
    const PronySeries found = specimen_series(scaled_series(stage_N_m, 1.0 + forces * step),
                                              frame_N_m * (1.0 + frame * step));
    return changes_between(specimen_N_m, found, cause);
  };
  std::vector<SystematicPart> parts;
  if (has_frame && doubt.frame_relative_u > 0.0) {
    parts.push_back(part(doubt.frame_relative_u, 0.0, -1.0, s, kFrameCause));
  }
  if (doubt.force_relative_u > 0.0) {
    parts.push_back(part(doubt.force_relative_u, 1.0, 0.0, 1.0 + s, kLoadCellCause));
  }
  if (doubt.depth_relative_u > 0.0) {
    parts.push_back(part(doubt.depth_relative_u, 1.0, 0.0, 1.0 + s, kStageCause));
  }
  if (doubt.geometry_relative_u > 0.0) {
    parts.push_back({kGeometryCause, doubt.geometry_relative_u, {}, {}});
  }
  return parts;
}

SystematicPart gain_drift_part(const SpectralModel& model, const SpectralFit& fit,
                               const IndentationData& data, const FitResult& result) {
  const double factor_m = data.contact ? force_per_modulus_and_depth_m(*data.contact) : 1.0;
  PronySeries specimen_N_m{factor_m * result.E_inf_Pa, {}};
  for (const FittedTerm& term : result.terms) {
    specimen_N_m.terms.push_back({factor_m * term.modulus_Pa, term.tau_s});
  }
  const std::vector<SystematicPart> parts = systematic_parts_from(
      specimen_N_m, {.frame_stiffness_N_m = data.frame_stiffness_N_m,
                     .force_relative_u = gain_drift_relative_u(model, fit, data)});
  return parts.empty() ? SystematicPart{} : parts.front();
}

}  // namespace viscard
