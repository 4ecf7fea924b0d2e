#pragma once

#include "io/serve/one_job.h"
#include "io/serve/rig_api.h"

#include <nlohmann/json_fwd.hpp>

namespace viscard {

// The rig file on the page: which drivers and ports it names. The requests are functions from JSON to JSON. They
// throw ApiError, or std::exception with a message for a person. Any thread may call them.
class RigSetup {
 public:
  // job: the one that the runs have, too; the file does not change while one goes on.
  RigSetup(ServeOptions options, OneJob& job) : options_(std::move(options)), job_(job) {}

  // {"text", "file", "is_kept", "stage_drivers", "load_cell_drivers", "ports"}; is_kept: whether the page may change it.
  nlohmann::ordered_json text() const;
  // {"text", "keep", "plausible"}: checks the text as `viscard rig check` does, without a port; keep: writes it, and the
  // text of before into the first free FILE.1, FILE.2 ... beside it. Returns {"name", "kept_before"}.
  nlohmann::ordered_json take(const nlohmann::ordered_json& request);

 private:
  ServeOptions options_;
  OneJob& job_;
};

}  // namespace viscard
