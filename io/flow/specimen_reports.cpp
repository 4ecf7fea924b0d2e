#include "io/flow/specimen_reports.h"

#include "fit/indentation_from_capture.h"
#include "io/basics/atomic_file.h"
#include "io/basics/missing_file.h"
#include "io/basics/parallel.h"
#include "io/basics/written_path.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/cards/card.h"
#include "io/cards/targets/card_targets.h"
#include "io/config/config_file.h"
#include "io/flow/capture_to_file.h"
#include "io/flow/fit_file.h"
#include "io/flow/input_files.h"
#include "io/materials/material_file.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/validate_material.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <mutex>

namespace fs = std::filesystem;

namespace viscard {
namespace {

constexpr double kSameFit =
    1e-3;  // relative difference of E0 up to which a material file is from this fit

struct InputFiles {
  std::vector<std::string> measured;  // captures and tables
  std::vector<std::string> materials;
};

InputFiles sorted_by_kind(const std::vector<std::string>& files) {
  InputFiles sorted;
  for (const std::string& file : files) {
    if (!fs::exists(file)) throw std::runtime_error(file + ": " + why_not_opened(file, ENOENT));
    if (fs::is_directory(file))
      throw std::runtime_error(file + ": is a folder; give the files in it");
    if (looks_like_ratio_file(file)) continue;  // read by mixing_law_of()
    const bool is_material = fs::path(file).extension() == ".json" && !looks_like_capture(file);
    (is_material ? sorted.materials : sorted.measured).push_back(file);
  }
  return sorted;
}

std::optional<std::string> truth_file_of(const ReportRequest& request, const std::string& capture,
                                         std::size_t index) {
  if (!request.truth_files.empty()) return request.truth_files[index];
  if (!looks_like_capture(capture)) return std::nullopt;
  const std::string beside = fs::path(capture).replace_extension(".truth.json").string();
  if (fs::exists(beside)) return beside;
  return std::nullopt;
}

// Replaces the host times of the readings by their device times, mapped to the host's clock. The
// transmission delays of the readings would otherwise look like motion in the picture.
void put_on_one_clock(CapturedRun& run) {
  std::vector<double> device_s, host_s;
  for (const LoadSample& sample : run.load_samples) {
    if (!sample.device_time_s) return;
    device_s.push_back(*sample.device_time_s);
    host_s.push_back(sample.host_time_s);
  }
  if (device_s.size() < 3) return;
  const ClockLine line = line_from_below(device_s, host_s);
  for (LoadSample& sample : run.load_samples) sample.host_time_s = line.at(*sample.device_time_s);
}

// With the continuous spectrum, and with profile likelihoods, as `viscard fit FILE --profiles` has, if there are few terms. For many
// terms they take long and the figure would be too crowded to read.
FittedFile fit_for_page(const std::string& path, const ReportRequest& wanted) {
  constexpr std::size_t kFewTerms = 6;
  FitRequest request;
  request.plausible = wanted.plausible;
  request.accepts_unverified = wanted.accepts_unverified;
  request.is_beside_others = true;  // a page shows files of all kinds, and the option is for some
  const std::size_t n_terms = fit_file(path, request).result.terms.size();
  request.options.with_spectrum = true;
  request.options.with_profiles = n_terms <= kFewTerms;
  return fit_file(path, request);
}

// The factors of a master curve for the page, and the law on a fine grid of temperatures.
ShiftReport shift_report(const MasterCurve& curve) {
  constexpr int kPoints = 120;
  const double ln_10 = std::log(10.0);
  ShiftReport report;
  report.T_ref_C = curve.T_ref_C;
  for (std::size_t k = 0; k < curve.factors.size(); ++k) {
    const ShiftFactor &taken = curve.factors[k], &free = curve.free_factors[k];
    report.temperature_C.push_back(taken.temperature_C);
    report.log10_a.push_back(taken.ln_a / ln_10);
    report.log10_a_se.push_back(taken.ln_a_se / ln_10);
    report.free_log10_a.push_back(free.ln_a / ln_10);
    report.free_log10_a_se.push_back(free.ln_a_se / ln_10);
  }
  report.form_text = curve.form == "wlf"         ? "WLF law"
                     : curve.form == "arrhenius" ? "Arrhenius law"
                     : curve.form == "smooth"    ? "smooth curve over 1/T"
                                                 : "free";
  const TemperatureShift* law = curve.laws.better();
  if (law == nullptr) return report;
  report.law_text = law->law == ShiftLaw::kWlf
                        ? fmt::format("WLF, C1 = {:.3g}, C2 = {:.3g} K", law->C1, law->C2_K)
                        : fmt::format("Arrhenius, {:.3g} kJ/mol", 1e-3 * law->activation_J_mol);
  const double first_C = report.temperature_C.front(), last_C = report.temperature_C.back();
  for (int i = 0; i <= kPoints; ++i) {
    const double T_C = first_C + (last_C - first_C) * i / kPoints;
    report.law_temperature_C.push_back(T_C);
    report.law_log10_a.push_back(ln_shift_factor(*law, T_C) / ln_10);
  }
  return report;
}

// Fits a capture or a table as `viscard fit FILE` does.
SpecimenReport specimen_from_fit(const ReportRequest& request, const std::string& path) {
  SpecimenReport report;
  const FittedFile fitted = fit_for_page(path, request);
  if (fitted.has_no_depth) {
    throw std::runtime_error(path +
                             ": has force but no depth, and the page shows moduli or "
                             "stiffnesses; add a column depth_m, stress_Pa or modulus_Pa");
  }
  report.fit = fitted.result;
  if (fitted.master) report.shift = shift_report(*fitted.master);
  report.specimen = fitted.specimen;
  if (report.specimen.id.empty()) report.specimen.id = fs::path(path).stem().string();
  if (looks_like_capture(path)) {
    report.run = read_capture(path, {.accepts_damage = request.accepts_unverified});
    put_on_one_clock(*report.run);
  }
  report.files = {{written_path(path), sha256_as_read(path)}};
  if (!report.fit->is_stiffness) {
    report.material = material_from_fitted(
        fitted, {.command = request.command, .created_at = request.created_at});
  }
  return report;
}

void add_truth(SpecimenReport& report, const std::string& path) {
  report.truth = truth_from_file(path);
  report.files.push_back({written_path(path), sha256_as_read(path)});
}

SpecimenReport specimen_from_material(const ReportRequest& request, const std::string& path) {
  SpecimenReport report;
  report.material = read_material(path, request.plausible).material;
  report.specimen.id =
      report.material->name.empty() ? fs::path(path).stem().string() : report.material->name;
  report.specimen.mixing_ratio = report.material->mixing_ratio;
  report.files = {{written_path(path), sha256_as_read(path)}};
  return report;
}

bool came_from(const Material& material, const SpecimenReport& capture) {
  const std::vector<RawFile>& raw = material.provenance.raw_files;
  return std::any_of(raw.begin(), raw.end(), [&](const RawFile& file) {
    return !file.sha256.empty() && file.sha256 == capture.files.front().sha256;
  });
}

// If the material was made from a capture on the page, it becomes part of that specimen and adds
// its provenance and cards; otherwise it is a specimen of its own.
void join_or_append(std::vector<SpecimenReport>& specimens, SpecimenReport material) {
  for (SpecimenReport& specimen : specimens) {
    if (!specimen.fit || !specimen.material || !came_from(*material.material, specimen)) continue;
    const double filed_Pa = material.material->E0_Pa, fitted_Pa = specimen.fit->E0_Pa;
    const bool is_same = specimen.fit->terms.size() == material.material->terms.size() &&
                         std::abs(filed_Pa / fitted_Pa - 1.0) < kSameFit;
    if (!is_same) {
      specimen.notes.push_back(fmt::format(
          "The material file {} differs from the fit shown here ({}, E0 = {:.5g} Pa instead of {}, "
          "{:.5g} Pa), because it was fitted with other options. Pillar and cards use the file.",
          material.files.front().path, counted(material.material->terms.size(), "term"), filed_Pa,
          counted(specimen.fit->terms.size(), "term"), fitted_Pa));
    }
    const std::string id = specimen.material->specimen_id;  // files of earlier versions have none
    specimen.material = material.material;
    if (specimen.material->specimen_id.empty()) specimen.material->specimen_id = id;
    specimen.files.push_back(material.files.front());
    return;
  }
  specimens.push_back(std::move(material));
}

PillarCheckCurve report_curve(const ValidationCurve& curve, const char* quantity) {
  return {quantity, curve.time_s, curve.solver, curve.exact, curve.largest_relative_error};
}

PillarCheck pillar_of(const Material& material) {
  const ValidationResult result = validate_material(material);
  PillarCheck check;
  check.relaxation = report_curve(result.relaxation, "stress (Pa)");
  check.creep = report_curve(result.creep, "shortening (m)");
  check.limit = result.tolerance;
  check.setup = fmt::format(
      "A pillar of {:g} µm diameter and {:g} µm length on a fixed base, {} unknowns: relaxation "
      "under {:g} % of shortening held, creep under {:g} kPa held. Exact answer: {}.",
      1e6 * result.diameter_m, 1e6 * result.length_m, result.unknowns, 100.0 * result.strain,
      1e-3 * result.pressure_Pa, result.exact_method);
  return check;
}

ReportCard card_of(const Material& material, const std::string& target,
                   const ReportRequest& request, const std::string& stem) {
  ReportCard card{target, request.card_units, stem + card_target(target).extension, "", ""};
  CardOptions options;
  options.units = request.card_units;
  options.created_at = request.created_at;
  options.command = request.command;
  try {
    card.text = write_card(material, card_target(target), options).text;
  } catch (const std::invalid_argument& error) {
    card.refusal = error.what();
  }
  return card;
}

void add_pillar(SpecimenReport& specimen) {
  try {
    specimen.pillar = pillar_of(*specimen.material);
  } catch (const std::invalid_argument& error) {
    specimen.notes.push_back(std::string("The pillar was not run: ") + error.what());
  }
}

void add_pillar_and_cards(SpecimenReport& specimen, const ReportRequest& request) {
  if (!specimen.material) return;
  // Users of tables from other machines want the material, not a pillar.
  const bool is_table = specimen.fit && !specimen.run;
  if (!is_table) add_pillar(specimen);
  const std::string stem = fs::path(specimen.files.front().path).stem().string();
  for (const std::string& target : request.card_targets) {
    specimen.cards.push_back(card_of(*specimen.material, target, request, stem));
  }
}

}  // namespace

std::size_t measured_count(const std::vector<std::string>& files) {
  return sorted_by_kind(files).measured.size();
}

std::vector<SpecimenReport> read_specimens(const ReportRequest& request,
                                           const FlowProgress& progress) {
  refuse_repeated_files(request.files);
  const InputFiles files = sorted_by_kind(request.files);
  if (!request.truth_files.empty() && request.truth_files.size() != files.measured.size()) {
    throw std::invalid_argument("there must be one truth file for each capture or table");
  }
  if (!request.tests.empty()) {
    std::vector<SpecimenReport> one{specimen_of_tests(request, progress)};
    add_pillar_and_cards(one.front(), request);
    return one;
  }
  const std::size_t n_steps = 2 * files.measured.size() + files.materials.size();
  std::mutex mutex;
  std::size_t n_done = 0;
  const auto step_done = [&](const std::string& what) {
    const std::lock_guard<std::mutex> lock(mutex);
    progress(static_cast<double>(++n_done) / static_cast<double>(n_steps), what);
  };
  std::vector<SpecimenReport> specimens(files.measured.size());
  for_each_in_parallel(specimens.size(), [&](std::size_t i) {
    specimens[i] = specimen_from_fit(request, files.measured[i]);
    if (const auto truth = truth_file_of(request, files.measured[i], i))
      add_truth(specimens[i], *truth);
    step_done(files.measured[i]);
  });
  for (const std::string& path : files.materials) {
    join_or_append(specimens, specimen_from_material(request, path));
  }
  for_each_in_parallel(specimens.size(), [&](std::size_t i) {
    add_pillar_and_cards(specimens[i], request);
    step_done(specimens[i].specimen.id);
  });
  return specimens;
}

}  // namespace viscard
