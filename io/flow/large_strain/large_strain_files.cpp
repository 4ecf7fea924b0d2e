#include "io/flow/large_strain/large_strain_files.h"

#include "fit/large_strain/load_cycles.h"
#include "fit/large_strain/rubber_term_checks.h"
#include "io/flow/plausible_record.h"
#include "io/flow/test_words.h"
#include "io/materials/plausible_numbers.h"
#include "io/tables/column_proposal.h"
#include "io/tables/csv_table.h"
#include "io/tables/modulus_of_columns.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

using Column = std::vector<double>;

std::optional<LargeStrainFile> large_strain_file(const std::string& word) {
  const std::size_t sign = word.find('=');
  std::error_code error;
  if (sign == std::string::npos || std::filesystem::exists(word, error)) return std::nullopt;
  const std::string kind = word.substr(0, sign), path = word.substr(sign + 1);
  for (const LargeStrainKind& known : large_strain_kinds()) {
    if (kind != known.word) continue;
    if (path.empty()) throw std::invalid_argument(word + " names no file; write " + kind + "=FILE");
    return LargeStrainFile{known.deformation, known.is_compression, path,
                           nullptr,           known.foam_test,      known.is_foam_only};
  }
  return std::nullopt;
}

// Flags what is doubtful about a fitted law, or throws for one that no rubber has.
void judge_rubber(const std::vector<CsvTable>& tables, const LargeStrainRequest& request,
                  LargeStrainResult& result) {
  static const std::vector<std::string> kColumns{"nominal_stress_Pa", "stress_Pa", "time_s",
                                                 "strain"};
  for (const CsvTable& table : tables) {
    for (const std::string& note : table.notes) {
      result.notes.push_back({"as-read", 0, table.file + ": " + note});
    }
    if (const auto flag = assumed_units(table, request.columns, kColumns)) {
      result.notes.push_back(*flag);
    }
  }
  if (request.plausible == Plausible::kOff) return flag_plausible_off(result.notes);
  refuse_modulus(result.best().E0_Pa, &tables.front(), request.columns, request.plausible);
}

// Stretches of a table, from a column of stretches or of nominal strains.
Column stretches_of(const CsvTable& table, const ColumnMap& columns) {
  if (find_column(table, "stretch", columns)) return column_SI(table, "stretch", columns);
  if (!find_column(table, "strain", columns)) {
    throw std::runtime_error(
        table.file + ": has no column of the stretch or the nominal strain. The columns are " +
        columns_with_values(table) +
        (find_column(table, "force_N", columns)
             ? ". State --gauge-length and --area of the specimen for load and extension, or name"
             : ". Name") +
        " one with --column stretch=\"HEADER\" or --column strain=\"HEADER\"");
  }
  Column stretch = column_SI(table, "strain", columns);
  for (double& value : stretch) value += 1.0;
  return stretch;
}

Column stresses_of(const CsvTable& table, const ColumnMap& columns) {
  for (const char* name : {"nominal_stress_Pa", "stress_Pa"}) {
    if (find_column(table, name, columns)) return column_SI(table, name, columns);
  }
  throw std::runtime_error(
      table.file +
      ": has no column of the nominal stress (force over area at rest). The columns are " +
      columns_with_values(table) + ". Name one with --column nominal_stress_Pa=\"HEADER\"");
}

// Strains and stresses of compression that are counted positive become stretches below 1.
void turn_compression(LargeStrainTest& test, const std::string& file) {
  const auto is_above = [](double stretch) { return stretch > 1.0; };
  if (std::none_of(test.stretch.begin(), test.stretch.end(), is_above)) return;
  const bool all_above = std::none_of(test.stretch.begin(), test.stretch.end(),
                                      [](double stretch) { return stretch < 1.0; });
  const bool is_full = std::any_of(test.stretch.begin(), test.stretch.end(),
                                   [](double stretch) { return stretch >= 2.0; });
  if (!all_above || is_full) {
    throw std::runtime_error(file +
                             ": a compression test has stretches below 1, or strains between 0 "
                             "and 1 that are counted positive; these are neither");
  }
  for (double& stretch : test.stretch) stretch = 2.0 - stretch;
  for (double& stress : test.nominal_stress_Pa) stress = -stress;
}

