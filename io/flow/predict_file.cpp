#include "io/flow/predict_file.h"

#include "fit/samples/noise_model.h"
#include "io/basics/words.h"
#include "io/flow/damaged_table.h"
#include "io/flow/plausible_record.h"
#include "io/materials/material_file.h"
#include "io/materials/plausible_numbers.h"
#include "io/tables/csv_table.h"
#include "io/tables/derived_columns.h"
#include "io/tables/modulus_of_columns.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Values = std::vector<double>;

// The quantities that a test compares, and those that drive it.
const std::vector<std::string>& compared_names() {
  static const std::vector<std::string> kNames{"modulus_Pa",         "compliance_1_Pa", "stress_Pa",
                                               "storage_modulus_Pa", "loss_modulus_Pa", "strain"};
  return kNames;
}

// A table with the column of its argument.
struct ReadTable {
  CsvTable table;
  const PredictFileRequest* request;
  double young_factor = 1.0;  // Young's modulus over the moduli of the table
  std::string note;           // about their kind; may be empty

  bool has(const std::string& name) const {
    return find_column(table, name, request->columns).has_value();
  }
  // Moduli, compliances and stresses as of tension.
  Values column(const std::string& name) const {
    Values values = column_SI(table, name, request->columns);
    const bool is_compliance = name == "compliance_1_Pa";
    const bool is_modulus = name.ends_with("_Pa") && !is_compliance;
    if (young_factor == 1.0 || (!is_modulus && !is_compliance)) return values;
    for (double& value : values) value *= is_modulus ? young_factor : 1.0 / young_factor;
    return values;
  }
  Values argument(const std::string& name) const {
    Values values = column(name);
    if (name != "time_s") return values;
    for (double& time_s : values) time_s -= request->time_zero_s;
    return values;
  }
};

ReadTable read_compared(const std::string& path, const CsvTable* in_memory,
                        const PredictFileRequest& request, double nu) {
  ReadTable read{in_memory != nullptr ? *in_memory : read_csv(path), &request};
  read.table.judged = request.plausible;
  derive_columns(read.table, request.columns, {});
  std::vector<std::string> used = compared_names();
  used.insert(used.end(), {"time_s", "frequency_Hz"});
  std::size_t n_gaps = 0;
  read.table = rows_without_gaps(std::move(read.table), used, request.columns, n_gaps);
  if (n_gaps > 0) read.note = path + ": " + counted(n_gaps, "row") + " without a number left out";
  TableModulusKind found;
  if (request.modulus_kind) {
    found.kind = *request.modulus_kind;
    found.from = "--modulus-kind";
  } else {
    found = modulus_kind_of(read.table, request.columns, compared_names());
  }
  read.young_factor = young_over(found.kind, nu);
  std::string about;
  if (found.is_assumed && !found.header.empty()) {
    about = "'" + found.header +
            "' does not state whether it is of tension or of shear, and was "
            "compared as of tension; state --modulus-kind";
  } else if (found.kind != ModulusKind::kTension) {
    about = std::string("compared as Young's modulus: ") + text_of(found.kind).conversion +
            " with nu = " + text_of(nu) + " of the material, by " + found.from;
  }
  if (!about.empty()) read.note += (read.note.empty() ? path + ": " : "; ") + about;
  return read;
}

PredictedTest test_of_columns(const ReadTable& measured) {
  if (measured.has("storage_modulus_Pa") && measured.has("loss_modulus_Pa")) {
    return PredictedTest::kOscillation;
  }
  if (measured.has("modulus_Pa")) return PredictedTest::kRelaxation;
  if (measured.has("compliance_1_Pa")) return PredictedTest::kCreep;
  if (measured.has("strain") && measured.has("stress_Pa")) return PredictedTest::kHistory;
  throw std::runtime_error(
      measured.table.file +
      ": the columns do not say which test this is; expected modulus_Pa, compliance_1_Pa, "
      "storage_modulus_Pa with loss_modulus_Pa, or strain with stress_Pa. Name the test with "
      "--test, or a column with --column modulus_Pa=\"HEADER\"");
}

bool is_given(const PredictFileRequest& request, const std::string& option) {
  return std::find(request.given.begin(), request.given.end(), option) != request.given.end();
}

