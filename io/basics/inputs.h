#pragma once

#include "models/maths/failure_text.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// A file that was read, and the SHA-256 of what was read from it.
struct InputFile {
  std::string path;  // as it was named
  std::string sha256;
  std::string note = {};  // what must be known of it, such as that it was edited
};

// A file is not what it was when the running work first read it.
class InputChanged : public StopsWork {
 public:
  using StopsWork::StopsWork;
};

// Records every file that read_file() reads while it lives. A file that somebody changes meanwhile is
// refused by the innermost recorder of a command, and by those of the thread: InputChanged is thrown
// where it is read again. Files that this program writes itself, captures that are being written, and
// what is no plain file (pipes) may change; such a file is there once for each contents.
class InputRecorder {
 public:
  // Whose files: of all threads; of this thread and those that work for it (recorded_as_here()), as one command; of
  // the same threads, as a part of a command.
  enum class Of { kProcess, kCall, kPart };
  explicit InputRecorder(Of of = Of::kProcess);
  ~InputRecorder();
  InputRecorder(const InputRecorder&) = delete;
  InputRecorder& operator=(const InputRecorder&) = delete;

  // In the order of their names.
  std::vector<InputFile> files() const;

 private:
  friend struct InputRecords;
  Of of_;
  std::uint64_t number_;           // no two recorders have the same
  std::vector<InputFile> files_;   // in the order in which they were read last
  std::set<std::string> written_;  // by this program
  bool accepts_changes_ = false;
};

// The work, whose files are recorded as if this thread read them, in whichever thread it runs.
std::function<void()> recorded_as_here(std::function<void()> work);

// The files that the innermost recorder of a command has seen; none without one. What a command writes
// or prints about its inputs comes from here.
std::vector<InputFile> provenance_of_inputs();

// Whether that recorder has seen this file, under any name of it.
bool is_input(const std::filesystem::path& path);

// The first lines of a table that this command writes: "# COMMAND (viscard VERSION)", and the notes of what was
// read.
std::string head_of_table(const std::string& command);

// Called by what reads files.
void record_input(const std::filesystem::path& path, const std::string& contents);
void record_input_sum(const std::filesystem::path& path, const std::string& sha256);
// The sum of what was read last from the file of this name; nothing if no recorder of this thread has seen it.
std::optional<std::string> recorded_sum(const std::filesystem::path& path);
// Called by what writes files: this one may be read again with other contents.
void note_output(const std::filesystem::path& path);
// Called when a file cannot be read. Throws InputChanged if it could be read before, by which its
// absence is no property of what was asked.
void refuse_lost_input(const std::filesystem::path& path, const std::string& why);
// For work that shows files as they change, such as a live page: the innermost recorder of the
// process takes a file once for each contents.
void accept_changed_inputs();
// Adds a note to a recorded file; commands print it and --json has it beside the file.
void note_input(const std::filesystem::path& path, const std::string& note);
// Whether there is any recorder.
bool is_recording_inputs();

// The object {"schema": "viscard-inputs/1", "created_by", "is_recorded", "table_sha256", "files": [{"path",
// "sha256", perhaps "note"}], perhaps "plausible": "off"} that lies beside a table. is_recorded false: of some rows the
// inputs are not known. The sum of the table shows which table it belongs to.
std::string json_from_inputs(const std::vector<InputFile>& files, bool is_recorded,
                             const std::string& table, bool is_plausible_off);

}  // namespace viscard
