#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "io/scenes/scene_file.h"
#include "models/array/space/space_inverse.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <variant>

namespace viscard::python {
namespace {

namespace py = pybind11;
using Frames = py::array_t<double, py::array::c_style>;

// A prepared array, and the shape of its frames.
struct VoltageReader {
  LoadReader reader;
  py::ssize_t rows = 0, columns = 0, readings = 1, loads = 1;
};

SpaceScene array_scene(const std::optional<std::string>& text, const std::string& path) {
  const SceneFile file = text ? scene_from_toml(*text, path) : read_scene(path);
  if (const auto* scene = std::get_if<SpaceScene>(&file.scene)) return *scene;
  throw std::runtime_error(path +
                           ": geometry: pressures are found for arrays in the plane, with kind = "
                           "\"array\" and model = \"space\"");
}

// Frames of the array: [frames,] rows x columns [x four quarters].
VoltageFrames frames_of(const Frames& voltages, py::ssize_t rows, py::ssize_t columns,
                        py::ssize_t readings) {
  std::vector<py::ssize_t> wanted{rows, columns};
  if (readings > 1) wanted.push_back(readings);
  const auto dimensions = static_cast<py::ssize_t>(wanted.size());
  const py::ssize_t first = voltages.ndim() - dimensions;  // dimensions in front
  bool fits = (first == 0 || first == 1) && voltages.size() > 0;
  for (py::ssize_t d = 0; fits && d < dimensions; ++d) {
    fits = voltages.shape(first + d) == wanted[static_cast<std::size_t>(d)];
  }
  if (!fits) {
    throw OptionError("voltages do not fit the array: a frame has " + std::to_string(rows) +
                      " rows and " + std::to_string(columns) + " columns" +
                      (readings > 1 ? " of four quarters" : "") +
                      "; several frames have one dimension more in front");
  }
  return {voltages.data(), static_cast<std::size_t>(first == 0 ? 1 : voltages.shape(0))};
}

std::unique_ptr<VoltageReader> voltage_reader(const std::optional<std::string>& text,
                                              const std::string& path, const Frames& examples,
                                              std::optional<double> noise_V, double gain_spread,
                                              double shear_Pa, const std::string& penalty,
                                              std::optional<double> weight, bool at_centre) {
  InverseOptions options{
      .noise_V = noise_V, .gain_spread = gain_spread, .shear_Pa = shear_Pa, .at_centre = at_centre};
  if (!penalty.empty()) {
    options.choice.penalty = penalty == "size" ? Penalty::kSize : Penalty::kSlope;
  }
  options.choice.weight = weight;
  const auto scene = in_background(
      {}, [=](Job&) { return std::make_shared<const SpaceScene>(array_scene(text, path)); });
  const auto rows = static_cast<py::ssize_t>(scene->rows);
  const auto columns = static_cast<py::ssize_t>(scene->columns);
  const auto readings = static_cast<py::ssize_t>(inverse_readings(*scene));
  const std::size_t count = frames_of(examples, rows, columns, readings).count;
  const double* first = examples.data();
  const auto voltages_V =
      std::make_shared<const std::vector<double>>(first, first + examples.size());
  const auto reader = in_background({}, [=](Job&) {
    const auto prepare = [&] { return load_reader(*scene, {voltages_V->data(), count}, options); };
    if (!text) return std::make_shared<LoadReader>(with_lines_of(path, prepare));
    try {
      return std::make_shared<LoadReader>(prepare());
    } catch (const SceneMistake& mistake) {  // no file has this text
      throw std::runtime_error(path + ": " + mistake.key() + ": " + mistake.what());
    }
  });
  return std::make_unique<VoltageReader>(
      VoltageReader{std::move(*reader), rows, columns, readings,
                    static_cast<py::ssize_t>(inverse_loads(*scene))});
}

// Loads and half widths of their intervals, Pa: frames x rows x columns x loads.
py::tuple read_frames(const VoltageReader& of, const Frames& frames) {
  const VoltageFrames seen = frames_of(frames, of.rows, of.columns, of.readings);
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(seen.count), of.rows, of.columns,
                                       of.loads};
  py::array_t<double> loads_Pa(shape), half_widths_Pa(shape);
  double* loads = loads_Pa.mutable_data();
  double* half_widths = half_widths_Pa.mutable_data();
  {
    const py::gil_scoped_release others;
    of.reader.read(seen, loads, half_widths);
  }
  return py::make_tuple(loads_Pa, half_widths_Pa);
}

const char* word_of(WeightRule rule) {
  return rule == WeightRule::kDiscrepancy       ? "discrepancy"
         : rule == WeightRule::kCrossValidation ? "cross-validation"
                                                : "stated";
}

py::dict facts_of(const VoltageReader& of) {
  const Regularisation& found = of.reader.regularisation();
  py::dict regularisation, out;
  regularisation["penalty"] = found.penalty == Penalty::kSize ? "size" : "slope";
  regularisation["rule"] = word_of(found.rule);
  regularisation["weight"] = found.weight;
  regularisation["is_at_limit"] = found.is_at_limit;
  regularisation["noise_V"] = found.noise_V;
  regularisation["total_V"] = found.total_V;
  regularisation["prior_Pa"] = found.prior_Pa;
  out["regularisation"] = regularisation;
  out["condition"] = of.reader.condition();
  out["pitch_m"] = of.reader.pitch_m();
  const std::vector<py::ssize_t> shape{of.rows, of.columns, of.loads};
  py::array_t<double> share(shape), resolution_m(shape);
  py::array_t<bool> is_resolved(shape), works({of.rows, of.columns, of.readings});
  const auto fill = [](auto& array, auto value) {
    std::fill(array.mutable_data(), array.mutable_data() + array.size(), value);
  };
  fill(share, std::numeric_limits<double>::quiet_NaN());
  fill(resolution_m, std::numeric_limits<double>::quiet_NaN());
  fill(is_resolved, false);
  fill(works, false);
  const auto loads = static_cast<std::size_t>(of.loads),
             readings = static_cast<std::size_t>(of.readings);
  for (std::size_t i = 0; i < of.reader.place_of().size(); ++i) {
    const std::size_t place = of.reader.place_of()[i];
    for (std::size_t l = 0; l < loads; ++l) {
      share.mutable_data()[place * loads + l] = of.reader.own_share()[i * loads + l];
      resolution_m.mutable_data()[place * loads + l] = of.reader.resolution_m()[i * loads + l];
      is_resolved.mutable_data()[place * loads + l] =
          of.reader.is_resolved(i, static_cast<Eigen::Index>(l));
    }
    for (std::size_t r = 0; r < readings; ++r) {
      works.mutable_data()[place * readings + r] =
          of.reader.array().does_work(i, static_cast<Eigen::Index>(r));
    }
  }
  out["own_share"] = share;
  out["resolution_m"] = resolution_m;
  out["is_resolved"] = is_resolved;
  out["works"] = works;
  return out;
}

}  // namespace

void add_inverse(py::module_& module) {
  py::class_<VoltageReader>(module, "VoltageReader")
      .def(py::init(&voltage_reader))
      .def("read", &read_frames)
      .def("facts", &facts_of);
}

}  // namespace viscard::python