// A volumetric test by pressure and change of volume: stretches and nominal stresses of its three sides.
void take_volumetric(const CsvTable& table, const ColumnMap& columns, LargeStrainTest& test) {
  const Column ratio = column_SI(table, "volume_ratio", columns);
  const Column pressure_Pa = column_SI(table, "pressure_Pa", columns);
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    const double stretch = std::cbrt(ratio[i]);
    test.stretch.push_back(stretch);
    test.nominal_stress_Pa.push_back(-pressure_Pa[i] * stretch * stretch);
  }
}

// The measured quantities of a test of a foam, and its lateral stretches.
void take_foam_columns(const CsvTable& table, const ColumnMap& columns, LargeStrainTest& test) {
  if (test.foam_test == FoamTest::kVolumetric && find_column(table, "volume_ratio", columns)) {
    take_volumetric(table, columns, test);
    return;
  }
  if (test.foam_test == FoamTest::kShear) {
    test.stretch = column_SI(table, "strain", columns);
  } else {
    test.stretch = stretches_of(table, columns);
  }
  test.nominal_stress_Pa = stresses_of(table, columns);
  if (find_column(table, "lateral_stretch", columns)) {
    test.lateral_stretch = column_SI(table, "lateral_stretch", columns);
  } else if (find_column(table, "lateral_strain", columns)) {
    test.lateral_stretch = column_SI(table, "lateral_strain", columns);
    for (double& value : test.lateral_stretch) value += 1.0;
  }
  const bool has_side = test.foam_test == FoamTest::kUniaxial ||
                        test.foam_test == FoamTest::kPlanar ||
                        test.foam_test == FoamTest::kEquibiaxial;
  if (!has_side) test.lateral_stretch.clear();
}

LargeStrainTest test_of_file(const LargeStrainFile& file, const CsvTable& table,
                             const LargeStrainRequest& request) {
  const bool is_foam = !request.options.foam_terms.empty();
  LargeStrainTest test{file.is_foam_only     ? name_of(file.foam_test)
                       : file.is_compression ? "compression"
                                             : name_of(file.deformation),
                       file.deformation,
                       {},
                       {}};
  test.foam_test = file.foam_test;
  if (is_foam) {
    take_foam_columns(table, request.columns, test);
  } else {
    test.stretch = stretches_of(table, request.columns);
    test.nominal_stress_Pa = stresses_of(table, request.columns);
  }
  const TableModulusKind kind = modulus_kind_of(table, request.columns, {"stress_Pa", "strain"});
  const bool is_shear = is_foam && test.foam_test == FoamTest::kShear;
  if (kind.kind == ModulusKind::kShear && !kind.from.empty() && !is_shear) {
    throw std::runtime_error(file.path + ": " + kind.from +
                             " speaks of shear, but this is a test in " + test.name);
  }
  // Tests that only foams have may go to both sides of rest; a strain that is counted positive does not.
  const bool has_compression = std::any_of(test.stretch.begin(), test.stretch.end(),
                                           [](double stretch) { return stretch < 1.0; });
  const bool has_signs =
      has_compression || find_column(table, "volume_ratio", request.columns).has_value();
  if (file.is_compression && !(file.is_foam_only && has_signs)) turn_compression(test, file.path);
  if (find_column(table, "time_s", request.columns)) {
    test.time_s = column_SI(table, "time_s", request.columns);
  }
  return test;
}

// A record of cycles whose times fall as often as it has cycles, or more, is not in the order of the test.
void check_order(const LargeStrainTest& test, const std::string& file, std::size_t n_cycles) {
  std::size_t n_falls = 0, row = 0;
  for (std::size_t i = 1; i < test.time_s.size(); ++i) {
    if (!(test.time_s[i] < test.time_s[i - 1])) continue;
    if (n_falls++ == 0) row = i;
  }
  if (n_falls < n_cycles || n_falls == 0) return;
  throw std::runtime_error(
      file + ": the times do not ascend: they fall " + std::to_string(n_falls) +
      " times, first from " + text_of(test.time_s[row - 1]) + " s to " + text_of(test.time_s[row]) +
      " s in reading " + std::to_string(row + 1) +
      ", so that loading and unloading cannot be distinguished; sort the rows by time, or give "
      "--cycle all");
}

