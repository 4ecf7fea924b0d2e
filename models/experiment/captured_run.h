#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/run_record.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// What is known of a record by the checksums of its capture file.
struct RecordIntegrity {
  bool has_checksums = true;  // false: written before captures carried them
  // Description, events, moves or the side file are not what was written, and the reader accepted that.
  bool is_damage_accepted = false;
  // Rows that are not what was written; they are not in the record.
  std::size_t n_left_out_samples = 0, n_left_out_reports = 0, n_left_out_temperatures = 0;
  std::size_t n_left_out_raw = 0;  // records of raw bytes, which only their export shows
  // The run was interrupted, and the side file that held its newest records is missing.
  bool has_lost_log = false;
  std::string lost_log;  // name of that side file
  // The end of the side file has a hole, as a power cut leaves it.
  bool has_torn_log = false;
  std::vector<std::string> faults;  // one line each: what is damaged, and where
};

// One test run as read from its capture file: what was asked for and what was received, each list
// in the order of reception. Host times are in s since the run began (run_record.h).
struct CapturedRun {
  RigConfig rig;
  TestPlan plan;
  Specimen specimen;
  std::vector<LoadSample> load_samples;
  std::vector<StageReport> stage_reports;
  std::vector<CommandedMove> moves;
  std::vector<RunEvent> events;
  std::vector<TemperatureSample> temperatures;  // empty without a thermometer
  std::string status;                           // "finished" | "interrupted" | "running"
  std::string started_at;                       // ISO 8601, wall clock
  std::string program;                          // "viscard 0.1.0"
  std::string command;                          // command line
  std::size_t n_raw_bytes = 0;
  RecordIntegrity integrity;
};

}  // namespace viscard
