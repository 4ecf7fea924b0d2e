#include "fit/fit_together.h"
#include "io/basics/parallel.h"
#include "io/flow/fit_file.h"
#include "io/flow/input_files.h"
#include "io/flow/test_words.h"
#include "io/materials/plausible_numbers.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// "creep", or "creep 2" for the second of several.
std::string name_of(const std::vector<TestFile>& tests, std::size_t k) {
  const auto same = [&](const TestFile& other) { return other.kind == tests[k].kind; };
  std::string name = name_of_kind(tests[k].kind);
  if (std::count_if(tests.begin(), tests.end(), same) == 1) return name;
  const auto at = tests.begin() + static_cast<std::ptrdiff_t>(k);
  return name + " " + std::to_string(1 + std::count_if(tests.begin(), at, same));
}

// Options for fitting each test alone: the order is chosen for that test, because the others do not
// determine it.
FitRequest request_of(const TestFile& test, const FitRequest& request) {
  FitRequest one = request;
  one.kind = test.kind;
  one.is_one_of_several = one.is_beside_others = true;
  one.needs_modulus = false;  // another test may supply it
  one.options.keep_rows = true;
  one.options.n_terms.reset();
  return one;
}

bool is_of(const FittedFile& file, ModulusKind kind) {
  return file.modulus && file.modulus->kind == kind;
}

// Tests in shear beside tests in tension tell the Poisson ratio, unless it is stated. Those in shear then
// have a free factor to the moduli of tension, as a stiffness has.
bool tell_poisson_ratio(const std::vector<FittedFile>& own, const FitRequest& request) {
  const auto has = [&](ModulusKind kind) {
    return std::any_of(own.begin(), own.end(),
                       [&](const FittedFile& file) { return is_of(file, kind); });
  };
  return !request.nu && has(ModulusKind::kShear) && has(ModulusKind::kTension);
}

// E = 2 (1 + nu) G: values that were converted with nu_0 have the factor s = (1 + nu_0)/(1 + nu) to the
// material. Of several tests in shear the one that tells it best.
void take_poisson_ratio(const std::vector<FittedFile>& own, FittedFile& fitted) {
  std::optional<MeasuredModulus> best;
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (!is_of(own[k], ModulusKind::kShear)) continue;
    FittedTest& test = fitted.result.tests[k];
    test.is_stiffness = false;
    const auto nu_of = [&](double scale) { return (1.0 + own[k].modulus->nu) / scale - 1.0; };
    MeasuredModulus found;
    found.from = "tests in shear and in tension";
    found.nu = nu_of(test.scale);
    found.nu_95 = Interval{nu_of(test.scale_95.high), nu_of(test.scale_95.low)};
    const auto width = [](const MeasuredModulus& one) { return one.nu_95->high - one.nu_95->low; };
    if (!best || width(found) < width(*best)) best = found;
  }
  if (best->nu_95->low > 0.5 || best->nu_95->high < -1.0) {
    fitted.result.flags.push_back(
        {"tests-disagree", 0,
         "the moduli of tension and shear would need a Poisson ratio of " + text_of(best->nu, 3) +
             ", which no isotropic material has; check units and geometry"});
    fitted.result.is_trustworthy = false;
  }
  best->nu = std::clamp(best->nu, -0.99, 0.5);
  fitted.modulus = best;
}

}  // namespace

std::vector<FileOutcome> fit_each_file(const std::vector<std::string>& files,
                                       const FitRequest& request, const FlowProgress& progress) {
  std::vector<FileOutcome> outcomes(files.size());
  FitRequest of_each = request;
  of_each.is_beside_others = request.is_beside_others || files.size() > 1;
  std::size_t n_done = 0;
  std::mutex reporting;
  const auto report = [&](const std::string& file) {
    const std::lock_guard lock(reporting);
    ++n_done;
    if (progress) progress(static_cast<double>(n_done) / static_cast<double>(files.size()), file);
  };
  for_each_in_parallel(files.size(), [&](std::size_t i) {
    outcomes[i].path = files[i];
    try {
      outcomes[i].fitted = fit_file(files[i], of_each);
    } catch (const std::exception&) {
      outcomes[i].error = std::current_exception();
    }
    report(files[i]);
  });
  const bool are_read = std::all_of(outcomes.begin(), outcomes.end(),
                                    [](const FileOutcome& one) { return one.fitted.has_value(); });
  if (of_each.is_beside_others && !request.is_beside_others && are_read) {
    OptionUses uses;
    for (const FileOutcome& one : outcomes) add_uses(one.fitted->uses, uses);
    refuse_idle(uses);
  }
  return outcomes;
}

