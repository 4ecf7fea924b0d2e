#include "io/flow/sweep/run_study.h"

#include "io/basics/missing_file.h"
#include "io/basics/parallel.h"
#include "io/basics/written_path.h"
#include "io/flow/scenes/answer_scene.h"
#include "io/scenes/scene_file.h"
#include "models/maths/failure_text.h"

#include <algorithm>
#include <charconv>
#include <mutex>
#include <stdexcept>

namespace viscard {

namespace {

// All values of a grid; the ends of a range.
std::vector<std::string> texts_of(const StudyParameter& parameter) {
  return parameter.values.empty() ? std::vector<std::string>{parameter.from, parameter.to}
                                  : parameter.values;
}

}  // namespace

void check_values(const Study& study, Plausible judged) {
  const StudyValues first = values_at(study, 0);
  // A mistake in the study or its scene.
  scene_from_toml(scene_text_with(study, first), study.scene_path, {}, judged);
  for (std::size_t k = 0; k < study.parameters.size(); ++k) {
    for (const std::string& text : texts_of(study.parameters[k])) {
      StudyValues values = first;
      values[k].second = text;
      try {
        scene_from_toml(scene_text_with(study, values), study.scene_path, {}, judged);
      } catch (const BadNumber& error) {
        throw BadNumber(study.path.string() + ": parameter '" + values[k].first + "' cannot be \"" +
                        text + "\" (" + error.what() + ")");
      } catch (const std::exception& error) {
        if (is_passing(error)) throw;  // otherwise perhaps right beside other values
      }
    }
  }
}

namespace {

// Throws if a file is not what it was when the study was read, or was not read then: the store
// would not know it.
void refuse_changed_inputs(const Study& study, const std::vector<InputFile>& files) {
  for (const InputFile& file : files) {
    const std::string name = input_name(study, file.path);
    const auto known = std::find_if(study.inputs.begin(), study.inputs.end(),
                                    [&](const InputFile& one) { return one.path == name; });
    if (known == study.inputs.end()) {
      throw InputChanged(name +
                         " is read at this point and was not when the sweep began; start again, "
                         "or give this point a study of its own");
    }
    if (known->sha256 != file.sha256) {
      throw InputChanged(name + " changed while viscard was working; start again");
    }
  }
}

bool has_all_inputs(const Study& study) {
  const std::filesystem::path folder = std::filesystem::absolute(study.path).parent_path();
  return std::all_of(study.inputs.begin(), study.inputs.end(),
                     [&](const InputFile& file) { return is_readable(folder / file.path); });
}

// What passes may be answered tomorrow; what the models refuse in words would be refused again.
PointKind kind_of_failure(const std::exception& error) {
  if (is_passing(error)) return PointKind::kPassing;
  return is_refusal(error) ? PointKind::kRefused : PointKind::kError;
}

// A request to stop, which is no matter of a point.
bool ends_sweep(const std::exception& error) {
  return dynamic_cast<const StopsWork*>(&error) != nullptr &&
         dynamic_cast<const InputChanged*>(&error) == nullptr;
}

}  // namespace

StudyPoint answer_point(const Study& study, std::int64_t number, Plausible judged) {
  StudyPoint point{.point = number, .values = values_at(study, number)};
  const InputRecorder recorder(InputRecorder::Of::kPart);
  try {
    const SceneFile file =
        scene_from_toml(scene_text_with(study, point.values), study.scene_path, {}, judged);
    refuse_changed_inputs(study, recorder.files());
    point.results = named_values(answer_scene(file, study.scene_path.string(), {}));
  } catch (const std::exception& error) {
    if (ends_sweep(error)) throw;
    point.kind = has_all_inputs(study) ? kind_of_failure(error) : PointKind::kPassing;
    point.failure = written_text(failure_text(error, "this point"));
  }
  return point;
}

void count_point(const StudyPoint& point, StudyOutcome& outcome) {
  const bool is_failure = point.kind == PointKind::kError || point.kind == PointKind::kPassing;
  if (point.kind == PointKind::kRefused) ++outcome.n_refused;
  if (is_failure) ++outcome.n_failed;
  if (is_failure && outcome.first_failure.empty()) outcome.first_failure = point.failure;
  if (point.kind != PointKind::kPassing) ++outcome.n_answered;
}

StudyShard shard_from(const std::string& text) {
  StudyShard shard;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second =
      has_slash ? std::from_chars(first.ptr + 1, end, shard.count) : std::from_chars_result{};
  if (!has_slash || second.ec != std::errc() || second.ptr != end || shard.index < 1 ||
      shard.count < shard.index) {
    throw std::invalid_argument("--shard is '" + text +
                                "'; write it like 3/64, from 1/64 to 64/64");
  }
  return shard;
}

std::vector<std::int64_t> open_points(const Study& study, const StudyShard& shard,
                                      StudyStore& store, StudyOutcome& outcome) {
  outcome.n_points = count_points(study);
  const std::set<std::int64_t> done = store.done();
  std::vector<std::int64_t> open;
  for (std::int64_t point = shard.index - 1; point < outcome.n_points; point += shard.count) {
    if (done.count(point) > 0) {
      ++outcome.n_before;
    } else {
      open.push_back(point);
    }
  }
  return open;
}

StudyOutcome run_study(const Study& study, const StudyShard& shard, StudyStore& store,
                       const std::function<void(double)>& progress, Plausible judged) {
  StudyOutcome outcome;
  const std::vector<std::int64_t> open = open_points(study, shard, store, outcome);
  std::mutex mutex;
  std::size_t n_tried = 0;
  for_each_in_parallel(open.size(), [&](std::size_t i) {
    const StudyPoint point = answer_point(study, open[i], judged);
    const std::lock_guard<std::mutex> lock(mutex);
    try {
      store.add(point);
    } catch (const std::exception& error) {
      throw StopsWork(failure_text(error, "the file of the points"));  // what follows would be lost
    }
    count_point(point, outcome);
    if (progress) progress(static_cast<double>(++n_tried) / static_cast<double>(open.size()));
  });
  return outcome;
}

}  // namespace viscard
