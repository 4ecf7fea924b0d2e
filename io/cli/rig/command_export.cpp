#include "io/basics/atomic_file.h"
#include "io/capture/capture_check.h"
#include "io/capture/capture_export.h"
#include "io/capture/capture_file.h"
#include "io/capture/integrity_notes.h"
#include "io/cli/rig/rig_commands.h"
#include "io/cli/words/command_line.h"
#include "io/cli/words/json_output.h"
#include "io/flow/command_error.h"
#include "io/flow/fit_request.h"
#include "io/flow/table_from_capture.h"
#include "models/maths/text_of_number.h"

#include <optional>
#include <ostream>
#include <vector>

namespace viscard {
namespace {

void show_summary(ResultVisitor& v, const CapturedRun& run, CapturePart part,
                  const std::string& capture, const std::optional<std::string>& out) {
  std::size_t n_gaps = 0;
  for (const RunEvent& event : run.events) n_gaps += event.name == "gap" ? 1 : 0;
  v("capture", capture, "the capture");
  v.word("status", run.status, {"finished", "interrupted", "running"}, "how the run ended");
  v("started_at", run.started_at, "time of the begin");
  v("program", run.program, "version that recorded it");
  v("command", run.command, "its command line");
  v("specimen", run.specimen.id, "id of the specimen");
  v("n_samples", run.load_samples.size(), "readings of the load cell");
  v("n_stage_reports", run.stage_reports.size(), "reports of the stage");
  v("n_moves", run.moves.size(), "commanded moves");
  v("n_events", run.events.size(), "events");
  v("n_gaps", n_gaps, "gaps in the readings");
  v("n_raw_bytes", run.n_raw_bytes, "bytes received and sent");
  std::vector<std::string> notes;
  for (const IntegrityNote& note : integrity_notes(run, part)) notes.push_back(note.text);
  v("notes", notes, "what the checksums show against the record");
  v("out", out, "the table that was written");
}

void show_check(ResultVisitor& v, const CaptureCheck& check, const std::string& capture) {
  const std::string fault = check.faults.empty() ? "" : check.faults.front();
  v("capture", capture, "the capture");
  v("is_checked", check.is_checked, "whether it carries checksums");
  v("n_batches", check.n_batches, "checksums");
  v("n_records", check.n_records, "records under them");
  v("faults", check.faults, "what does not match");
  v.when(!check.faults.empty(), [&] {
    v("error", CommandError{"damaged", fault, capture, "use another copy of it"},
      "that it is damaged");
  });
}

// Prints the result of checking the capture. A damaged capture is a failure.
int verify(const std::string& capture, bool is_json, Streams& streams) {
  const CaptureCheck check = check_capture(capture);
  if (is_json) {
    print_result(
        {"viscard-export-verify/1", {capture}},
        [&](ResultVisitor& v) { show_check(v, check, capture); }, streams);
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
  CaptureReading reading;
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
  syntax.options.add("unverified", &reading.accepts_damage, kUnverifiedHelp);
  syntax.options.add("force", &overwrite, "replace an existing file").only_with({"out"});
  syntax.results = {{"export", "viscard export", {[](ResultVisitor& v) {
                       show_summary(v, CapturedRun{}, CapturePart::kReadings, "", std::nullopt);
                     }}},
                    {"export-verify", "viscard export --verify", {[](ResultVisitor& v) {
                       show_check(v, CaptureCheck{}, "");
                     }}}};
  if (!parse_words(syntax, words, streams)) return kDone;
  const bool is_json = syntax.as_json;
  if (verifies) {
    if (is_raw || out) throw UsageError("--verify writes no table; omit --out and --raw");
    return verify(capture, is_json, streams);
  }
  const CapturedRun run = read_capture(capture, reading);
  const CapturePart part = is_raw ? CapturePart::kRawBytes : CapturePart::kReadings;
  const std::string table = is_raw ? csv_from_raw_bytes(capture, run) : table_from_capture(run);
  if (out) {
    write_file(*out, table, overwrite);
    if (!is_json) {
      streams.out << *out << ": " << counted(run.load_samples.size(), "sample") << " of " << capture
                  << ", " << run.status << "\n";
    }
  } else if (!is_json) {
    streams.out << table;
  }
  if (is_json) {
    print_result(
        {"viscard-export/1", {capture}},
        [&](ResultVisitor& v) { show_summary(v, run, part, capture, out); }, streams);
  }
  for (const IntegrityNote& note : integrity_notes(run, part)) {
    streams.err << "viscard: " << capture << ": " << note.text << "\n";
  }
  const bool is_whole =
      !run.integrity.has_lost_log && !run.integrity.has_torn_log && run.integrity.faults.empty();
  if (run.status != "finished" && is_whole) {
    streams.err << "viscard: " << capture << " is "
                << (run.status == "running" ? "still being written" : "of an interrupted run")
                << "; all that was committed is exported\n";
  }
  return kDone;
}

}  // namespace viscard
