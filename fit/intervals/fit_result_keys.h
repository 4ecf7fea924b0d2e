#pragma once

#include "fit/intervals/fit_result.h"
#include "models/maths/result_visitor.h"

#include <string>

namespace viscard {

// What the values of a fit are called, by their unit: E0_Pa, K0_N_m without geometry, F0_N without a depth.
struct ModulusNames {
  std::string letter = "E", stem = "modulus", unit = "_Pa";
};
ModulusNames modulus_names(bool is_stiffness, bool has_no_depth = false);

// The keys of a fit in groups, because a file of a fit shows others between them.
void show_moduli(ResultVisitor& v, const FitResult& fit, const ModulusNames& names);
void show_quality(ResultVisitor& v, const FitResult& fit);
void show_systematic(ResultVisitor& v, const FitResult& fit, const ModulusNames& names);
// Moduli at the ends of what was measured: at the first sample and at the highest frequency.
void show_measured_ends(ResultVisitor& v, const FitResult& fit, const ModulusNames& names);
// fitted_unit: of the fitted column.
void show_lack_of_fit(ResultVisitor& v, const FitResult& fit, const std::string& fitted_unit);
// The window, and what the fit found out about the rig.
void show_rig(ResultVisitor& v, const FitResult& fit);
// file: of the test; empty: not known.
void show_keys(ResultVisitor& v, const FittedTest& test, const std::string& file);
void show_keys(ResultVisitor& v, const FittedLaw& law);
void show_keys(ResultVisitor& v, const ProfileCurve& profile);
void show_keys(ResultVisitor& v, const ContinuousSpectrum& spectrum);
void show_keys(ResultVisitor& v, const NoiseEstimate& noise);
// Only for values in memory.
void show_arrays(ResultVisitor& v, const FitResult& fit);

}  // namespace viscard
