#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// A file that was read, and the SHA-256 of what was read from it.
struct InputFile {
  std::string path;  // as it was named
  std::string sha256;
  std::string note = {};  // what must be known of it, such as that it was edited
};

// Records every file that read_file() reads while it lives, in all threads or in its own thread only. A
// file whose contents change meanwhile is there once for each.
class InputRecorder {
 public:
  enum class Of { kProcess, kThread };
  explicit InputRecorder(Of of = Of::kProcess);
  ~InputRecorder();
  InputRecorder(const InputRecorder&) = delete;
  InputRecorder& operator=(const InputRecorder&) = delete;

  // In the order of their names.
  std::vector<InputFile> files() const;
  bool is_of_process() const { return thread_ == nullptr; }

 private:
  friend void record_input_sum(const std::filesystem::path& path, const std::string& sha256);
  friend void note_input(const std::filesystem::path& path, const std::string& note);
  void* thread_ = nullptr;  // whose files count; null: all
  std::vector<InputFile> files_;
};

// The files that the innermost recorder of the process has seen; none without one. What a command writes
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
