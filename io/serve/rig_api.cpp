#include "io/serve/rig_api.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/basics/program.h"
#include "io/basics/timestamp.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/flow/command_error.h"
#include "io/flow/rig_actions.h"
#include "io/flow/rig_keys.h"
#include "io/flow/series_files.h"
#include "io/flow/table_from_capture.h"
#include "io/materials/material_file.h"
#include "io/materials/material_json.h"
#include "io/results/result_json.h"
#include "io/serve/api_error.h"
#include "io/serve/series_json.h"
#include "models/maths/failure_text.h"
#include "rig/emulator/demo_rig.h"
#include "rig/lines/port_probe.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace viscard {
namespace {

namespace fs = std::filesystem;

constexpr double kCheck_s = 2.0;

// What make() returns, or {"trouble"} with the reason why a file cannot be used.
template <typename Make>
Json or_trouble(Make&& make) {
  try {
    return make();
  } catch (const std::exception& error) {
    return {{"trouble", failure_text(error, "this answer")}};
  }
}

// Why a port of the rig cannot be used, as far as this can be seen without opening it.
void add_port_troubles(Json& rig) {
  for (const char* device : {"stage", "load_cell"}) {
    if (!rig.contains(device)) continue;
    rig[device]["trouble"] = port_status(rig[device].at("port").get<std::string>()).trouble;
  }
}

// Throws ApiError 400 unless it is true or false.
bool is_set(const Json& request, const char* key, bool otherwise = false) {
  if (!request.contains(key)) return otherwise;
  if (request.at(key).is_boolean()) return request.at(key).get<bool>();
  throw ApiError(400, "bad-value", std::string("'") + key + "' must be true or false");
}

// The configuration keeps it, and its file says it.
template <typename Config>
Config with_judgement(Config config, const Json& request) {
  if (judged_by(request) == Plausible::kOff) config.accepts_implausible = true;
  return config;
}

// The text of a test file that the page shows or wants to keep.
TestPlan test_of_text(const Json& request) {
  constexpr std::size_t kLongest = 20'000;
  const std::string text = text_at(request, "text");
  if (text.size() > kLongest) throw ApiError(400, "bad-value", "a test has at most 20 kB of text");
  return test_from_toml(text, "test.toml", judged_by(request));
}

// Examples of all protocols, the demonstration's first.
std::vector<fs::path> protocol_files() {
  std::vector<fs::path> files;
  std::error_code is_gone;
  for (const auto& entry : fs::directory_iterator(data_folder() / "protocols", is_gone)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), data_folder() / "demo" / "02_test.toml");
  return files;
}

Json curves_of(const FitCurves& curves) {
  return {{"time_s", curves.time_s}, {"measured", curves.measured},
          {"fitted", curves.fitted}, {"sigma", curves.sigma},
          {"unit", curves.unit},     {"motion_start_s", curves.motion_start_s}};
}

}  // namespace

RigApi::RigApi(ServeOptions options, OneJob& job)
    : options_(std::move(options)), folder_(options_.folder), job_(job) {}

RigConfig RigApi::rig() const {
  return options_.rig_file ? read_rig(*options_.rig_file) : demo_rig();
}

CaptureSetup RigApi::setup_of(const std::string& specimen) const {
  SetupRequest request;
  request.rig_file = options_.rig_file;
  const SeriesSpecimen found = folder_.specimen_named(specimen);
  if (!found.trouble.empty()) throw std::runtime_error(found.trouble);
  request.specimen_file = folder_.specimen_file(found.name);
  request.is_emulated = options_.is_emulated;
  request.seed = options_.seed;
  request.speed = options_.speed;
  if (options_.is_emulated) request.truth_file = folder_.truth_file(specimen);
  CaptureSetup setup = setup_from_files(request);
  setup.plan = folder_.test();
  return setup;
}

Json RigApi::state() const {
  Json json = {{"program", program_with_version()},   {"folder", folder_.path().string()},
               {"folder_trouble", folder_.trouble()}, {"is_emulated", options_.is_emulated},
               {"clock_speed", options_.speed},       {"job", job_.what()}};
  const bool is_idle = json["job"].get_ref<const std::string&>().empty();
  json["rig"] = or_trouble([&] {
    const RigConfig found = rig();
    return json_of_rig(
        found, options_.rig_file ? calibration_trouble(found.calibration, today()) : std::string());
  });
  // During a job this program itself holds the ports.
  if (!options_.is_emulated && is_idle) add_port_troubles(json["rig"]);
  json["test"] = or_trouble([&] { return json_of_test(folder_.test()); });
  json["specimens"] = Json::array();
  json["next"] = nullptr;
  const LiveState live = live_.state();
  for (const SeriesSpecimen& specimen : folder_.specimens()) {
    // The file of a run that has just begun may not exist, or not be readable yet.
    const bool is_live = live.is_running && live.specimen == specimen.name;
    const std::string how = is_live ? "running" : specimen.state();
    Json row = json_of_specimen(specimen, folder_);
    row["state"] = how;
    json["specimens"].push_back(row);
    if (json["next"].is_null() && how != "finished" && how != "running") {
      json["next"] = specimen.name;
    }
  }
  return json;
}

