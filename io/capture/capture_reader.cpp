#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_database.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/capture/integrity_notes.h"
#include "io/capture/open_capture.h"
#include "io/capture/possible_values.h"
#include "io/config/config_file.h"

#include <sqlite3.h>

#include <optional>
#include <stdexcept>
#include <unordered_set>

namespace viscard {
namespace {

namespace fs = std::filesystem;

std::string run_value(Database& database, const char* key) {
  Statement statement = database.prepare("SELECT value FROM run WHERE key = ?");
  statement.bind(1, std::string_view(key));
  return statement.step() ? statement.text(0) : std::string();
}

void read_samples(Database& database, const CheckedRecords& records, CapturedRun& run) {
  const bool has_force = schema_of(database) > 1;
  const std::string columns =
      "SELECT sample_index, host_time_s, device_time_s, counts, volts, is_saturated, is_glitch, ";
  const std::string from = ", seq FROM load_samples ORDER BY seq";
  Statement row = database.prepare((columns + (has_force ? "force_N" : "NULL") + from).c_str());
  while (row.step()) {
    if (!records.is_sound("load_samples", row.integer(8))) {
      ++run.integrity.n_left_out_samples;
      continue;
    }
    run.load_samples.push_back({row.integer(0), row.number(1), row.maybe_number(2),
                                row.maybe_number(3), row.maybe_number(4), row.integer(5) != 0,
                                row.integer(6) != 0, row.maybe_number(7)});
  }
}

void read_stage(Database& database, const CheckedRecords& records, CapturedRun& run) {
  Statement report = database.prepare(
      "SELECT host_time_s, position_m, state, seq FROM stage_reports ORDER BY seq");
  while (report.step()) {
    if (!records.is_sound("stage_reports", report.integer(3))) {
      ++run.integrity.n_left_out_reports;
      continue;
    }
    run.stage_reports.push_back({report.number(0), report.number(1), report.text(2)});
  }
  Statement move = database.prepare(
      "SELECT start_time_s, from_m, to_m, speed_m_s, acceleration_m_s2, start_uncertainty_s, "
      "purpose FROM moves ORDER BY seq");
  while (move.step()) {
    run.moves.push_back(
        {{move.number(0), move.number(1), move.number(2), move.number(3), move.number(4)},
         move.number(5),
         move.text(6)});
  }
}

void read_events(Database& database, CapturedRun& run) {
  Statement event =
      database.prepare("SELECT host_time_s, name, value, text FROM events ORDER BY seq");
  while (event.step()) {
    run.events.push_back({event.number(0), event.text(1), event.text(2), event.text(3)});
  }
}

void read_temperatures(Database& database, const CheckedRecords& records, CapturedRun& run) {
  if (schema_of(database) < kFirstSchemaWithTemperatures) return;
  Statement row =
      database.prepare("SELECT host_time_s, temperature_C, seq FROM temperatures ORDER BY seq");
  while (row.step()) {
    if (records.is_sound("temperatures", row.integer(2))) {
      run.temperatures.push_back({row.number(0), row.number(1)});
    } else {
      ++run.integrity.n_left_out_temperatures;
    }
  }
}

void count_raw_bytes(Database& database, const CheckedRecords& records, CapturedRun& run) {
  run.n_raw_bytes = static_cast<std::size_t>(
      std::stoull("0" + database.text_of("SELECT sum(length(bytes)) FROM raw_bytes")));
  if (!records.is_damaged("raw_bytes")) return;
  Statement row = database.prepare("SELECT seq FROM raw_bytes");
  while (row.step()) {
    if (!records.is_sound("raw_bytes", row.integer(0))) ++run.integrity.n_left_out_raw;
  }
}

Device device_of(const std::string& word) {
  for (const Device device : {Device::kStage, Device::kThermometer}) {
    if (word == word_of(device)) return device;
  }
  return Device::kLoadCell;
}

void read_metadata(Database& database, const fs::path& path, CapturedRun& run) {
  const std::string inside = path.string() + " (stored ";
  run.rig = rig_from_toml(run_value(database, "rig_toml"), inside + "rig)");
  run.plan = test_from_toml(run_value(database, "test_toml"), inside + "test)");
  run.specimen = specimen_from_toml(run_value(database, "specimen_toml"), inside + "specimen)");
  run.started_at = run_value(database, "started_at");
  run.program = run_value(database, "program");
  run.command = run_value(database, "command");
}

void read_status(OpenCapture& capture, const fs::path& path, CapturedRun& run) {
  run.status = run_value(capture.database(), "status");
  if (run.status != "open") return;
  run.status = capture.is_running() ? "running" : "interrupted";
  if (capture.is_running() || has_journal(path) || !is_log_expected(path)) return;
  run.integrity.has_lost_log = true;
  run.integrity.lost_log = path.string() + "-wal";
  run.events.push_back({run.events.empty() ? 0.0 : run.events.back().host_time_s, "gap", "",
                        "the run was interrupted and its side file " + path.string() +
                            "-wal is missing; if only the main file was copied, the last "
                            "seconds may be in that side file"});
}

// Readings whose index an event "implausible" names count as glitches. The event comes after the
// reading was recorded.
void mark_implausible(CapturedRun& run) {
  std::unordered_set<std::string> indices;
  for (const RunEvent& event : run.events) {
    if (event.name == "implausible") indices.insert(event.value);
  }
  if (indices.empty()) return;
  for (LoadSample& sample : run.load_samples) {
    if (indices.count(std::to_string(sample.index)) > 0) sample.is_glitch = true;
  }
}

// Description, end, events and moves decide what the readings mean, so damage to them is refused.
// So is a log of which only the begin can be read: what is left out may be any of them.
void judge_damage(const CheckedRecords& records, const SideFileCheck& side_file,
                  const fs::path& path, const CaptureReading& reading, CapturedRun& run) {
  RecordIntegrity& integrity = run.integrity;
  integrity.has_checksums = records.check.is_checked;
  integrity.faults = records.check.faults;
  integrity.has_torn_log = side_file.is_torn;
  const bool is_log_damaged = !side_file.damage.empty();
  if (is_log_damaged) integrity.faults.insert(integrity.faults.begin(), side_file.damage);
  const bool is_meaning_damaged = is_log_damaged || records.is_description_damaged ||
                                  records.is_damaged("events") || records.is_damaged("moves");
  if (!is_meaning_damaged) return;
  integrity.is_damage_accepted = true;
  if (reading.accepts_damage) return;
  throw std::runtime_error(path.string() + " is damaged: " + integrity.faults.front() +
                           ". Use another copy of it (viscard export --verify lists all damage); "
                           "to read it as it is, add --unverified, which the result will state");
}

}  // namespace

CapturedRun read_capture(const std::filesystem::path& path, const CaptureReading& reading) {
  record_input_file(path);
  OpenCapture capture(path);
  Database& database = capture.database();
  CapturedRun run;
  try {
    database.execute("BEGIN");  // one snapshot, even of a run that is still being written
    if (database.text_of("PRAGMA quick_check(1)") != "ok") {
      throw SqliteError(path.string(), SQLITE_CORRUPT);
    }
    const CheckedRecords records = check_records(database);
    judge_damage(records, capture.side_file(), path, reading, run);
    read_metadata(database, path, run);
    read_samples(database, records, run);
    read_stage(database, records, run);
    read_events(database, run);
    read_temperatures(database, records, run);
    refuse_impossible_values(run, path.string());
    mark_implausible(run);
    count_raw_bytes(database, records, run);
    read_status(capture, path, run);
    database.execute("COMMIT");
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
  for (const IntegrityNote& note : integrity_notes(run)) note_input(path, note.text);
  return run;
}

CaptureState read_capture_state(const std::filesystem::path& path) {
  OpenCapture capture(path);
  CaptureState state;
  try {
    state.started_at = run_value(capture.database(), "started_at");
    state.status = run_value(capture.database(), "status");
    if (state.status == "open") state.status = capture.is_running() ? "running" : "interrupted";
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
  return state;
}

void read_raw_bytes(const std::filesystem::path& path,
                    const std::function<void(const RawBytes&)>& take) {
  OpenCapture capture(path);
  try {
    Database& database = capture.database();
    database.execute("BEGIN");
    const CheckedRecords records = check_records(database);
    Statement row = database.prepare(
        "SELECT host_time_s, device, is_sent, bytes, seq FROM raw_bytes ORDER BY seq");
    while (row.step()) {
      if (!records.is_sound("raw_bytes", row.integer(4))) continue;
      take({device_of(row.text(1)), row.integer(2) != 0, row.number(0), row.text(3)});
    }
  } catch (const SqliteError& error) {
    capture.explain(error);
  }
}

}  // namespace viscard
