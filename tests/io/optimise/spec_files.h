#pragma once

#include "io/flow/optimise/design_spec.h"
#include "models/sensor/sensor_design.h"
#include "tests/io/scenes/scene_text.h"

#include <fstream>
#include <string>

namespace viscard::test {

inline const char* const kPillar = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
[analysis]
kind = "modal"
modes = 1
)";

// A specification of that pillar (or of another scene) in a folder of its own.
class SpecFiles {
 public:
  explicit SpecFiles(const std::string& spec, const std::string& scene = kPillar)
      : scene_(scene), path_(scene_.beside("spec.toml")) {
    std::ofstream(path_) << "scene = \"scene.toml\"\n" << spec;
  }
  std::string path() const { return path_; }
  DesignSpec read() const { return read_design_spec(path_); }
  std::string beside(const std::string& name) const { return scene_.beside(name); }

 private:
  SceneText scene_;
  std::string path_;
};

inline const char* const kLongest = R"([[objective]]
quantity = "geometry.length"
goal = "largest"
[[range]]
key = "geometry.length"
)";

// The longest pillar of 40 um that stands with this modulus and margin (eq. D4).
inline double longest_m(double E_Pa, double margin) {
  SensorMaterial material;
  material.young_modulus_Pa = E_Pa;
  return longest_upright_m(40e-6, material) / margin;
}

}  // namespace viscard::test
