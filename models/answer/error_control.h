#pragma once

#include "models/answer/scene_answer.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace viscard {

// Everything a scene asks for on one mesh, without mesh errors.
using MeshAnswer = std::function<SceneAnswer(const Discretisation&)>;

// A mesh on which there is no answer, though there may be one on a finer mesh.
class MeshTooCoarse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ErrorControl {
  double tolerance = 1e-3;  // relative, of every result, frequency and point of a curve
  std::vector<Discretisation> meshes;
  // Called with the fraction of the meshes done and the next one; may be empty.
  std::function<void(double, const std::string&)> progress;
  // Least share of the last change that is assumed to remain if the mesh gained a layer at the rim.
  double share_left = kShareLeft;
  // The answer's own step error falls from mesh to mesh, too: finer ones are tried although it is large.
  bool step_error_falls = false;
  // The last mesh is the one that counts, and the one before it is so much finer that the change is its error.
  bool is_last_measured = false;

  static constexpr double kShareLeft = 0.1;
};

// Runs through the meshes until the estimate of every number is within the tolerance: the change
// from the last mesh, but at least share_left of the change before and share_left^2 of the one before
// that (two and a half times that if the layers stayed the same), so that a chance agreement of two
// meshes does not pass, plus the answer's own step error. A curve with a span changes as a whole (SceneCurve). Passes over meshes that
// are too coarse, except the finest. Throws std::runtime_error with the worst number and its error if the
// finest mesh is not enough.
SceneAnswer answer_within(const ErrorControl& control, const MeshAnswer& answer_on);

}  // namespace viscard
