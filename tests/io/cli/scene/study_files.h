#pragma once

#include "io/basics/atomic_file.h"
#include "tests/io/scenes/scene_text.h"

#include <string>

namespace viscard::test {

inline const char* const kPressedScene = R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33 }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
[want]
quantities = ["top_displacement"]
)";

inline const char* const kStudy = R"(scene = "scene.toml"
[[parameter]]
key = "geometry.diameter"
from = "30 um"
to = "50 um"
count = 6
[[parameter]]
key = "materials.pillar.nu"
values = ["0.3", "0.4", "-1"]
[[parameter]]
key = "analysis.load.pressure"
from = "100 Pa"
to = "1000 Pa"
count = 5
spacing = "log"
)";

// A study beside its scene.
struct StudyFiles {
  SceneText scene{kPressedScene};
  std::string study = scene.beside("study.toml");
  explicit StudyFiles(const std::string& text = kStudy) { write_file(study, text, false); }
};

}  // namespace viscard::test
