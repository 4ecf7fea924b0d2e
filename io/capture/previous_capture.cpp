#include "io/basics/atomic_file.h"
#include "io/basics/output_name.h"
#include "io/basics/words.h"
#include "io/capture/capture_header.h"
#include "io/capture/capture_lock.h"
#include "io/capture/open_capture.h"

#include <stdexcept>
#include <utility>
#include <vector>

namespace viscard {
namespace {

template <class From, class To>
void move_parts(From from, To to) {
  for (const char* suffix : kDatabaseParts) {
    if (std::filesystem::exists(from(suffix))) std::filesystem::rename(from(suffix), to(suffix));
  }
}

// Puts the log of an interrupted run into its file, so that who moves the file moves all of it. A log that is
// damaged stays, because a merge would lose what can still be found in it; so does one that cannot be merged, as
// on a full disk.
void merge_log(const std::filesystem::path& path) {
  if (!has_journal(path)) return;
  try {
    {
      const OpenCapture capture(path);
      if (!capture.side_file().damage.empty() || capture.side_file().is_torn) return;
    }
    Database database(path, Database::Access::kReadWrite);
    database.execute("PRAGMA synchronous=EXTRA");
    database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
    database.text_of("PRAGMA journal_mode=DELETE");
  } catch (const ForeignLog&) {
    throw;  // the only copy of what another run has recorded
  } catch (const std::runtime_error&) {
    // All parts are kept.
  }
}

}  // namespace

PreviousCapture::PreviousCapture(std::filesystem::path path, bool is_replaced)
    : path_(std::move(path)) {
  if (!is_replaced || !std::filesystem::is_regular_file(path_) || is_being_captured(path_)) {
    return;  // the writer reports what is wrong
  }
  refuse_orphaned_log(path_, "capture");
  refuse_kept();
  rights_ = rights_of_file(path_);
  merge_log(path_);
  move_parts([this](const char* suffix) { return part(suffix); },
             [this](const char* suffix) { return aside(suffix); });
  is_aside_ = true;
}

PreviousCapture::~PreviousCapture() {
  if (!is_aside_) return;
  try {
    for (const char* suffix : kDatabaseParts) std::filesystem::remove(part(suffix));
    move_parts([this](const char* suffix) { return aside(suffix); },
               [this](const char* suffix) { return part(suffix); });
  } catch (const std::filesystem::filesystem_error&) {
    // The old capture is still there under its other name.
  }
}

void PreviousCapture::drop() {
  if (!is_aside_) return;
  for (const char* suffix : kDatabaseParts) std::filesystem::remove(aside(suffix));
  is_aside_ = false;
}

void PreviousCapture::refuse_kept() const {
  refuse_orphaned_log(aside(""), "capture");
  if (!std::filesystem::exists(aside(""))) return;
  std::vector<std::string> kept;
  for (const char* suffix : kDatabaseParts) {
    if (std::filesystem::exists(aside(suffix))) kept.push_back(aside(suffix).string());
  }
  throw std::runtime_error(
      listed(kept) +
      (kept.size() == 1
           ? " is a capture that an earlier --force has kept; move it away"
           : " are a capture that an earlier --force has kept; move them away together, into a "
             "folder of their own: without its side files the newest records are lost"));
}

std::filesystem::path PreviousCapture::part(const char* suffix) const {
  return path_.string() + suffix;
}

std::filesystem::path PreviousCapture::aside(const char* suffix) const {
  return path_.string() + ".previous" + suffix;
}

}  // namespace viscard