// The volume of a foam changes, so that its area while loaded is not known.
void refuse_true_stress(const CsvTable& table, const ColumnMap& columns) {
  const bool has_nominal =
      find_column(table, "nominal_stress_Pa", columns) || find_column(table, "stress_Pa", columns);
  if (has_nominal || !find_column(table, "true_stress_Pa", columns)) return;
  throw std::runtime_error(
      table.file +
      ": has the true stress alone, but the area of a foam while loaded does "
      "not follow from its stretch; give nominal_stress_Pa (force over area at "
      "rest)");
}

// Puts the rows of a table without times in order, where they are one curve. Throws for rows that jump back
// and forth and are none: neither cycles nor a loading can be told from them.
void check_rows(LargeStrainTest& test, const std::string& file) {
  constexpr double kMostTurns = 0.5;
  if (is_unsorted_curve(test)) {
    test = sorted_by_stretch(test);
  } else if (const double turns = share_of_turns(test.stretch);
             !has_times(test) && turns > kMostTurns) {
    throw std::runtime_error(
        file + ": the stretch turns back in " + text_of(100.0 * turns, 2) +
        " % of the readings, so that they are no cycles of loading and unloading (at most " +
        text_of(100.0 * kMostTurns, 2) +
        " %); sort the rows by stretch, add a column time_s, or give --cycle all");
  }
}

// What rises while a test loads: the stretch, of shear one that rises with the size of its tangent.
Column loading_measure(const LargeStrainTest& test) {
  Column measure = test.stretch;
  if (test.foam_test == FoamTest::kShear) {
    for (double& value : measure) value = 1.0 + std::abs(value);
  }
  return measure;
}

// Keeps the loading of one cycle, if the record has unloading. Relaxation is fitted to all rows of a
// record with one cycle, damage to all rows of any.
CycleChoice choose_cycle(LargeStrainTest& test, const std::string& file,
                         const std::optional<int>& wanted, bool relaxes, bool with_damage) {
  if (!wanted || *wanted != 0) check_rows(test, file);
  const std::vector<LoadCycle> cycles = load_cycles(loading_measure(test));
  const bool is_one_loading =
      cycles.empty() ||
      (cycles.size() == 1 && cycles[0].last == cycles[0].peak && cycles[0].first == 0);
  CycleChoice choice{cycles.size(), 0, 0, std::nullopt};
  if (test.foam_test != FoamTest::kShear) choice.softening = softening(test, cycles);
  if (wanted && *wanted > static_cast<int>(cycles.size())) {
    throw std::runtime_error(file + ": has " + counted(cycles.size(), "cycle") +
                             " of loading, so there is no --cycle " + std::to_string(*wanted));
  }
  if (with_damage) check_order(test, file, cycles.size());
  if (is_one_loading || with_damage || (wanted && *wanted == 0)) return choice;
  if (relaxes && !wanted && cycles.size() == 1) return choice;
  check_order(test, file, cycles.size());
  choice.fitted = wanted ? static_cast<std::size_t>(*wanted) : cycles.size();
  const std::size_t n_all = test.stretch.size();
  test = loading_of(test, cycles[choice.fitted - 1]);
  choice.n_left_out = n_all - test.stretch.size();
  return choice;
}

void add_mullins_note(const std::string& name, const CycleChoice& choice,
                      LargeStrainResult& result) {
  constexpr double kLeast = 0.05;
  if (!choice.softening || *choice.softening < kLeast || result.best().damage) return;
  result.notes.push_back(
      {"mullins", 0,
       "the " + name + " test softens by " + text_of(100.0 * *choice.softening, 2) +
           " % from its first to its last cycle at equal stretch (Mullins "
           "effect): the law is that of " +
           (choice.fitted == 0 ? std::string("all rows together")
                               : "cycle " + std::to_string(choice.fitted)) +
           "; choose another with --cycle" +
           (result.best().foam ? std::string()
                               : ", or fit the softening with --model " +
                                     name_of(result.best().law.form) + "+" + kMullinsName)});
}

