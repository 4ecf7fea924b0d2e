#include "io/capture/open_capture.h"

#include "io/capture/capture_header.h"
#include "io/capture/capture_lock.h"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;

}  // namespace

OpenCapture::OpenCapture(const fs::path& path) : path_(path) {
  check_capture_header(path);
  is_running_ = is_being_captured(path);
  try {
    database_.emplace(path, Database::Access::kReadOnly);
    database_->text_of("SELECT count(*) FROM sqlite_schema");
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CANTOPEN && error.code() != SQLITE_READONLY) explain(error);
    open_copy();
  }
}

OpenCapture::~OpenCapture() {
  database_.reset();
  std::error_code ignored;
  if (!copy_.empty()) fs::remove_all(copy_, ignored);
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
  std::string folder = (fs::temp_directory_path() / "viscard-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) {
    throw std::runtime_error(folder + ": cannot create: " + std::strerror(errno));
  }
  copy_ = folder;
  const fs::path file = copy_ / "copy.viscap";
  fs::copy_file(path_, file);
  if (has_journal(path_)) fs::copy_file(path_.string() + "-wal", file.string() + "-wal");
  database_.emplace(file, Database::Access::kReadWrite);
}

}  // namespace viscard
