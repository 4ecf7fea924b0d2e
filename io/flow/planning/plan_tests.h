#pragma once

#include "fit/planning/protocol_study.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Which tests `viscard cost --rig` compares. Paths of files.
struct TestStudyRequest {
  std::string rig, specimen;
  std::optional<std::string> test;   // its approach is kept, and it is compared with the others
  std::optional<std::string> guess;  // material file
  std::optional<std::string> scene;  // whose results may be wanted
  std::vector<std::string> want;     // "E0=1%", or "voltage=3%" of the scene
  double longest_s = 3600.0;         // at the rig
};

struct TestStudy {
  Bench bench;
  Material guess;
  std::string guess_text;  // where the guess comes from
  ProtocolStudy protocols;
};

// Reads the files, refuses tests that the checks before a run would refuse, and studies the others on
// all cores. Throws std::invalid_argument for a wish that cannot be read, and what the readers throw.
TestStudy study_tests(const TestStudyRequest& request);

// "E0=1%" or "g_2=0.05". Throws std::invalid_argument.
WantedQuantity wanted_from_text(const std::string& text);

}  // namespace viscard
