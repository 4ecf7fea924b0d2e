#pragma once

#include "fit/intervals/fit_result.h"
#include "models/experiment/captured_run.h"
#include "models/experiment/emulated_specimen.h"
#include "models/experiment/specimen.h"
#include "models/material/material.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Creep or relaxation of the pillar: what the solver gave beside the exact answer, one quantity
// over time, and the largest relative error between them.
struct PillarCurve {
  std::string quantity;  // "force (uN)", the axis label
  std::vector<double> time_s, solver, exact;
  double largest_relative_error = 0.0;
};

struct PillarCheck {
  PillarCurve relaxation, creep;
  double limit = 1e-6;  // of the largest relative error
  std::string setup;    // one sentence: geometry, load, unknowns, steps
};

// A card for another solver, as written.
struct ReportCard {
  std::string target;     // "abaqus"
  std::string units;      // "mm-t-s"
  std::string file_name;  // "pdms_1to10.inp"
  std::string text;
  std::string refusal;  // why there is no text
};

// All that is known of one specimen; what is missing is left out of the page. At least a fit or a
// material must be there.
struct SpecimenReport {
  Specimen specimen;                   // id names the section; the material's name stands in for it
  std::optional<CapturedRun> run;      // raw record
  std::optional<FitResult> fit;        // estimates with data and residuals
  std::optional<Material> material;    // estimates as filed, when there is no fit
  std::optional<EmulatedTruth> truth;  // emulated rig only
  std::optional<PillarCheck> pillar;
  std::vector<ReportCard> cards;
  std::vector<RawFile> files;      // read for this specimen
  std::vector<std::string> notes;  // sentences a reader should see
};

// E0 over mixing ratio as a joint fit describes it.
struct MixingLaw {
  std::string text;  // one sentence with the formula
  std::vector<double> ratio, E0_Pa, E0_low_Pa, E0_high_Pa;
};

struct ReportInput {
  std::string title;
  std::string introduction;  // one paragraph, may be empty
  std::vector<SpecimenReport> specimens;
  std::optional<MixingLaw> law;
  std::string created_by;  // "viscard 0.1.0"
  std::string created_at;  // ISO 8601; empty in reproducible mode
  std::string command;     // command line that made the page
};

}  // namespace viscard
