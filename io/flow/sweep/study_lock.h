#pragma once

#include "io/capture/sqlite_database.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <thread>

namespace viscard {

// An existing file, opened so that it and what lies beside it stay as they are.
Database opened_to_look(const std::filesystem::path& path);
// Throws std::runtime_error: the file is SQLite's, and no store of a study.
[[noreturn]] void refuse_other_file(const std::filesystem::path& path);
// Throws std::runtime_error if an existing file is no store of a study. Does not change it.
void refuse_other_kind(const std::filesystem::path& path);
// Throws std::runtime_error if the file has two names (hard links).
void refuse_second_name(const std::filesystem::path& path);

// Held while the points of a store are answered.
class StudyLock {
 public:
  // Creates the file if there is none. Throws std::runtime_error if another program answers its
  // points already, because both would do the same work, if it is a file of another kind, or if it
  // has two names (a hard link), because SQLite's side files belong to a name. on_gone: called
  // once, within a second, when the file was deleted, moved or replaced; from a thread of its own.
  // waits_s: how long to wait for the other program.
  StudyLock(std::filesystem::path path, std::function<void(const std::string&)> on_gone,
            double waits_s = 0.0);
  ~StudyLock();
  StudyLock(const StudyLock&) = delete;
  StudyLock& operator=(const StudyLock&) = delete;

  // Throws std::runtime_error once the file is gone: answers in it would be lost.
  void check_file() const;

 private:
  std::string why_gone() const;
  void watch(const std::stop_token& stop);

  std::filesystem::path path_;
  std::function<void(const std::string&)> on_gone_;
  int fd_ = -1;
  std::jthread watch_;  // last, so that it ends first
};

}  // namespace viscard
