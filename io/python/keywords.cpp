#include "io/python/keywords.h"

#include "io/basics/option_quantity.h"
#include "io/options/option.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

namespace viscard::python {
namespace {

namespace py = pybind11;

using OptionalText = std::optional<std::string>;
using Texts = std::vector<std::string>;

[[noreturn]] void refuse_type(const char* name, const char* expected, const py::handle& value) {
  throw py::type_error(std::string(name) + " must be " + expected + ", not " +
                       std::string(py::str(py::repr(value))));
}

}  // namespace

OptionalText text_from(const char* name, const py::handle& value) {
  if (value.is_none()) return std::nullopt;
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__fspath__")) {
    return value.attr("__fspath__")().cast<std::string>();
  }
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (whole) return py::str(whole).cast<std::string>();  // 3 stays "3"
  PyErr_Clear();
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return py::str(py::repr(py::float_(number)));
  PyErr_Clear();
  refuse_type(name, "a text or a number", value);
}

Plausible judged_by(const std::string& plausible, Plausible otherwise) {
  try {
    return plausible_from_word(plausible, otherwise);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

void refuse_keyword(const char* name, double value, const Quantity& quantity, Plausible judged) {
  try {
    refuse_implausible_option(name, value, quantity, judged);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

std::optional<double> quantity_from(const char* name, const py::handle& value,
                                    const QuantityOrUnit& quantity, Plausible judged) {
  try {
    return option_quantity(name, text_from(name, value), quantity, judged);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

std::string keyword_of(const Option& option) {
  std::string name = option.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name == "from" ? "from_" : name;  // "from" is a word of the language
}

namespace {

// The words that a value stands for; a list has one for each element.
Texts words_of(const Option& option, const py::handle& value) {
  const std::string name = keyword_of(option);
  const bool is_several = is_list(option) && !py::isinstance<py::str>(value) &&
                          (py::isinstance<py::sequence>(value) || py::hasattr(value, "tolist"));
  Texts words;
  if (!is_several) {
    words.push_back(*text_from(name.c_str(), value));
  } else {
    for (const py::handle one : value) words.push_back(*text_from(name.c_str(), one));
  }
  return words;
}

}  // namespace

void take_keywords(const py::dict& keywords, const OptionList& options) {
  for (const Option& option : options.all()) {
    const std::string name = keyword_of(option);
    if (!option.is_keyword || !keywords.contains(name)) continue;
    const py::object value = keywords[name.c_str()];
    if (value.is_none()) continue;
    if (is_switch(option)) {
      **std::get_if<bool*>(&option.target) = py::cast<bool>(value);
    } else if (const Texts words = words_of(option, value); !words.empty()) {
      set_option(option, words);
    }
  }
}

FitWords fit_words_from(const py::dict& keywords) {
  FitWords words;
  take_keywords(keywords, options_of(words));
  return words;
}

LargeStrainWords large_strain_words_from(const py::dict& keywords) {
  LargeStrainWords words;
  OptionList options;
  add_large_strain_options(options, words);
  take_keywords(keywords, options);
  return with_shared_options(words, fit_words_from(keywords));
}

PredictWords predict_words_from(const py::dict& keywords) {
  PredictWords words;
  take_keywords(keywords, options_of(words));
  return words;
}

}  // namespace viscard::python
