#pragma once

#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A specimen of a series, with the files that belong to it.
struct SeriesSpecimen {
  struct Capture {
    std::string file;    // name in the folder
    std::string status;  // CaptureState::status, or "unreadable"
    std::string started_at;
    std::string trouble;  // why it cannot be read
    std::string note;     // of a person
  };
  std::string name;  // of the specimen file without .toml; also that of its captures
  std::optional<Specimen> specimen;
  std::string trouble;            // why the specimen cannot be tested
  std::vector<Capture> captures;  // in the order of the attempts
  std::string material_file;      // name in the folder, or empty

  // "running", "finished", "interrupted" or "none": the newest running or the first finished
  // capture counts, else whether there is any.
  std::string state() const;
};

// The folder of a series. Everything that the page shows of past runs is read from it:
//   NAME.toml                         one specimen each, in the order of the names
//   test.toml                         the test; without it the defaults of TestPlan hold
//   NAME.viscap, NAME.2.viscap ...    captures (io/flow/series_files.h)
//   NAME.json                         the material of the fit
//   NAME.truth.toml                   what an emulated specimen is made of
//   NAME.viscap.note.txt              the note of a run
//   trash/                            captures that were taken away
// rig.toml in it is not a specimen. The numbers that names begin with ("02_a", "10_b") order them.
class SeriesFolder {
 public:
  // Creates the folder. Throws std::runtime_error if it is a file or cannot be created.
  explicit SeriesFolder(const std::filesystem::path& folder);

  const std::filesystem::path& path() const { return folder_; }
  // Why nothing can be recorded in the folder, or "".
  std::string trouble() const;
  std::filesystem::path test_file() const { return folder_ / "test.toml"; }
  std::filesystem::path specimen_file(const std::string& name) const;
  std::filesystem::path first_capture(const std::string& name) const;
  std::optional<std::string> truth_file(const std::string& name) const;

  // Throws std::runtime_error naming file, line and key.
  TestPlan test() const;
  // Throws what a capture would refuse, naming the key of test.toml.
  void save_test(const TestPlan& plan) const;
  // The same with the text of the file, which may have comments.
  void save_test_text(const std::string& text, const TestPlan& plan) const;
  // Of the file, or of the test that holds without it.
  std::string test_text() const;
  // The same check without saving.
  void check_test(const TestPlan& plan) const;

  std::vector<SeriesSpecimen> specimens() const;
  // Throws ApiError 404 unless the name is one of specimens().
  SeriesSpecimen specimen_named(const std::string& name) const;
  // Writes the file of a new specimen, numbered after the others, and returns its name.
  std::string add_specimen(const Specimen& specimen) const;
  // Throws ApiError 409 if there is a capture of it.
  void remove_specimen(const std::string& name) const;

  // Gives it another id and name, and returns the name. Throws ApiError 409 if there is a capture of it.
  std::string rename_specimen(const std::string& name, const std::string& id) const;

  // Moves a capture into trash/ and returns its name there. Throws ApiError 409 if the material names it, or
  // while it is written.
  std::string trash_capture(const std::string& file) const;
  // Keeps a note beside the capture; an empty one is removed.
  void note_capture(const std::string& file, const std::string& note) const;

  // The specimen that lists a capture of this name. Throws ApiError 404 if there is none.
  SeriesSpecimen specimen_of_capture(const std::string& file) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace viscard