void take_history(const ReadTable& read, PredictionRequest& wanted) {
  const bool has_strain = read.has("strain"), has_stress = read.has("stress_Pa");
  if (!has_strain && !has_stress) {
    throw std::runtime_error(read.table.file +
                             ": a history needs a column strain or stress_Pa beside time_s; name "
                             "it with --column strain=\"HEADER\"");
  }
  const bool by_stress = read.request->is_driven_by_stress;
  if (is_given(*read.request, "driven-by") && !(by_stress ? has_stress : has_strain)) {
    throw std::runtime_error(read.table.file +
                             (by_stress
                                  ? ": --driven-by stress needs a column stress_Pa, and there is "
                                    "strain alone; omit it, or name the column with --column "
                                    "stress_Pa=\"HEADER\""
                                  : ": --driven-by strain needs a column strain, and there is "
                                    "stress_Pa alone; omit it, or name the column with --column "
                                    "strain=\"HEADER\""));
  }
  wanted.is_stress_history = has_stress && (!has_strain || by_stress);
  wanted.history = course_from_columns(
      read.argument("time_s"), read.column(wanted.is_stress_history ? "stress_Pa" : "strain"));
}

double root_mean_square(const Values& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// The rows of the table that the prediction covers, in order of their argument.
void take_rows(const TestPrediction& prediction, const Values& at, const Values& measured,
               Agreement& found) {
  std::vector<std::size_t> order(at.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return at[a] < at[b]; });
  for (const std::size_t row : order) {
    // After a jump, if several rows of the prediction have this time.
    const auto after = std::upper_bound(prediction.at.begin(), prediction.at.end(), at[row]);
    if (after == prediction.at.begin() || *(after - 1) != at[row]) {
      ++found.n_left_out;
      continue;
    }
    found.at.push_back(at[row]);
    found.measured.push_back(measured[row]);
    found.index.push_back(static_cast<std::size_t>(after - prediction.at.begin()) - 1);
  }
}

void compare(const TestPrediction& prediction, const BandedCurve& curve, Agreement& found) {
  constexpr std::size_t kLeastForNoise = 20;
  Values off, off_inside, relative;
  for (std::size_t i = 0; i < found.at.size(); ++i) {
    const double predicted = curve.value[found.index[i]];
    off.push_back(predicted - found.measured[i]);
    relative.push_back(off.back() / predicted);
    if (prediction.is_inside[found.index[i]]) off_inside.push_back(off.back());
    if (std::abs(off.back()) > std::abs(found.worst)) {
      found.worst = off.back();
      found.worst_at = found.at[i];
    }
  }
  found.rms = root_mean_square(off);
  found.rms_relative = found.rms / root_mean_square(found.measured);
  found.n_inside_window = off_inside.size();
  found.rms_inside_window = off_inside.empty() ? kUnknown : root_mean_square(off_inside);
  found.noise_sigma = off.size() < kLeastForNoise
                          ? kUnknown
                          : sigma_from_differences(found.is_noise_relative ? relative : off);
  found.share_inside_band = found.share_inside_band_and_noise = kUnknown;
  if (curve.low_95.empty()) return;
  std::size_t n_inside = 0, n_with_noise = 0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double predicted = curve.value[found.index[i]];
    const double half = 0.5 * (curve.high_95[found.index[i]] - curve.low_95[found.index[i]]);
    const double sigma = found.noise_sigma * (found.is_noise_relative ? predicted : 1.0);
    n_inside += std::abs(off[i]) <= half ? 1 : 0;
    n_with_noise += std::abs(off[i]) <= std::hypot(half, kNormal95 * sigma) ? 1 : 0;
  }
  const auto count = static_cast<double>(off.size());
  found.share_inside_band = static_cast<double>(n_inside) / count;
  if (std::isfinite(found.noise_sigma)) {
    found.share_inside_band_and_noise = static_cast<double>(n_with_noise) / count;
  }
  const double share = std::isfinite(found.noise_sigma) ? found.share_inside_band_and_noise
                                                        : found.share_inside_band;
  found.agrees = share >= kAgreeingShare;
}

