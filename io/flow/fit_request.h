#pragma once

#include "fit/fit_master_curve.h"
#include "fit/intervals/fit_result.h"
#include "fit/laws/fractional_diagnosis.h"
#include "fit/samples/fit_data.h"
#include "io/basics/option_use.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "io/tables/derived_columns.h"
#include "models/experiment/run_temperature.h"
#include "models/experiment/specimen.h"
#include "models/quantities/modulus_kind.h"
#include "models/quantities/plausible.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Poisson ratio where none is given: typical of rubber.
inline constexpr double kUsualNu = 0.495;

// Of the option --unverified, for the help of all commands that read captures.
inline constexpr const char* kUnverifiedHelp =
    "read a capture although its checksums show that description, events or moves are damaged, or "
    "the table of such a capture; the result states it";

// One of several tests of a material.
struct TestFile {
  FitKind kind = FitKind::kRelaxation;
  std::string path;
  bool is_in_memory = false;  // the path is only a name (FitRequest::in_memory)
};

// What to fit in a capture or a table, and how.
struct FitRequest {
  std::optional<FitKind> kind;  // none: the columns decide
  FitOptions options;
  ColumnMap columns;
  TableChoice table;
  SpecimenSize size;                  // for tables of load and extension, and of relative moduli
  std::vector<std::string> segments;  // use only rows of these; empty: all
  std::optional<double>
      time_zero_s;  // where t = 0 is in the table; none: at its 0, which is judged
  std::optional<double> from_s, to_s;  // only rows of these times, after time_zero_s
  int hold = 0;                        // only this hold with its ramp, from 1; 0: all
  bool crop = false;                   // only the part that a fit of one ramp describes
  // Depth of a record of force at constant depth; without it the results are forces.
  std::optional<double> depth_m;
  std::optional<Specimen> specimen;  // replaces the specimen of a capture
  bool diagnose = false;             // compare with other laws (FitResult::laws)
  std::string model;                 // a law of fit/laws/law_values.h as the answer; empty: series
  bool needs_specimen = false;       // a table of several specimens is refused
  bool needs_modulus = false;        // a stiffness is refused, because a material will be written
  double frame_stiffness_N_m = 0.0;  // for tables whose depth_m is the position of the stage
  // The user stated the kind of test of this file: other columns are refused.
  bool is_one_of_several = false;
  // The request is for other files, too: options that this one cannot use are not refused, but
  // stand in FittedFile::uses.
  bool is_beside_others = false;
  // Of the moduli, compliances and stresses in a table; none: its headers or its format decide.
  std::optional<ModulusKind> modulus_kind;
  std::optional<double> nu;   // converts other moduli to Young's; none: 0.495
  double young_factor = 1.0;  // Young's modulus over the moduli of this table; set by fit_table()
  std::optional<double> T_ref_C;  // reference temperature of a master curve
  // Rows of this table before the test, in which the rig touched; set by fit_csv().
  ForceDepthRows before_test;
  std::vector<StartShift> start_shifts;        // MasterData::start_shifts
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value, and flags the result
  // Fit a capture whose description, events or moves are damaged; the result is flagged "unverified".
  bool accepts_unverified = false;
  // Tables that stand for files, by the path that names them: arrays of a program. May be null.
  std::shared_ptr<const std::map<std::string, CsvTable>> in_memory;
};

// What a table of moduli was measured in, and how it became Young's modulus.
struct MeasuredModulus {
  ModulusKind kind = ModulusKind::kTension;
  std::string from;  // what states the kind: "the header 'G(t)'", "--modulus-kind"; "": assumed
  double nu = 0.5;   // of the conversion
  bool is_nu_stated = false;
  std::optional<Interval> nu_95;  // if it was fitted, from tests in shear and in tension together
  std::string assumed_header;     // of a column that states no kind, taken as of tension
  double young_factor() const { return young_over(kind, nu); }
};

// The fit of one file, with the specimen that the file or the options describe.
struct FittedFile {
  std::string path;
  bool is_in_memory = false;  // the path is only a name; there is no such file
  FitResult result;
  Specimen specimen;        // empty for a table without --specimen
  std::string specimen_id;  // of the capture, or of the table's column "specimen"; empty: not known
  std::vector<std::string> notes;  // how the record was read, where that was not plain
  std::string maker;               // whose file it is, if it was recognised ("JPK force curve")
  std::string fitted_unit;         // unit of the fitted column: "N", "Pa", "1/Pa"
  // Rows of an exported capture before its first baseline, which are not fitted.
  std::size_t n_before_test = 0;
  std::optional<MeasuredModulus> modulus;  // nothing: force and depth, or several tests
  std::string chosen;         // the part that --from, --to, --hold or --crop chose; empty: all
  bool has_no_depth = false;  // the results are forces in N, because the depth is unknown
  // By the thermometer of the run; nothing if there was none.
  std::optional<RunTemperature> temperature;
  // For a table of several temperatures; `result` is then the fit at the reference temperature.
  std::optional<MasterCurve> master;
  // If FitRequest::diagnose is set, of a relaxation after a step.
  std::optional<FractionalDiagnosis> fractional;
  std::vector<TestFile> tests;  // the files of kSeveral; path joins their names
  std::string model;            // the law that `result` is written from; empty: a series
  OptionUses uses;              // which options have an effect on this file
};

}  // namespace viscard
