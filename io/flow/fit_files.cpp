#include "fit/fit_together.h"
#include "io/basics/parallel.h"
#include "io/flow/fit_file.h"
#include "io/flow/input_files.h"
#include "io/flow/test_words.h"
#include "io/materials/plausible_numbers.h"

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
  one.is_one_of_several = true;
  one.needs_modulus = false;  // another test may supply it
  one.options.keep_rows = true;
  one.options.n_terms.reset();
  return one;
}

}  // namespace

std::vector<FileOutcome> fit_each_file(const std::vector<std::string>& files,
                                       const FitRequest& request, const FlowProgress& progress) {
  std::vector<FileOutcome> outcomes(files.size());
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
      outcomes[i].fitted = fit_file(files[i], request);
    } catch (const std::exception&) {
      outcomes[i].error = std::current_exception();
    }
    report(files[i]);
  });
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
  if (request.T_ref_C) {
    throw std::runtime_error(
        "--reference-temperature is for a master curve of one file; omit it for several tests");
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
  std::vector<MaterialTest> together;
  FittedFile fitted;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    together.push_back({name_of(tests, k), own[k].result});
    fitted.path += (k == 0 ? "" : " + ") + tests[k].path;
    if (own[k].specimen.contact.punch_radius_m > 0.0) fitted.specimen = own[k].specimen;
    if (fitted.specimen_id.empty()) fitted.specimen_id = own[k].specimen_id;
    if (own[k].temperature) fitted.temperature = own[k].temperature;
    fitted.n_before_test += own[k].n_before_test;
  }
  fitted.result = fit_together(together, request.options);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    fitted.result.tests[k].fitted_unit = own[k].fitted_unit;
  }
  const auto has_no_depth = [](const FittedFile& file) { return file.has_no_depth; };
  fitted.has_no_depth = std::all_of(own.begin(), own.end(), has_no_depth);
  fitted.tests = tests;
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
