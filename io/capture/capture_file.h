#pragma once

#include "models/experiment/captured_run.h"
#include "models/experiment/run_record.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace viscard {

// The capture file *.viscap: an SQLite database in WAL mode (tables: io/capture/README.md).
//
// What is guaranteed, in the order of append():
// - The first counts().committed records survive kill -9. These are all records appended longer ago
//   than commit_interval_s, while the disk keeps up, and all of them after sync().
// - The first counts().synced records survive a power cut. These are all but the last
//   sync_interval_s (or twice the time of one sync, on a disk that takes longer than half of it), and
//   all records before the last event.
// The file of an unfinished run can be read as well; its status shows that it is unfinished.

// How a capture file is written.
struct CaptureOptions {
  bool overwrite = false;
  // Of the new file, as for chmod; none: those of the file that is replaced, or the usual ones.
  std::optional<unsigned> rights;
  double commit_interval_s = 0.05;
  double sync_interval_s = 0.5;            // at most; an event is synced at once
  std::size_t queue_capacity = 200'000;    // records that wait for the disk; more are dropped
  std::size_t min_free_bytes = 16u << 20;  // on a disk with less room the writer refuses to start
};

// Numbers of records so far.
struct CaptureCounts {
  std::size_t appended = 0;   // taken by append()
  std::size_t committed = 0;  // written to the file: kill -9 keeps them
  std::size_t synced = 0;     // on the medium: a power cut keeps them
  std::size_t dropped = 0;    // because the queue was full; each time an event "gap" is stored
};

// Writes one run. append() may be called from several threads.
class CaptureWriter {
 public:
  // Creates the file with rig, plan, specimen, program, command and started_at (now, if empty) of
  // `about`. Throws std::runtime_error if the file exists and overwrite is false, if another
  // capture is writing it, or if it cannot be created.
  CaptureWriter(const std::filesystem::path& path, const CapturedRun& about,
                const CaptureOptions& options = {});
  // Without finish() the run reads as interrupted; no appended record is lost.
  ~CaptureWriter();
  CaptureWriter(const CaptureWriter&) = delete;
  CaptureWriter& operator=(const CaptureWriter&) = delete;

  // Queues a record; never waits for the disk. Throws std::runtime_error if an earlier write has
  // failed (disk full, medium gone); the records committed before stay in the file.
  void append(const RunRecord& record);

  // Waits until all records appended so far are on the medium. Throws as append() does.
  void sync();

  // Ends the run with status "finished" or "interrupted" and merges the journal, so that the file
  // can be copied without side files. Throws as append() does; the file then reads as interrupted.
  void finish(const std::string& status);

  CaptureCounts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Adds an event to the end of a finished capture: what became known later, such as lost steps that
// homing at the end of a series has shown. Throws std::runtime_error naming the file.
void add_late_event(const std::filesystem::path& path, const std::string& name,
                    const std::string& value, const std::string& text);

// How a capture is read.
struct CaptureReading {
  // Read a capture whose description, events or moves are not what was written (--unverified).
  bool accepts_damage = false;
};

// Reads everything but the raw bytes; never changes the file. The status is "running" while a live
// writer holds the file and "interrupted" if it was left unfinished. The record is compared with its
// checksums: damaged samples, reports of the stage and temperatures are left out and counted in
// `integrity`. Throws std::runtime_error (one line: file, reason, what to do) if the file is missing,
// empty, not a capture, truncated, damaged, or of a newer schema, if its side file belongs to another
// run, and if it holds values that no instrument gives.
CapturedRun read_capture(const std::filesystem::path& path, const CaptureReading& reading = {});

// Description of a capture for lists; read without its records.
struct CaptureState {
  std::string status;      // as CapturedRun::status
  std::string started_at;  // ISO 8601
};
// Throws as read_capture() does, but does not notice damage to the records.
CaptureState read_capture_state(const std::filesystem::path& path);

// Calls take with the raw bytes, in the order of reception or sending; those that are not what was
// written are left out, and read_capture() counts them. Throws as read_capture() does, but for damage
// to the records and the side file.
void read_raw_bytes(const std::filesystem::path& path,
                    const std::function<void(const RawBytes&)>& take);

}  // namespace viscard
