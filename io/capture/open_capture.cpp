#include "io/capture/open_capture.h"

#include "io/capture/capture_database.h"
#include "io/capture/capture_header.h"
#include "io/capture/capture_lock.h"

#include <sqlite3.h>

#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

// Which run a database is of. Captures before schema 5 have no identity; their description, which is
// written before the log begins, takes its place. Empty: not readable.
std::string identity_of(Database& database) {
  try {
    if (schema_of(database) >= kFirstSchemaWithIdentity)
      return database.text_of("SELECT run_id FROM identity");
    return std::to_string(checksum_of_run(database, RunPart::kStart).crc32());
  } catch (const SqliteError&) {
    return {};
  }
}

}  // namespace

OpenCapture::OpenCapture(const fs::path& path) : path_(path) {
  check_capture_header(path);
  is_running_ = is_being_captured(path);
  if (!is_running_ && has_journal(path)) {
    const std::string log = path.string() + "-wal";
    side_file_ = check_side_file(log);
    if (!side_file_.damage.empty())
      side_file_.damage = "its side file " + log + ": " + side_file_.damage;
  }
  try {
    database_.emplace(path, Database::Access::kReadOnly);
    database_->text_of("SELECT count(*) FROM sqlite_schema");
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CANTOPEN && error.code() != SQLITE_READONLY) explain(error);
    open_copy();
  }
  if (const std::string foreign = foreign_object(); !foreign.empty()) {
    throw std::runtime_error(
        path_.string() + ": holds the " + foreign +
        ", which no capture does: the file was altered. Use another copy of it");
  }
  if (!is_running_ && has_journal(path_)) refuse_foreign_log();
}

// SQLite applies any log that lies beside a file, also that of another run whose file was copied over.
// Every transaction rewrites the page with the identity, so the identity that is
// read with the log is that of the log.
void OpenCapture::refuse_foreign_log() {
  const fs::path file = copy_ ? *copy_ / "copy.viscap" : path_;
  bool is_foreign = !is_log_expected(file);
  if (!is_foreign) {
    Database alone(file, Database::Access::kMainFileOnly);
    const std::string own = identity_of(alone);
    is_foreign = !own.empty() && own != identity_of(*database_);
  }
  if (!is_foreign) return;
  const std::string log = path_.string() + "-wal";
  throw ForeignLog(path_.string() + ": its side file " + log +
                   " belongs to another run; it was left there when another capture was copied to "
                   "this name. Move " +
                   log + " and " + path_.string() + "-shm away, then try again");
}

std::string OpenCapture::foreign_object() {
  try {
    return database_->first_foreign_object();
  } catch (const SqliteError& error) {
    explain(error);
  }
}

void OpenCapture::explain(const SqliteError& error) const {
  if (error.code() == SQLITE_CORRUPT || error.code() == SQLITE_NOTADB) {
    throw std::runtime_error(path_.string() +
                             " is damaged; use another copy of it, or save what is left with: "
                             "sqlite3 " +
                             path_.string() + " .recover");
  }
  throw std::runtime_error(error.what());
}

void OpenCapture::open_copy() {
  copy_.emplace();
  const fs::path file = *copy_ / "copy.viscap";
  fs::copy_file(path_, file);
  if (has_journal(path_)) fs::copy_file(path_.string() + "-wal", file.string() + "-wal");
  database_.emplace(file, Database::Access::kReadWrite);
}

}  // namespace viscard
