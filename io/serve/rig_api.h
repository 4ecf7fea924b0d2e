#pragma once

#include "io/flow/capture_setup.h"
#include "io/flow/fit_file.h"
#include "io/serve/live_run.h"
#include "io/serve/one_job.h"
#include "io/serve/series_folder.h"

#include <nlohmann/json_fwd.hpp>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

namespace viscard {

// Which rig and which series a page shows.
struct ServeOptions {
  std::filesystem::path folder;
  std::optional<std::string> rig_file;  // required unless emulated
  bool is_emulated = false;
  std::optional<std::uint64_t> seed;
  double speed = 1.0;            // of the emulated clock
  bool is_uncalibrated = false;  // accept an expired calibration
  int port = 0;                  // 0: any free one
  std::string command;           // recorded in the captures as their origin
};

// The requests of the page, as functions from JSON to JSON. All state is in
// the folder and in the running capture; files are read again for each request. Functions throw
// ApiError, or std::exception with a message for a person. Any thread may call them.
class RigApi {
 public:
  // job: what goes on at the rig.
  RigApi(ServeOptions options, OneJob& job);

  // Rig, test, specimens with their captures, what to do next, and what is going on.
  nlohmann::ordered_json state() const;
  nlohmann::ordered_json ports() const;
  // Opens both devices for some seconds; moves nothing.
  nlohmann::ordered_json check_rig();
  // {"specimen", "test" or "text"}: the expected course of a test that need not be saved.
  nlohmann::ordered_json preflight_of(const nlohmann::ordered_json& request) const;
  // {"test": changes}, or {"text"}: the whole test file, of any protocol.
  nlohmann::ordered_json save_test(const nlohmann::ordered_json& request);
  // The test file, and an example of each protocol.
  nlohmann::ordered_json test_texts() const;
  nlohmann::ordered_json add_specimen(const nlohmann::ordered_json& request);
  nlohmann::ordered_json remove_specimen(const nlohmann::ordered_json& request);
  // {"name", "id"}: of a specimen without captures, which hold its name.
  nlohmann::ordered_json rename_specimen(const nlohmann::ordered_json& request);
  // {"capture"}: moves it into the folder trash, unless a material names it.
  nlohmann::ordered_json remove_capture(const nlohmann::ordered_json& request);
  // {"capture", "note"}: what a person wants to remember of a run.
  nlohmann::ordered_json note_capture(const nlohmann::ordered_json& request);
  // {"capture"}: its table (viscard export) as NAME.csv in the folder; a file there is not replaced.
  nlohmann::ordered_json export_capture(const nlohmann::ordered_json& request);
  // {"capture"}: force against time since contact.
  nlohmann::ordered_json capture_curve(const nlohmann::ordered_json& request);
  // {"specimen", "test", "repeat", "lift"}; test: what the page has shown of it; repeat: although there is a finished capture; lift: a punch that
  // presses at the start is lifted, and the test goes on.
  nlohmann::ordered_json start_run(const nlohmann::ordered_json& request);
  // {"how": "gently" | "at once"}.
  nlohmann::ordered_json stop_run(const nlohmann::ordered_json& request);
  // The run, with the points from number `from` on if `keep_every` still holds, else all.
  nlohmann::ordered_json run(std::size_t from, std::size_t keep_every) const;
  // {"capture", "keep"}: fits it; the material of a finished one is written beside it unless it is
  // there, or keep is false.
  nlohmann::ordered_json fit(const nlohmann::ordered_json& request);

  // No more work is begun; a run is stopped gently. Returns at once, with true if no work is going
  // on; call it again until then.
  bool close();
  // How the last run ended.
  LiveState last_run() const { return live_.state(); }

 private:
  RigConfig rig() const;
  CaptureSetup setup_of(const std::string& specimen) const;
  void check_before_run(const CaptureSetup& setup) const;
  // Returns the name of the file, which is written unless it is there.
  std::string save_material(const FittedFile& fitted, const std::string& specimen) const;

  ServeOptions options_;
  SeriesFolder folder_;
  OneJob& job_;
  std::mutex writing_;  // of specimens, notes and the trash
  LiveRun live_;        // destroyed first: its thread uses the others
};

}  // namespace viscard
