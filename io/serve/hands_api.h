#pragma once

#include "io/serve/live_move.h"
#include "io/serve/one_job.h"
#include "io/serve/rig_api.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace viscard {

// What a person does at the bench between runs: moves of the stage, weights on the load cell. The requests are
// functions from JSON to JSON. They throw ApiError, or std::exception with a message for a
// person. Any thread may call them.
class HandsApi {
 public:
  // job: the one that the runs have, too.
  HandsApi(ServeOptions options, OneJob& job);

  // {"how": "toward" | "away" | "home", "way_m", "limit_N"}: begins a move.
  nlohmann::ordered_json move(const nlohmann::ordered_json& request);
  // The move; whoever asks watches it (LiveMove).
  nlohmann::ordered_json moving();
  void stop_move(bool at_once) { live_.stop(at_once); }
  bool is_moving() { return job_.what() == kMove; }
  // {"what": "position"}: counts positions from where the stage stands, in the rig file; {"what": "force"}:
  // lets the instrument make the force at rest its zero.
  nlohmann::ordered_json zero(const nlohmann::ordered_json& request);
  // {"mass_kg", "largest_kg"}: the mean of the readings with that mass on the cell, which hangs already.
  nlohmann::ordered_json weigh(const nlohmann::ordered_json& request);
  // {"points": [{"mass_kg", "reading", "reading_se"}, ...], "gravity_m_s2", "use"}: fits the line and writes the
  // record; use: into the rig file, too.
  nlohmann::ordered_json calibrate(const nlohmann::ordered_json& request);
  void close();

 private:
  static constexpr const char* kMove = "a move of the stage";

  ServeOptions options_;
  OneJob& job_;
  LiveMove live_;  // destroyed first: its threads use the others
};

}  // namespace viscard