std::vector<Agreement> agreement_with(const TestPrediction& prediction, const ReadTable& measured) {
  std::vector<Agreement> all;
  std::vector<std::string> expected;
  for (const PredictedCurve& predicted : prediction.curves) {
    if (predicted.name == "tan_delta") continue;  // follows from the other two
    expected.push_back(predicted.name);
    if (!measured.has(predicted.name)) continue;
    Agreement found;
    found.name = predicted.name;
    found.is_noise_relative = prediction.test == PredictedTest::kOscillation;
    take_rows(prediction, measured.argument(prediction.argument), measured.column(predicted.name),
              found);
    if (found.at.empty()) {
      throw std::runtime_error(measured.table.file +
                               ": no row lies within the test; set its beginning with --time-zero");
    }
    compare(prediction, predicted.curve, found);
    all.push_back(found);
  }
  if (!all.empty()) return all;
  throw std::runtime_error(measured.table.file + ": nothing to compare with; this test predicts " +
                           listed(expected) + ", and the table has no such column");
}

// Arguments of the measured rows at which the prediction is needed.
Values wanted_arguments(PredictedTest test, const ReadTable& measured) {
  const bool is_sweep = test == PredictedTest::kOscillation;
  Values at = measured.argument(is_sweep ? "frequency_Hz" : "time_s");
  if (is_sweep || test == PredictedTest::kHistory) return at;
  std::erase_if(at, [](double t_s) { return t_s < 0.0; });
  return at;
}

// Largest magnitude of the strain that is applied or predicted.
double largest_strain(const TestPrediction& prediction) {
  double largest = 0.0;
  const auto look = [&](const std::string& name, const Values& values) {
    if (name != "strain") return;
    for (const double value : values) largest = std::max(largest, std::abs(value));
  };
  look(prediction.input_name, prediction.input);
  for (const PredictedCurve& one : prediction.curves) look(one.name, one.curve.value);
  return largest;
}

// What a load makes of the material passes the same rule as a strain that is stated.
void refuse_strain(double largest, PredictedTest test, Plausible judged) {
  const auto doubt = doubt_about(quantities::kStrain, largest, judged);
  if (!doubt) return;
  throw std::invalid_argument("the load of this " +
                              names_of_predicted_tests()[static_cast<std::size_t>(test)] +
                              " is too large for the material: its largest strain " +
                              doubt->text() + ". Give a smaller --stress, or add --plausible off");
}

std::vector<std::string> notes_about(const Material& material, const PredictedFile& predicted) {
  std::vector<std::string> notes;
  for (const MaterialFlag& flag : predicted.flags) {
    if (flag.term == 0) notes.push_back(flag.name + ": " + flag.text);
  }
  if (!predicted.has_band) {
    notes.push_back(!material.uncertainty ? "no band: the material states no covariance"
                                          : "no band: the covariance of the material does not "
                                            "apply to E(t), or the Poisson ratio is not constant");
  }
  if (!predicted.prediction.is_window_known) {
    notes.push_back("the material states no window of times, so nothing is marked as outside");
  }
  return notes;
}

}  // namespace

PredictedFile predict_file(const PredictFileRequest& request) {
  return predict_material(read_material(request.material, request.plausible).material, request);
}

