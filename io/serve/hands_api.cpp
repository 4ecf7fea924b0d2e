#include "io/serve/hands_api.h"

#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/config/config_file.h"
#include "io/flow/calibrate.h"
#include "io/flow/rig_keys.h"
#include "io/results/result_json.h"
#include "io/serve/api_error.h"
#include "io/serve/series_json.h"
#include "rig/emulator/demo_rig.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMostWeighings = 200;
constexpr double kLargestMass_kg = 1e3;

double mass_at(const Json& object, const char* key) {
  const double mass_kg = number_at(object, key);
  if (mass_kg >= 0.0 && mass_kg <= kLargestMass_kg) return mass_kg;
  throw ApiError(400, "bad-value", std::string("'") + key + "' is no mass of a weight, kg");
}

StageOrder order_from(const Json& request) {
  const std::string how = text_at(request, "how");
  StageOrder order;
  order.is_home = how == "home";
  if (how != "toward" && how != "away" && how != "home") {
    throw ApiError(400, "bad-value",
                   "'how' is '" + how + "'; it must be 'toward', 'away' or 'home'");
  }
  if (order.is_home) return order;
  const double way_m = number_at(request, "way_m");
  if (!(way_m > 0.0)) throw ApiError(400, "bad-value", "'way_m' must be above 0");
  order.toward_m = (how == "away" ? -1.0 : 1.0) * way_m;
  order.limit_N = number_at(request, "limit_N");
  return order;
}

// Writes the record under a name that is free, and returns it.
fs::path write_record(const fs::path& folder, const std::string& toml) {
  for (int n = 1;; ++n) {
    fs::path path =
        folder / ("load_cell_" + today() + (n > 1 ? "." + std::to_string(n) : "") + ".toml");
    if (fs::exists(fs::symlink_status(path))) continue;
    write_file(path, toml, false);
    return path;
  }
}

}  // namespace

HandsApi::HandsApi(ServeOptions options, OneJob& job) : options_(std::move(options)), job_(job) {}

Json HandsApi::move(const Json& request) {
  const StageOrder order = order_from(request);
  RigConfig rig = options_.rig_file ? read_rig(*options_.rig_file) : demo_rig();
  if (options_.is_emulated) rig.clock_speed = options_.speed;
  check_order(order, rig);
  job_.begin(kMove);
  try {
    live_.start(rig, options_.is_emulated, order, [this] { job_.end(); });
  } catch (...) {
    job_.end();
    throw;
  }
  return moving();
}

Json HandsApi::moving() {
  const MoveState state = live_.state();
  return {{"number", state.number},
          {"is_moving", state.is_moving},
          {"force_N", state.force_N},
          {"position_m", state.position_m ? Json(*state.position_m) : Json(nullptr)},
          {"moved", state.moved ? json_from_result(*state.moved) : Json(nullptr)},
          {"trouble", state.trouble}};
}

Json HandsApi::zero(const Json& request) {
  const std::string what = text_at(request, "what");
  if (what != "position" && what != "force") {
    throw ApiError(400, "bad-value", "'what' is '" + what + "'; it must be 'position' or 'force'");
  }
  if (what == "position" && (options_.is_emulated || !options_.rig_file)) {
    throw ApiError(422, "emulated", "no rig file keeps the zero of an emulated stage");
  }
  RigConfig rig = options_.rig_file ? read_rig(*options_.rig_file) : demo_rig();
  if (options_.is_emulated) rig.clock_speed = options_.speed;
  job_.begin("a setting of the zero");
  const JobEnd at_end(job_);
  if (what == "force") {
    return json_from_result(zero_rig_force(rig, options_.is_emulated, &job_.is_closing()));
  }
  const double position_m = lasting_position_m(rig, false);
  write_zero(*options_.rig_file, position_m);
  return {{"zero_m", position_m}};
}

Json HandsApi::weigh(const Json& request) {
  const double mass_kg = mass_at(request, "mass_kg"), largest_kg = mass_at(request, "largest_kg");
  RigConfig rig = options_.rig_file ? read_rig_to_calibrate(*options_.rig_file) : demo_rig();
  if (options_.is_emulated) rig.clock_speed = options_.speed;
  const CalibrationRequest usual;
  const double force_N = weight_N(mass_kg, usual), capacity_N = rig.calibration.capacity_N;
  if (force_N > capacity_N) {
    throw ApiError(422, "overload",
                   "a weight of " + std::to_string(std::lround(mass_kg * 1e3)) +
                       " g is above the capacity of the load cell");
  }
  job_.begin("a weighing");
  const JobEnd at_end(job_);
  const WeighedLoad load =
      weigh_on_rig(rig, options_.is_emulated, force_N,
                   weight_N(std::max(mass_kg, largest_kg), usual), &job_.is_closing());
  return {{"mass_kg", mass_kg},
          {"reading", load.reading},
          {"reading_se", load.sd / std::sqrt(static_cast<double>(load.n))}};
}

Json HandsApi::calibrate(const Json& request) {
  const auto found = request.find("points");
  if (found == request.end() || !found->is_array() || found->size() > kMostWeighings) {
    throw ApiError(400, "bad-value",
                   "'points' are the weighings, at most " + std::to_string(kMostWeighings));
  }
  const RigConfig rig = options_.rig_file ? read_rig_to_calibrate(*options_.rig_file) : demo_rig();
  CalibrationRequest asked;
  asked.capacity_N = rig.calibration.capacity_N;
  if (request.contains("gravity_m_s2")) asked.gravity_m_s2 = number_at(request, "gravity_m_s2");
  check_request(asked);
  WeightReadings readings;
  readings.force_relative_u = weights_relative_u(asked);
  readings.resolution =
      has_converter(rig.load_cell) ? std::abs(rig.load_cell.volts_per_count) : 0.0;
  double largest = 0.0;
  for (const Json& point : *found)
    largest = std::max(largest, std::abs(number_at(point, "reading")));
  for (const Json& point : *found) {
    readings.force_N.push_back(weight_N(mass_at(point, "mass_kg"), asked));
    readings.reading.push_back(number_at(point, "reading"));
    readings.reading_se.push_back(number_at(point, "reading_se"));
    constexpr double kMostScatter = 0.01;  // of the largest reading; such a cell weighs nothing
    if (readings.reading_se.back() >= 0.0 && readings.reading_se.back() <= kMostScatter * largest)
      continue;
    throw ApiError(400, "bad-value", "'reading_se' is no standard error of a reading; weigh again");
  }
  const bool is_used = request.contains("use") && request.at("use") == true;
  if (is_used && (options_.is_emulated || !options_.rig_file)) {
    throw ApiError(422, "emulated",
                   "the readings are of an emulated load cell, which no rig file describes");
  }
  const CellCalibration cell = calibrated_cell(readings, asked, &rig);
  // Beside the rig file, which names records relative to itself.
  const fs::path folder =
      is_used ? fs::absolute(*options_.rig_file).parent_path() : options_.folder;
  const std::string toml = toml_from_calibration(cell.record);
  calibration_from_toml(toml, "the record");  // what could not be read back is not written
  const fs::path record = write_record(folder, toml);
  if (is_used) write_calibration_file(*options_.rig_file, record.filename().string());
  return json_from_keys([&](ResultVisitor& v) { show_keys(v, cell, record.string()); });
}

void HandsApi::close() {
  job_.close();
  live_.stop(false);
}

}  // namespace viscard
