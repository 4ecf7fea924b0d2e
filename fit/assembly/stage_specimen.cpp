#include "fit/assembly/stage_specimen.h"

#include "fit/assembly/assemble_result.h"
#include "models/contact/punch_contact.h"
#include "models/material/retardation_spectrum.h"
#include "models/maths/text_of_number.h"

#include <stdexcept>

namespace viscard {

PronySeries specimen_series(const PronySeries& stage_series_N_m, double frame_stiffness_N_m) {
  if (!(frame_stiffness_N_m > 0.0)) return stage_series_N_m;
  RetardationSpectrum compliance = retardation_from_relaxation(stage_series_N_m);
  compliance.instantaneous_compliance_1_Pa -= 1.0 / frame_stiffness_N_m;
  if (!(compliance.instantaneous_compliance_1_Pa > 0.0)) {
    throw std::runtime_error("the frame stiffness of " + text_of(frame_stiffness_N_m) +
                             " N/m is below the measured stiffness (" +
                             text_of(instantaneous_modulus_Pa(stage_series_N_m)) +
                             " N/m): nothing is left for the specimen. Measure it again: viscard "
                             "calibrate --compliance");
  }
  return relaxation_from_retardation(compliance);
}

PronySeries stage_series(const PronySeries& specimen_series_N_m, double frame_stiffness_N_m) {
  if (!(frame_stiffness_N_m > 0.0)) return specimen_series_N_m;
  RetardationSpectrum compliance = retardation_from_relaxation(specimen_series_N_m);
  compliance.instantaneous_compliance_1_Pa += 1.0 / frame_stiffness_N_m;
  return relaxation_from_retardation(compliance);
}

SeriesFromState specimen_series_of(const SpectralModel& model, const IndentationData& data,
                                   bool is_liquid) {
  const double factor_m = data.contact ? force_per_modulus_and_depth_m(*data.contact) : 1.0;
  const SeriesFromState of_stage = relaxation_series_of(model, is_liquid);
  const double frame_N_m = data.frame_stiffness_N_m;
  return [of_stage, factor_m, frame_N_m](const SpectralState& state) {
    PronySeries series = specimen_series(of_stage(state), frame_N_m);
    series.equilibrium_modulus_Pa /= factor_m;
    for (MaxwellTerm& term : series.terms) term.modulus_Pa /= factor_m;
    return series;
  };
}

}  // namespace viscard
