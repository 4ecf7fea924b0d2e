#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/flow/command_error.h"
#include "io/flow/table_from_capture.h"
#include "models/maths/text_of_number.h"

#include <nlohmann/json.hpp>

#include <ostream>

namespace viscard {
namespace {

nlohmann::ordered_json summary_of(const CapturedRun& run, const std::string& capture) {
  std::size_t n_gaps = 0;
  for (const RunEvent& event : run.events) n_gaps += event.name == "gap" ? 1 : 0;
  return {{"capture", capture},
          {"status", run.status},
          {"started_at", run.started_at},
          {"program", run.program},
          {"command", run.command},
          {"specimen", run.specimen.id},
          {"n_samples", run.load_samples.size()},
          {"n_stage_reports", run.stage_reports.size()},
          {"n_moves", run.moves.size()},
          {"n_events", run.events.size()},
          {"n_gaps", n_gaps},
          {"n_raw_bytes", run.n_raw_bytes}};
}

// Prints the result of checking the capture. A damaged capture is a failure.
int verify(const std::string& capture, bool is_json, Streams& streams) {
  const CaptureCheck check = check_capture(capture);
  if (is_json) {
    nlohmann::ordered_json object{{"capture", capture},
                                  {"is_checked", check.is_checked},
                                  {"n_batches", check.n_batches},
                                  {"n_records", check.n_records},
                                  {"faults", check.faults}};
    if (!check.faults.empty()) {
      object["error"] =
          json_from_error({"damaged", check.faults.front(), capture, "use another copy of it"});
    }
    print_json({"viscard-export-verify/1", {capture}}, object, streams);
  } else if (check.faults.empty()) {
    streams.out << capture << ": "
                << (check.is_checked
                        ? counted(check.n_records, "record") + " match " +
                              counted(check.n_batches, "checksum")
                        : "unchecked: it was written before captures carried checksums")
                << "\n";
  }
  for (const std::string& fault : check.faults) {
    streams.err << "viscard: " << capture << ": " << fault << "\n";
  }
  if (check.faults.empty()) return kDone;
  streams.err << "viscard: " << capture << " is damaged; use another copy of it\n";
  return kFailed;
}

}  // namespace

int run_export(const Words& words, Streams& streams) {
  std::string capture;
  std::optional<std::string> out;
  bool is_raw = false, verifies = false, overwrite = false;
  CommandSyntax syntax;
  syntax.usage = "viscard export RUN.viscap [--out FILE.csv] [OPTIONS]";
  syntax.description =
      "Writes every sample of a capture as CSV: time, counts, volts, force, stage position, phase. "
      "Times and positions are on the clock that viscard fit uses; host_time_s is the time of "
      "receipt. Of an interrupted run all committed samples are written, and the head states that "
      "it was interrupted. Without --out the table goes to standard output.";
  syntax.example = "viscard export run.viscap --out run.csv";
  syntax.reads_quantities = false;
  syntax.positional.add("capture", &capture, "captured run");
  syntax.options.add("out", &out, "CSV file to write");
  syntax.options.add("raw", &is_raw, "the bytes as received and sent instead of the samples");
  syntax.options.add("verify", &verifies,
                     "compare the capture with its checksums; writes no table");
  syntax.options.add("force", &overwrite, "replace an existing file");
  if (!parse_words(syntax, words, streams)) return kDone;
  const bool is_json = syntax.as_json;
  if (verifies) {
    if (is_raw || out) throw UsageError("--verify writes no table; omit --out and --raw");
    return verify(capture, is_json, streams);
  }
  const CapturedRun run = read_capture(capture);
  const std::string table = is_raw ? csv_from_raw_bytes(capture) : table_from_capture(run);
  nlohmann::ordered_json summary = summary_of(run, capture);
  if (out) {
    write_file(*out, table, overwrite);
    summary["out"] = *out;
    if (!is_json) {
      streams.out << *out << ": " << counted(run.load_samples.size(), "sample") << " of " << capture
                  << ", " << run.status << "\n";
    }
  } else if (!is_json) {
    streams.out << table;
  }
  if (is_json) print_json({"viscard-export/1", {capture}}, summary, streams);
  if (run.status != "finished") {
    streams.err << "viscard: " << capture << " is "
                << (run.status == "running" ? "still being written" : "of an interrupted run")
                << "; all that was committed is exported\n";
  }
  return kDone;
}

}  // namespace viscard
