#include "io/python/uncertainty_values.h"

#include <pybind11/stl.h>

namespace viscard::python {

namespace py = pybind11;

py::object uncertainty_object(const std::optional<SceneUncertainty>& found) {
  if (!found) return py::none();
  py::dict out, inputs, results, derivatives;
  for (std::size_t i = 0; i < found->inputs.size(); ++i) {
    inputs[py::str(found->inputs[i].name)] = found->descriptions[i];
    derivatives[py::str(found->inputs[i].name)] = found->by_solver[i] ? "solver" : "differences";
  }
  for (const ResultUncertainty& result : found->results) {
    py::dict one, shares, errors;
    for (std::size_t i = 0; i < result.causes.size(); ++i) {
      shares[py::str(found->inputs[i].name)] = result.causes[i].share;
      errors[py::str(found->inputs[i].name)] = result.causes[i].standard_error;
    }
    one["value"] = result.value;
    one["unit"] = result.unit;
    if (result.no_interval.empty()) {
      one["interval_95"] = py::make_tuple(result.interval_95.low, result.interval_95.high);
    } else {
      one["interval_95"] = py::none();
      one["no_interval"] = result.no_interval;
    }
    one["standard_uncertainty"] = result.standard_uncertainty;
    one["numerical_error"] = result.numerical_error;
    one["shares"] = shares;
    one["share_errors"] = errors;
    results[py::str(result.name)] = one;
  }
  out["method"] = found->is_sampled ? "sobol" : "linear";
  out["reason"] = found->reason;
  out["inputs"] = inputs;
  out["results"] = results;
  out["derivatives"] = derivatives;
  out["answers"] = found->n_answers;
  out["first_order_answers"] = found->n_first_order;
  out["failed"] = found->n_failed;
  out["failed_share"] = found->failed_share;
  out["notes"] = found->notes;
  return out;
}

}  // namespace viscard::python
