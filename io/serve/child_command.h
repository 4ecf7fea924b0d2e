#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// What a command in a process of its own may take.
struct ChildLimits {
  std::size_t processor_s = 120;
  std::chrono::seconds clock{300};
  std::size_t memory_B = std::size_t{4} << 30;
  std::size_t file_B = std::size_t{256} << 20;  // largest file or output that it writes
};

// How it ended.
struct ChildEnd {
  int status = -1;  // exit status; -1: it did not exit by itself
  std::string out;  // what it printed
  std::string err;
  std::string trouble;  // why it did not exit: "took more than 120 s ..."; empty: it exited
};

// Runs `program WORDS...` in this folder, with this text to read at /dev/stdin, and returns when it has ended. A
// table that kills or exhausts it ends nothing else. `is_closing` ends it. Throws std::runtime_error if no process can be started.
ChildEnd run_child(const std::string& program, const std::vector<std::string>& words,
                   const std::filesystem::path& folder, const ChildLimits& limits,
                   const std::atomic<bool>& is_closing, const std::string& input = "");

}  // namespace viscard