// "uniaxial", "uniaxial 2" ...
void number_names(std::vector<LargeStrainTest>& tests) {
  for (std::size_t i = tests.size(); i-- > 0;) {
    const auto before =
        std::count_if(tests.begin(), tests.begin() + static_cast<std::ptrdiff_t>(i),
                      [&](const LargeStrainTest& other) { return other.name == tests[i].name; });
    if (before > 0) tests[i].name += " " + std::to_string(before + 1);
  }
}

// A copy in another unit or with other line ends has another content, but the same readings.
bool are_same(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kReading = 1e-5;  // of the largest
  if (a.size() != b.size() || a.empty()) return false;
  double largest = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i]));
    apart = std::max(apart, std::abs(a[i] - b[i]));
  }
  return apart <= kReading * largest;
}

void refuse_copies(const std::vector<LargeStrainTest>& tests,
                   const std::vector<LargeStrainFile>& files) {
  for (std::size_t i = 0; i < tests.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (tests[k].deformation != tests[i].deformation ||
          !are_same(tests[k].stretch, tests[i].stretch) ||
          !are_same(tests[k].nominal_stress_Pa, tests[i].nominal_stress_Pa)) {
        continue;
      }
      throw std::runtime_error(files[i].path + " holds the same readings as " + files[k].path +
                               "; each record counts once. Remove one of the two");
    }
  }
}

}  // namespace

std::vector<LargeStrainFile> large_strain_from_words(const std::vector<std::string>& words) {
  std::vector<LargeStrainFile> files;
  std::string other;
  for (const std::string& word : words) {
    if (auto file = large_strain_file(word)) {
      files.push_back(std::move(*file));
    } else if (other.empty()) {
      other = word;
    }
  }
  if (files.empty() || other.empty()) return files;
  throw std::invalid_argument(
      other +
      " is no test at large strain, but others are; write uniaxial=FILE, compression=FILE, "
      "planar=FILE or equibiaxial=FILE, or fit the files apart");
}

FittedLargeStrain fit_large_strain_files(const LargeStrainRequest& request) {
  FittedLargeStrain fitted;
  fitted.files = request.files;
  std::vector<CsvTable> tables;
  OptionUses uses;
  for (const LargeStrainFile& file : request.files) {
    tables.push_back(file.in_memory ? *file.in_memory : read_csv(file.path, request.table));
    tables.back().judged = request.plausible;
    std::size_t n_gaps = 0;
    if (!request.options.foam_terms.empty()) refuse_true_stress(tables.back(), request.columns);
    const SpecimenSize used = derive_columns(tables.back(), request.columns,
                                             size_from_notes(tables.back(), request.size));
    add_uses(uses_of(request.size, used), uses);
    tables.back() =
        rows_without_gaps(std::move(tables.back()),
                          {"time_s", "strain", "stretch", "stress_Pa", "nominal_stress_Pa",
                           "lateral_stretch", "lateral_strain", "volume_ratio", "pressure_Pa"},
                          request.columns, n_gaps);
    if (n_gaps > 0) {
      tables.back().notes.push_back(counted(n_gaps, "row") + " without a number left out");
    }
    fitted.tests.push_back(test_of_file(file, tables.back(), request));
  }
  refuse_idle(uses);
  refuse_copies(fitted.tests, request.files);
  number_names(fitted.tests);
  std::vector<MaterialFlag> notes;  // those of the fitted rows are made by the fit
  const bool with_damage = request.options.with_damage;
  const bool is_foam = !request.options.foam_terms.empty();
  const bool relaxes =
      !with_damage && !is_foam && most_terms_of(fitted.tests, request.options, notes) > 0;
  for (std::size_t i = 0; i < fitted.tests.size(); ++i) {
    fitted.cycles.push_back(
        choose_cycle(fitted.tests[i], request.files[i].path, request.cycle, relaxes, with_damage));
  }
  fitted.result = fit_large_strain(fitted.tests, request.options);
  for (std::size_t i = 0; i < fitted.tests.size(); ++i) {
    add_mullins_note(fitted.tests[i].name, fitted.cycles[i], fitted.result);
  }
  judge_rubber(tables, request, fitted.result);
  return fitted;
}

}  // namespace viscard
