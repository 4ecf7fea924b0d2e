#pragma once

#include "fit/intervals/fit_result.h"
#include "io/report/report_html.h"
#include "models/experiment/captured_run.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/specimen.h"
#include "models/material/material.h"
#include "models/material/scatter.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Creep or relaxation of the pillar: one quantity over time as the solver and the exact solution
// give it, and the largest relative difference.
struct PillarCheckCurve {
  std::string quantity;  // "force (uN)", the axis label
  std::vector<double> time_s, solver, exact;
  double largest_relative_error = 0.0;
};

struct PillarCheck {
  PillarCheckCurve relaxation, creep;
  double limit = 1e-6;  // largest relative error that is accepted
  std::string setup;    // one sentence: geometry, load, unknowns, steps
};

// Shift factors of a master curve, as taken and free; one value for each isotherm.
struct ShiftReport {
  double T_ref_C = 0.0;
  std::vector<double> temperature_C, log10_a, log10_a_se, free_log10_a, free_log10_a_se;
  std::string form_text;  // "WLF law"
  // The law of the material; empty without one.
  std::string law_text;  // "WLF, C1 = 8.9, C2 = 102 K"
  std::vector<double> law_temperature_C, law_log10_a;
};

// A material card for another solver.
struct ReportCard {
  std::string target;     // "abaqus"
  std::string units;      // "mm-t-s"
  std::string file_name;  // "pdms_1to10.inp"
  std::string text;
  std::string refusal;  // why the card was not written; then text is empty
};

// The data of one specimen. The page omits missing parts; a fit or a material is required.
struct SpecimenReport {
  Specimen specimen;  // its id is the section's title; without an id, the material's name
  std::optional<CapturedRun> run;      // raw record
  std::optional<FitResult> fit;        // estimates with data and residuals
  std::optional<ShiftReport> shift;    // of a master curve
  std::optional<Material> material;    // from its file; shown if there is no fit
  std::optional<EmulatedTruth> truth;  // emulated rig only
  std::optional<PillarCheck> pillar;
  std::vector<ReportCard> cards;
  std::vector<RawFile> files;      // that were read for this specimen
  std::vector<std::string> notes;  // sentences at the top of the section
};

// E0 over mixing ratio as a joint fit describes it.
struct MixingLaw {
  std::string text;  // one sentence with the formula
  std::vector<double> ratio, E0_Pa, E0_low_Pa, E0_high_Pa;
  std::vector<Scatter> scatter;  // between touches, specimens and ratios
};

// A law of rubber from tests at large strain, to stand beside the linear tests of its material.
struct RubberReport {
  std::string name;  // of its file
  std::string law;   // "yeoh", "yeoh+mullins-or"
  // Young's modulus at rest: at once, and after all relaxation. Equal without terms.
  double E0_Pa = 0.0, E_inf_Pa = 0.0;
  Interval E0_Pa_95, E_inf_Pa_95;
  std::vector<MaterialTerm> terms;      // g and tau_s; empty: elastic, at a rate that is not known
  double t_min_s = 0.0, t_max_s = 0.0;  // shortest step and longest test; 0: not known
  std::string stretches;                // "uniaxial 1 to 3"
  bool is_trustworthy = true;
};

struct ReportInput {
  std::string title;
  std::string introduction;  // one paragraph, may be empty
  std::string logo_uri;      // data_uri_of_picture(), may be empty
  std::vector<std::string>
      doubts;  // of the files that were read: "m.json: the file was edited ..."
  std::vector<SpecimenReport> specimens;
  std::optional<MixingLaw> law;
  std::vector<RubberReport> rubbers;
  std::string created_by;  // "viscard 0.1.0"
  std::string created_at;  // ISO 8601; empty in reproducible mode
  std::string command;     // command line that made the page
};

struct RenderedReport {
  std::string html;  // one self-contained page: no script, no external resource, pictures inline
  std::vector<ReportPicture> pictures;
};

// Makes the page. The same input gives the same bytes. Throws std::invalid_argument if there is no
// specimen, a specimen has neither fit nor material, or some specimens have moduli and others
// stiffnesses; std::runtime_error if gnuplot is not installed or fails.
RenderedReport render_report(const ReportInput& input);

}  // namespace viscard