Json RigApi::ports() const {
  Json rows = Json::array();
  for (const std::string& path : present_ports()) {
    const PortStatus status = port_status(path);
    rows.push_back({{"port", status.path}, {"device", status.device}, {"trouble", status.trouble}});
  }
  return {{"ports", rows}};
}

Json RigApi::check_rig() {
  job_.begin("a check of the rig");
  const JobEnd at_end(job_);
  const RigConfig config = rig();
  RigCheck found = check_rig_config(config, options_.is_emulated, kCheck_s);
  if (options_.rig_file) add_calibration(config, found);
  return json_from_result(found);
}

Json RigApi::preflight_of(const Json& request) const {
  const Json changes = request.contains("test") ? request.at("test") : Json::object();
  const TestPlan saved = request.contains("text") ? test_of_text(request) : folder_.test();
  const TestPlan plan = with_judgement(test_with(saved, changes), request);
  folder_.check_test(plan);
  const SeriesSpecimen found = folder_.specimen_named(text_at(request, "specimen"));
  if (!found.trouble.empty()) throw std::runtime_error(found.trouble);
  const Preflight expected = preflight(rig(), plan, *found.specimen);
  return json_of_preflight(expected, expected_course(plan, expected));
}

Json RigApi::save_test(const Json& request) {
  if (request.contains("text")) {
    const TestPlan plan = test_of_text(request);
    folder_.save_test_text(text_at(request, "text"), plan);
    return json_of_test(plan);
  }
  const Json changes = request.contains("test") ? request.at("test") : Json();
  const TestPlan plan = with_judgement(test_with(folder_.test(), changes), request);
  folder_.save_test(plan);
  return json_of_test(plan);
}

Json RigApi::test_texts() const {
  Json examples = Json::array();
  for (const fs::path& file : protocol_files()) {
    examples.push_back({{"name", file.stem().string()}, {"text", read_file(file)}});
  }
  return {{"text", folder_.test_text()}, {"examples", examples}};
}

Json RigApi::add_specimen(const Json& request) {
  const std::lock_guard<std::mutex> lock(writing_);
  const Json asked = request.contains("specimen") ? request.at("specimen") : Json();
  const Specimen specimen = with_judgement(specimen_from(asked), request);
  return {{"name", folder_.add_specimen(specimen)}};
}

Json RigApi::remove_specimen(const Json& request) {
  const std::lock_guard<std::mutex> lock(writing_);
  const std::string name = text_at(request, "name");
  folder_.remove_specimen(name);
  return {{"name", name}};
}

Json RigApi::rename_specimen(const Json& request) {
  const std::lock_guard<std::mutex> lock(writing_);
  return {{"name", folder_.rename_specimen(text_at(request, "name"),
                                           specimen_from({{"id", text_at(request, "id")}}).id)}};
}

Json RigApi::remove_capture(const Json& request) {
  job_.begin("moving a capture");  // a fit may read it
  const JobEnd at_end(job_);
  const std::lock_guard<std::mutex> lock(writing_);
  return {{"file", folder_.trash_capture(text_at(request, "capture"))}};
}

Json RigApi::note_capture(const Json& request) {
  const std::lock_guard<std::mutex> lock(writing_);
  const std::string file = text_at(request, "capture");
  folder_.note_capture(file, text_at(request, "note"));
  return {{"file", file}};
}

Json RigApi::export_capture(const Json& request) {
  const std::string file = text_at(request, "capture");
  folder_.specimen_of_capture(file);
  job_.begin("the table of " + file);
  const JobEnd at_end(job_);
  const std::string table = table_from_capture(read_capture(folder_.path() / file));
  const fs::path out = (folder_.path() / file).replace_extension(".csv");
  if (!fs::is_regular_file(fs::symlink_status(out)) || read_file(out) != table) {
    write_file(out, table, false);
  }
  return {{"file", out.filename().string()}};
}

Json RigApi::capture_curve(const Json& request) {
  const std::string file = text_at(request, "capture");
  folder_.specimen_of_capture(file);
  job_.begin("reading " + file);
  const JobEnd at_end(job_);
  const ContactCurve curve = contact_curve(read_capture(folder_.path() / file));
  return {{"file", file},
          {"contact_s", curve.contact_s},
          {"zero_N", curve.zero_N},
          {"time_s", rounded(curve.time_s, 1e-4)},
          {"force_N", rounded(curve.force_N, 1e-6)}};
}

// As `viscard capture` does.
void RigApi::check_before_run(const CaptureSetup& setup) const {
  safe_preflight(setup);
  if (options_.rig_file && !options_.is_uncalibrated) {
    refuse_expired_calibration(setup.rig.calibration);
  }
}

