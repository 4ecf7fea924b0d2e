#pragma once

#include "io/config/config_file.h"
#include "models/experiment/captured_run.h"
#include "models/experiment/run_record.h"

#include <string>

namespace viscard::test {

// What a capture of the demo's first specimen starts with.
inline CapturedRun demo_run() {
  const std::string folder = std::string(VISCARD_SOURCE_DIR) + "/data/demo/";
  CapturedRun run;
  run.rig = read_rig(folder + "01_rig.toml");
  run.plan = read_test(folder + "02_test.toml");
  run.specimen = read_specimen(folder + "03_pdms_1to10.toml");
  run.command = "viscard capture --emulate";
  return run;
}

inline LoadSample sample(std::int64_t index) {
  LoadSample out;
  out.index = index;
  out.host_time_s = 0.0125 * static_cast<double>(index);
  out.device_time_s = out.host_time_s + 0.1;
  out.counts = 1000.0 + static_cast<double>(index);
  return out;
}

}  // namespace viscard::test
