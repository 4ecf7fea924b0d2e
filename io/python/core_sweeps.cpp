#include "io/flow/sweep/run_study.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "io/scenes/scene_file.h"

#include <pybind11/stl.h>

#include <limits>
#include <map>
#include <stdexcept>

namespace viscard::python {
namespace {

namespace py = pybind11;

struct Swept {
  Study study;
  StudyOutcome outcome;
  std::int64_t n_merged = 0;
  std::vector<StudyPoint> points;
};

StudyShard shard_of(const std::optional<std::string>& text) {
  if (!text) return {};
  try {
    return shard_from(*text);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

// A column for each result: NaN at points without it.
py::dict results_by_name(const std::vector<StudyPoint>& points) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  struct Column {
    std::string unit;
    std::vector<double> value, error;
  };
  std::vector<std::string> names;  // in the order of the answers
  std::map<std::string, Column> columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const NamedValue& one : points[i].results) {
      const auto [at, is_new] = columns.try_emplace(one.name);
      Column& column = at->second;
      if (is_new) {
        names.push_back(one.name);
        column = {one.unit, std::vector<double>(points.size(), kNone), {}};
        column.error = column.value;
      }
      column.value[i] = one.value;
      column.error[i] = one.error_estimate;
    }
  }
  py::dict out;
  for (const std::string& name : names) {
    Column& column = columns.at(name);
    py::dict one;
    one["unit"] = column.unit;
    one["value"] = array_of(std::move(column.value));
    one["error"] = array_of(std::move(column.error));
    out[py::str(name)] = one;
  }
  return out;
}

// The points of a study; those that the file does not hold yet are answered, or taken over from `merge`.
py::dict sweep(const std::string& path, const std::string& file,
               const std::optional<std::string>& shard_text, const std::vector<std::string>& merge,
               const std::string& plausible, bool accept_unrecorded, bool retry_failed,
               const py::object& progress) {
  const Plausible judged = judged_by(plausible, Plausible::kScene);
  const StudyShard shard = shard_of(shard_text);
  if (!merge.empty() && shard_text) {
    throw OptionError("--merge takes over points and answers none; leave --shard out");
  }
  Swept found = in_background({.progress = progress}, [=](Job& job) {
    Swept swept;
    swept.study = read_study(path);
    const Study& study = swept.study;
    // A mistake in the study or its scene is reported here, not once for each point.
    check_values(study, judged);
    const StoreOptions how{.accepts_unrecorded = accept_unrecorded,
                           .retries_failed = retry_failed,
                           .is_answering = merge.empty(),
                           // A sweep that was interrupted ends its points in the background.
                           .waits_s = 60.0};
    StudyStore store(file, study, how);
    swept.outcome.n_points = count_points(study);
    for (const std::string& part : merge) swept.n_merged += store.merge(part, study, how);
    if (merge.empty()) {
      swept.outcome = run_study(
          study, shard, store, [&](double done) { job.report(done, "sweep"); }, judged);
    }
    store.for_each([&](const StudyPoint& point) { swept.points.push_back(point); });
    return swept;
  });
  py::dict out, parameters;
  for (std::size_t i = 0; i < found.study.parameters.size(); ++i) {
    py::list texts;
    for (const StudyPoint& point : found.points) texts.append(point.values.at(i).second);
    parameters[py::str(found.study.parameters[i].key)] = texts;
  }
  py::list failures;
  std::vector<std::int64_t> numbers;
  for (const StudyPoint& point : found.points) {
    failures.append(point.failure);
    numbers.push_back(point.point);
  }
  out["parameters"] = parameters;
  out["results"] = results_by_name(found.points);
  out["failures"] = failures;
  out["point"] = array_of(std::move(numbers));
  out["n_points"] = found.outcome.n_points;
  out["n_answered"] = found.outcome.n_answered;
  out["n_merged"] = found.n_merged;
  out["n_refused"] = found.outcome.n_refused;
  out["n_failed"] = found.outcome.n_failed;
  out["first_failure"] = found.outcome.first_failure;
  return out;
}

}  // namespace

void add_sweeps(py::module_& module) {
  module.def("sweep", &sweep);
}

}  // namespace viscard::python