Json RigApi::start_run(const Json& request) {
  const std::string name = text_at(request, "specimen");
  const bool repeats = is_set(request, "repeat");
  const bool lifts = is_set(request, "lift");
  job_.begin("the run of " + name);
  try {
    CaptureRequest capture;
    capture.setup = setup_of(name);
    if (request.contains("test")) refuse_unseen_test(request.at("test"), capture.setup.plan);
    check_before_run(capture.setup);
    const std::filesystem::path first = folder_.first_capture(name);
    const NextCapture next = next_capture(first);
    if (!next.finished.empty() && !repeats) {
      throw ApiError(409, "finished",
                     name + " has a finished capture, " + next.finished.filename().string() +
                         ". Choose another specimen, or repeat it on purpose");
    }
    capture.path = next.finished.empty() ? next.file : further_capture(first);
    capture.command = options_.command;
    capture.lifts_at_start = lifts;
    const std::string file = capture.path.filename().string();
    live_.start(name, std::move(capture), [this] { job_.end(); });
    return {{"file", file}};
  } catch (...) {
    job_.end();
    throw;
  }
}

Json RigApi::stop_run(const Json& request) {
  const std::string how = text_at(request, "how");
  if (how != "gently" && how != "at once") {
    throw ApiError(400, "bad-value", "'how' is '" + how + "'; it must be 'gently' or 'at once'");
  }
  if (!live_.is_running()) throw ApiError(409, "no-run", "no run is going on");
  live_.stop(how == "at once");
  return {{"is_stopping", true}};
}

Json RigApi::run(std::size_t from, std::size_t keep_every) const {
  const auto [state, points] = live_.state_since(from, keep_every);
  Json json = {
      {"number", state.number},
      {"is_running", state.is_running},
      {"is_stopping", state.is_stopping},
      {"specimen", state.specimen},
      {"file", state.file},
      {"phase", state.now.phase},
      {"phase_text", state.phase_text},
      {"time_s", state.now.time_s},
      {"time_left_wall_s", state.now.time_left_s / state.clock_speed},
      {"fraction", state.now.fraction},
      {"force_N", state.now.force_N},
      {"depth_m", state.now.depth_m},
      {"peak_force_N", state.peak_force_N},
      {"records", {{"committed", state.counts.committed}, {"synced", state.counts.synced}}},
      {"trouble", state.trouble}};
  json["error"] = nullptr;
  if (!state.trouble.empty()) {
    json["error"] = json_from_result(command_error(state.trouble_code, state.trouble));
  }
  json["outcome"] =
      state.outcome ? json_from_result(CaptureOfSeries{.file = state.file, .run = state.outcome})
                    : Json(nullptr);
  json["points"] = {{"keep_every", points.keep_every},
                    {"from", points.from},
                    {"time_s", rounded(points.time_s, 1e-4)},
                    {"force_N", rounded(points.force_N, 1e-6)},
                    {"depth_m", rounded(points.depth_m, 1e-8)}};
  return json;
}

Json RigApi::fit(const Json& request) {
  const std::string file = text_at(request, "capture");
  const bool keeps = is_set(request, "keep", true);
  const std::string specimen = folder_.specimen_of_capture(file).name;
  const std::filesystem::path path = folder_.path() / file;
  job_.begin("the fit of " + file);
  const JobEnd at_end(job_);
  FitRequest asked;
  asked.plausible = judged_by(request);
  const FittedFile fitted = fit_file(path, asked);
  Json json = json_from_result(fitted);
  json["file"] = file;
  json["status"] = read_capture_state(path).status;
  json["curves"] = curves_of(fitted.result.curves);
  json["material_file"] = nullptr;
  json["material_trouble"] = "";
  if (json["status"] != "finished" || !keeps) return json;
  try {  // a folder that cannot be written to does not hide the fit
    json["material_file"] = save_material(fitted, specimen);
  } catch (const std::exception& error) {
    json["material_trouble"] = failure_text(error, "this material");
  }
  return json;
}

std::string RigApi::save_material(const FittedFile& fitted, const std::string& specimen) const {
  const std::filesystem::path file = folder_.path() / (specimen + ".json");
  MaterialRequest wanted;
  wanted.command = options_.command;
  wanted.created_at = now_iso8601();
  const Material material = material_from_fitted(fitted, wanted);
  if (!std::filesystem::exists(file)) {
    write_file(file, json_from_material(material), false);
    return file.filename().string();
  }
  const auto sum_of = [](const Material& of) {
    const auto& raw = of.provenance.raw_files;
    return raw.empty() ? std::string() : raw.front().sha256;
  };
  const MaterialFile there = read_material(file);
  const std::string by = there.material.provenance.created_by;
  const std::string why = sum_of(there.material) != sum_of(material)
                              ? "is the material of another record"
                          : by != material.provenance.created_by
                              ? "was written by " + (by.empty() ? "another program" : by) +
                                    ", and this is " + material.provenance.created_by
                          : !has_own_sum(there.original_json) ? "was edited since it was written"
                                                              : "";
  if (why.empty()) return file.filename().string();
  throw std::runtime_error(file.filename().string() + " " + why +
                           "; rename it, then open this result again");
}

// A request that was admitted before may begin a run after the first call.
bool RigApi::close() {
  job_.close();
  if (live_.is_running()) live_.stop(false);
  return job_.what().empty() && !live_.is_running();
}

}  // namespace viscard