PredictedFile predict_material(Material material, const PredictFileRequest& request) {
  PredictedFile out;
  out.path = request.material;
  out.name = material.name.empty() ? std::filesystem::path(request.material).stem().string()
                                   : material.name;
  if (request.temperature_C) material = material_at_temperature(material, *request.temperature_C);
  out.has_band = has_band(material);
  out.flags = material.flags;
  out.is_trustworthy = std::none_of(out.flags.begin(), out.flags.end(),
                                    [](const auto& flag) { return is_defect(flag.name); });
  if (material.uncertainty) out.systematic_relative = material.uncertainty->systematic_relative;

  PredictionRequest wanted = request.prediction;
  std::optional<ReadTable> history, measured;
  const auto read = [&](const std::string& path, const CsvTable* in_memory,
                        std::optional<ReadTable>& table) {
    if (path.empty()) return;
    table.emplace(read_compared(path, in_memory, request, material.nu));
    for (const IntegrityNote& note : accepted_damage(table->table, request.accepts_unverified))
      out.flags.push_back({note.name, 0, path + ": " + note.text});
  };
  read(request.history, request.history_in_memory.get(), history);
  read(request.against, request.against_in_memory.get(), measured);
  wanted.test = request.test ? *request.test
                : history    ? PredictedTest::kHistory
                : measured   ? test_of_columns(*measured)
                             : PredictedTest::kRelaxation;
  refuse_idle(uses_in(wanted.test, request));
  if (wanted.test == PredictedTest::kHistory) {
    if (!history && !measured) {
      throw std::invalid_argument(
          "a history has to be given: a table with time_s and strain or stress_Pa");
    }
    const ReadTable& course = history ? *history : *measured;
    take_history(course, wanted);
    if (!wanted.is_stress_history) {  // refuses per cent without a unit
      strain_flag(course.table, request.columns, request.plausible);
    }
    // A table with both columns also contains the measured answer.
    if (!measured && course.has("strain") && course.has("stress_Pa")) measured = history;
  }
  if (measured) wanted.also_at = wanted_arguments(wanted.test, *measured);
  out.prediction = predict_test(material, wanted);
  if (wanted.test != PredictedTest::kHistory) {
    refuse_strain(largest_strain(out.prediction), wanted.test, request.plausible);
  }
  if (measured) {
    out.against = measured->table.file;
    out.agreement = agreement_with(out.prediction, *measured);
  }
  if (const auto flag = strain_flag(largest_strain(out.prediction))) out.flags.push_back(*flag);
  if (request.plausible == Plausible::kOff) flag_plausible_off(out.flags);
  out.notes = notes_about(material, out);
  for (const auto* table : {&history, &measured}) {
    if (!*table || (*table)->note.empty()) continue;
    if (std::find(out.notes.begin(), out.notes.end(), (*table)->note) == out.notes.end()) {
      out.notes.push_back((*table)->note);
    }
  }
  if (request.temperature_C) {
    out.notes.push_back("the band leaves out the error of the temperature shift");
  }
  return out;
}

OptionUses uses_in(PredictedTest test, const PredictFileRequest& request) {
  using enum PredictedTest;
  struct TestsOfOption {
    const char* option;
    std::vector<PredictedTest> tests;
  };
  static const std::vector<TestsOfOption> kAll{
      {"strain", {kRelaxation, kCycles}},
      {"stress", {kCreep, kRecovery, kCycles}},
      {"ramp", {kRelaxation, kCreep, kRecovery}},
      {"hold", {kRelaxation, kCreep, kRecovery}},
      {"recovery", {kRecovery}},
      {"period", {kCycles}},
      {"cycles", {kCycles}},
      {"from", {kRelaxation, kCreep, kRecovery, kOscillation}},
      {"to", {kRelaxation, kCreep, kRecovery, kOscillation}},
      {"points", {kRelaxation, kCreep, kRecovery, kCycles, kOscillation}},
      {"driven-by", {kHistory}}};
  OptionUses uses;
  for (const auto& [option, tests] : kAll) {
    std::vector<std::string> names;
    for (const PredictedTest one : tests) {
      names.push_back(names_of_predicted_tests()[static_cast<std::size_t>(one)]);
    }
    const bool has_effect = std::find(tests.begin(), tests.end(), test) != tests.end();
    uses.push_back({std::string("--") + option, is_given(request, option), has_effect,
                    "--test " + listed(names)});
  }
  uses.push_back({"--to", is_given(request, "to"), !is_given(request, "hold"),
                  "tests without --hold, which also ends the curve"});
  const bool has_table = !request.history.empty() || !request.against.empty();
  for (const char* option : {"column", "modulus-kind", "unverified"}) {
    uses.push_back({std::string("--") + option, is_given(request, option), has_table,
                    "the tables of --history and --against"});
  }
  uses.push_back({"--time-zero", is_given(request, "time-zero"), has_table && test != kOscillation,
                  "tables of tests in time, by --history or --against"});
  return uses;
}

const std::vector<std::string>& names_of_predicted_tests() {
  static const std::vector<std::string> kNames{"relaxation", "creep",       "recovery",
                                               "cycles",     "oscillation", "history"};
  return kNames;
}

}  // namespace viscard
