#pragma once

#include "io/basics/temporary_folder.h"
#include "io/capture/side_file_check.h"
#include "io/capture/sqlite_database.h"

#include <filesystem>
#include <optional>
#include <stdexcept>

namespace viscard {

// The log beside a capture is of another run, which is not in its own file.
class ForeignLog : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A capture opened for reading. SQLite needs to create a side file to read a journal, so on a
// read-only medium a copy is read. Throws std::runtime_error as read_capture() does.
class OpenCapture {
 public:
  explicit OpenCapture(const std::filesystem::path& path);
  OpenCapture(const OpenCapture&) = delete;
  OpenCapture& operator=(const OpenCapture&) = delete;

  Database& database() { return *database_; }
  bool is_running() const { return is_running_; }
  // Of the log beside the file, if nobody is writing it. SQLite has left out what is damaged in it.
  const SideFileCheck& side_file() const { return side_file_; }

  // Throws std::runtime_error that explains the error to a user.
  [[noreturn]] void explain(const SqliteError& error) const;

 private:
  void open_copy();
  void refuse_foreign_log();
  std::string foreign_object();

  std::filesystem::path path_;
  std::optional<TemporaryFolder> copy_;
  std::optional<Database> database_;
  bool is_running_ = false;
  SideFileCheck side_file_;
};

}  // namespace viscard
