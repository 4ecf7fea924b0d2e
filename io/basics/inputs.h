#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A file that was read, and the SHA-256 of what was read from it.
struct InputFile {
  std::string path;  // as it was named
  std::string sha256;
  std::string note = {};  // what must be known of it, such as that it was edited
};

// Records every file that read_file() reads while it lives. A file whose contents change meanwhile is there once for
// each.
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
  std::uint64_t number_;          // no two recorders have the same
  std::vector<InputFile> files_;  // in the order in which they were read last
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
// Adds a note to a recorded file; commands print it and --json has it beside the file.
void note_input(const std::filesystem::path& path, const std::string& note);
// Whether there is any recorder.
bool is_recording_inputs();

// The object {"schema": "viscard-inputs/1", "created_by", "is_recorded", "table_sha256", "files": [{"path",
// "sha256", perhaps "note"}]} that lies beside a table. is_recorded false: of some rows the inputs are not known. The sum of
// the table shows which table it belongs to.
std::string json_from_inputs(const std::vector<InputFile>& files, bool is_recorded,
                             const std::string& table);

}  // namespace viscard