std::vector<FittedFile> fit_files(const std::vector<std::string>& files, const FitRequest& request,
                                  const FlowProgress& progress) {
  std::vector<FittedFile> fitted;
  for (FileOutcome& outcome : fit_each_file(files, request, progress)) {
    if (outcome.error) std::rethrow_exception(outcome.error);
    fitted.push_back(std::move(*outcome.fitted));
  }
  return fitted;
}

FittedFile fit_tests(const std::vector<TestFile>& tests, const FitRequest& request,
                     const FlowProgress& progress) {
  if (request.diagnose || !request.model.empty()) {
    throw std::runtime_error(
        "--model and --diagnose compare laws in one test; omit them for several");
  }
  if (request.T_ref_C || !request.start_shifts.empty()) {
    throw std::runtime_error(
        std::string(request.T_ref_C ? "--reference-temperature" : "--start-shift") +
        " is for a master curve of one file; omit it for several tests");
  }
  refuse_repeated_files(paths_of(tests));
  std::vector<FittedFile> own(tests.size());
  std::mutex reporting;
  std::size_t n_done = 0;
  for_each_in_parallel(tests.size(), [&](std::size_t k) {
    own[k] = fit_file(tests[k].path, request_of(tests[k], request));
    const std::lock_guard lock(reporting);
    ++n_done;
    const auto n_steps = static_cast<double>(tests.size() + 1);
    if (progress) progress(static_cast<double>(n_done) / n_steps, tests[k].path);
  });
  std::vector<const FittedFile*> all;
  for (const FittedFile& one : own) all.push_back(&one);
  refuse_copies(all);
  std::vector<MaterialTest> together;
  FittedFile fitted;
  for (const FittedFile& one : own) add_uses(one.uses, fitted.uses);
  refuse_idle(fitted.uses);
  const bool tells_nu = tell_poisson_ratio(own, request);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    together.push_back({name_of(tests, k), own[k].result});
    if (tells_nu) together[k].own.is_stiffness |= is_of(own[k], ModulusKind::kShear);
    fitted.path += (k == 0 ? "" : " + ") + tests[k].path;
    if (own[k].specimen.contact.punch_radius_m > 0.0) fitted.specimen = own[k].specimen;
    if (fitted.specimen_id.empty()) fitted.specimen_id = own[k].specimen_id;
    if (own[k].temperature) fitted.temperature = own[k].temperature;
    fitted.n_before_test += own[k].n_before_test;
    for (const std::string& note : own[k].notes)
      fitted.notes.push_back(together[k].name + ": " + note);
  }
  fitted.result = fit_together(together, request.options);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    fitted.result.tests[k].fitted_unit = own[k].fitted_unit;
  }
  if (tells_nu) {
    take_poisson_ratio(own, fitted);
  } else {  // what a material of one kind of modulus shall tell
    for (const FittedFile& file : own) {
      if (file.modulus && (!fitted.modulus || file.modulus->kind != ModulusKind::kTension)) {
        fitted.modulus = file.modulus;
      }
    }
  }
  const auto has_no_depth = [](const FittedFile& file) { return file.has_no_depth; };
  fitted.has_no_depth = std::all_of(own.begin(), own.end(), has_no_depth);
  fitted.tests = tests;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    fitted.tests[k].is_in_memory = own[k].is_in_memory;
  }
  fitted.fitted_unit = "weighted";
  const auto accepts_any = [](const FittedFile& file) {
    return accepts_implausible(file.result.flags);
  };
  if (std::any_of(own.begin(), own.end(), accepts_any)) flag_plausible_off(fitted.result.flags);
  if (request.needs_modulus && fitted.result.is_stiffness) {
    throw std::runtime_error(
        "--out writes moduli, but every test gives only stiffnesses or forces; add --depth, "
        "--punch-diameter or --specimen, or a test of moduli");
  }
  return fitted;
}

}  // namespace viscard
