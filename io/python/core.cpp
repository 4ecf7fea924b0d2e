// The compiled module viscard._core.
#include "io/basics/inputs.h"
#include "io/basics/words.h"
#include "io/basics/written_path.h"
#include "io/flow/command_error.h"
#include "io/flow/test_words.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "models/maths/failure_text.h"

#include <pybind11/stl.h>

#include <memory>
#include <new>
#include <string>

namespace viscard::python {
namespace {

namespace py = pybind11;

void raise(const CommandError& error, const std::string& text) {
  const py::object type = py::module_::import("viscard._error").attr("Error");
  const py::object value = type(py::str(text), py::str(error.code), py::str(error.message),
                                py::str(error.where), py::str(error.hint));
  PyErr_SetObject(type.ptr(), value.ptr());
}

// Exceptions of viscard become viscard.Error; those of Python and pybind11 stay as they are.
void translate(
    std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11's
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const py::error_already_set&) {
    throw;
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const OptionError& error) {
    raise(command_error("usage", shortened(error.what())), shortened(error.what()));
  } catch (const std::exception& error) {
    raise(command_error(error), shortened(failure_text(error, "this call")));
  }
}

}  // namespace

void add_errors(py::module_& module) {
  py::register_local_exception_translator(translate);
  module.def("jobs_left", &jobs_left);
  // What is in doubt of the files that this call reads while it lives; other threads have their own.
  py::class_<InputRecorder>(module, "InputRecorder")
      .def(py::init([] { return std::make_unique<InputRecorder>(InputRecorder::Of::kCall); }))
      .def("notes", [](const InputRecorder& recorder) {
        std::vector<std::string> notes;
        for (const InputFile& file : recorder.files()) {
          if (!file.note.empty()) notes.push_back(written_path(file.path) + ": " + file.note);
        }
        return notes;
      });
  module.def("no_such_word", &no_such_word);
  module.def("test_kinds", [] { return kinds_of_tests(true); });
  module.attr("version") = VISCARD_VERSION;
}

}  // namespace viscard::python

PYBIND11_MODULE(_core, module) {
  viscard::python::add_errors(module);
  viscard::python::add_results(module);
  viscard::python::add_tables(module);
  viscard::python::add_fits(module);
  viscard::python::add_rubber(module);
  viscard::python::add_materials(module);
  viscard::python::add_planning(module);
  viscard::python::add_scenes(module);
  viscard::python::add_inverse(module);
  viscard::python::add_sweeps(module);
  viscard::python::add_designs(module);
  viscard::python::add_rig(module);
}
