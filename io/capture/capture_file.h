#pragma once

#include "models/experiment/captured_run.h"
#include "models/experiment/run_record.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace viscard {

// The capture file *.viscap: an SQLite database in WAL mode (tables: io/README.md).
//
// The promise. counts().committed records, in the order of append(), survive kill -9: those
// appended longer ago than commit_interval_s while the disk keeps up, and all when sync() has
// returned. counts().synced of them survive a power cut: all but the last sync_interval_s, and
// every one before the last event of the run. A file whose run was not finished opens all the same
// and says so.

struct CaptureOptions {
  bool overwrite = false;
  double commit_interval_s = 0.05;
  double sync_interval_s = 0.5;            // at most; phase events sync at once
  std::size_t queue_capacity = 200'000;    // records waiting for the disk; more are dropped
  std::size_t min_free_bytes = 16u << 20;  // refuse to start on a disk with less room
};

// What became of the records so far.
struct CaptureCounts {
  std::size_t appended = 0;   // taken by append()
  std::size_t committed = 0;  // written to the file: kill -9 keeps them
  std::size_t synced = 0;     // on the medium: a power cut keeps them
  std::size_t dropped = 0;    // lost to a full queue, each stretch of them stored as an event "gap"
};

// Writes one run. append() may be called from several threads.
class CaptureWriter {
 public:
  // Creates the file. Of `about` only rig, plan, specimen, program, command and started_at (now, if
  // empty) are used. Throws std::runtime_error when the file exists and overwrite is false, when
  // another capture is writing it, or when it cannot be created.
  CaptureWriter(const std::filesystem::path& path, const CapturedRun& about,
                const CaptureOptions& options = {});
  // Without finish() the run stays marked as interrupted; nothing appended is lost.
  ~CaptureWriter();
  CaptureWriter(const CaptureWriter&) = delete;
  CaptureWriter& operator=(const CaptureWriter&) = delete;

  // Queues a record; never waits for the disk. Throws std::runtime_error when an earlier write has
  // failed (disk full, medium gone): what was committed before stays.
  void append(const RunRecord& record);

  // Waits until everything appended so far is on the medium. Throws as append() does.
  void sync();

  // Ends the run with status "finished" or "interrupted", and makes the file one that can be
  // copied: journal merged, no side files. Throws as append() does; the file then reads as
  // interrupted.
  void finish(const std::string& status);

  CaptureCounts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Everything but the raw bytes. Never changes the file. Status "running" when a live writer holds
// it, "interrupted" when it was left unfinished. Throws std::runtime_error (one line: file, reason,
// what next) when it is missing, empty, not a capture, truncated, damaged, or of a newer schema.
CapturedRun read_capture(const std::filesystem::path& path);

// The raw bytes in the order of reception or sending. Throws as read_capture() does.
void read_raw_bytes(const std::filesystem::path& path,
                    const std::function<void(const RawBytes&)>& take);

// True when the file is called *.viscap or begins like an SQLite database, so that a command can
// tell captures from tables, a damaged one too.
bool looks_like_capture(const std::filesystem::path& path);

}  // namespace viscard
