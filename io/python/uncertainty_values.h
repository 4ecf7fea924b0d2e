#pragma once

#include "io/flow/scenes/scene_uncertainty.h"

#include <pybind11/pybind11.h>

#include <optional>

namespace viscard::python {

// The uncertainty of an answer as a dict; None if nobody asked.
pybind11::object uncertainty_object(const std::optional<SceneUncertainty>& found);

}  // namespace viscard::python
