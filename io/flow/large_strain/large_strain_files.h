#pragma once

#include "fit/large_strain/fit_large_strain.h"
#include "io/plots/plot.h"
#include "io/tables/column_map.h"
#include "io/tables/csv_table.h"
#include "io/tables/derived_columns.h"

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// A file of one test at large strain.
struct LargeStrainFile {
  Deformation deformation = Deformation::kUniaxial;
  bool is_compression = false;
  std::string path;
  std::shared_ptr<const CsvTable> in_memory = nullptr;  // stands for the file, if it is given
  FoamTest foam_test = FoamTest::kUniaxial;             // of a foam
  bool is_foam_only = false;                            // no test of a rubber
};

// The words of a command that name tests at large strain: "planar=b.csv". Kinds: uniaxial (or
// tension), compression, planar (or pure-shear), equibiaxial (or biaxial); of foams confined (or oedometer),
// volumetric (or hydrostatic), shear. Empty if no word does. A
// word is a plain file if a file of that name exists. Throws std::invalid_argument for other files
// beside tests at large strain, and for a test without a file.
std::vector<LargeStrainFile> large_strain_from_words(const std::vector<std::string>& words);

// What to fit, and how.
struct LargeStrainRequest {
  std::vector<LargeStrainFile> files;
  ColumnMap columns;
  TableChoice table;  // in each file
  SpecimenSize size;  // for tables of load and extension
  LargeStrainOptions options;
  // Of records with unloading: fit the loading of this cycle, from 1; 0: all rows; none: of the last.
  std::optional<int> cycle;
  Plausible plausible = Plausible::kMeasured;  // kOff accepts any value, and flags the result
  bool accepts_unverified = false;  // of tables of damaged captures; the result is flagged
};

// What was taken of a record with cycles.
struct CycleChoice {
  std::size_t n_cycles = 0, n_left_out = 0;  // rows that are not fitted
  std::size_t fitted = 0;                    // cycle, from 1; 0: all rows
  std::optional<double> softening;           // fit/large_strain/load_cycles.h
};

// Tests and fitted laws.
struct FittedLargeStrain {
  std::vector<LargeStrainFile> files;
  std::vector<LargeStrainTest> tests;  // one for each file, with the fitted rows
  std::vector<CycleChoice> cycles;     // of each test
  std::vector<std::string> sums;       // SHA-256 of each file as it was read; empty: in memory
  LargeStrainResult result;
};

// Reads the tables and fits the laws. A table has the stretch (or nominal strain) and the nominal
// stress: force over area at rest. Of a foam it may have lateral_stretch (or lateral_strain); a volumetric test
// may have volume_ratio and pressure_Pa, and shear has strain (the tangent of its angle) and stress. The strains and stresses of a compression test may be counted
// positive. Times (time_s) in all tables give terms of relaxation beside the law. Of a record with
// unloading one loading is fitted, of one with times and a single cycle, or with damage, all rows; softening by more than 5 % that is not fitted gives the note mullins. Throws std::runtime_error with the name
// of the file, also for stretches, stresses and a modulus that are not plausible.
FittedLargeStrain fit_large_strain_files(const LargeStrainRequest& request);

// The keys of `viscard fit --json`: laws with intervals, tests, flags.
void show_keys(ResultVisitor& v, const FittedLargeStrain& fitted);
// The same as the text of a file, with its schema.
std::string file_of_large_strain(const FittedLargeStrain& fitted);

// Prints tests, laws and the parameters of the chosen one.
void print_large_strain(const FittedLargeStrain& fitted, std::ostream& out);

// Stress against stretch: readings, the chosen law with its 95 % band, dashed where no test measured.
Plot plot_of_large_strain(const FittedLargeStrain& fitted);

}  // namespace viscard
