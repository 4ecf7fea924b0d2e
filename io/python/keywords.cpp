#include "io/python/keywords.h"

#include "io/basics/option_quantity.h"
#include "io/flow/words/option_error.h"
#include "io/flow/words/option_fields.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
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

// The value of a keyword; None and a keyword that is not given leave `target` as it is.
template <typename Target>
void take(const py::dict& keywords, const char* name, const char* expected, Target& target) {
  if (!keywords.contains(name) || keywords[name].is_none()) return;
  const py::object value = keywords[name];
  try {
    target = value.cast<Target>();
  } catch (const py::cast_error&) {  // a whole number that is too large
    refuse_type(name, expected, value);
  }
}

// One text, or a list of them.
void take_texts(const py::dict& keywords, const char* name, Texts& target) {
  if (!keywords.contains(name) || keywords[name].is_none()) return;
  const py::object value = keywords[name];
  if (py::isinstance<py::str>(value)) {
    target = {value.cast<std::string>()};
    return;
  }
  take(keywords, name, "a text or a list of texts", target);
}

void take_numbers(const py::dict& keywords, const char* name, std::vector<double>& target) {
  if (!keywords.contains(name) || keywords[name].is_none()) return;
  const py::object value = keywords[name];
  constexpr const char* kExpected = "a number or a list of numbers";
  if (py::isinstance<py::sequence>(value)) {
    take(keywords, name, kExpected, target);
    return;
  }
  std::optional<double> number;
  take(keywords, name, kExpected, number);
  if (number) target = {*number};
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

namespace {

// "punch-diameter" is punch_diameter in Python; "from" is a word of the language.
std::string keyword_of(const char* option) {
  std::string name = option;
  std::replace(name.begin(), name.end(), '-', '_');
  return name == "from" ? "from_" : name;
}

void take_options(const py::dict& keywords, const OptionFields& fields) {
  for (const auto& [option, text] : fields.texts) {
    const std::string name = keyword_of(option);
    if (keywords.contains(name)) *text = text_from(name.c_str(), keywords[name.c_str()]);
  }
  for (const auto& [option, flag] : fields.flags) {
    take(keywords, keyword_of(option).c_str(), "True or False", *flag);
  }
  for (const auto& [option, list] : fields.lists) {
    take_texts(keywords, keyword_of(option).c_str(), *list);
  }
  for (const auto& [option, number] : fields.whole_numbers) {
    take(keywords, keyword_of(option).c_str(), "a whole number", *number);
  }
}

}  // namespace

FitWords fit_words_from(const py::dict& keywords) {
  FitWords words;
  take_options(keywords, option_fields(words));
  take(keywords, "poisson_ratio", "a number", words.poisson_ratio);
  take_numbers(keywords, "ratio", words.ratio);
  return words;
}

LargeStrainWords large_strain_words_from(const py::dict& keywords) {
  LargeStrainWords words;
  const std::pair<const char*, OptionalText*> texts[] = {
      {"model", &words.model}, {"weight", &words.weight}, {"youngs_modulus", &words.youngs_modulus},
      {"cycle", &words.cycle}, {"sheet", &words.sheet},   {"plausible", &words.plausible}};
  for (const auto& [name, text] : texts) {
    if (keywords.contains(name)) *text = text_from(name, keywords[name]);
  }
  take_texts(keywords, "column", words.column);
  take(keywords, "terms", "a whole number", words.terms);
  take(keywords, "max_terms", "a whole number", words.max_terms);
  return words;
}

PredictWords predict_words_from(const py::dict& keywords) {
  PredictWords words;
  take_options(keywords, option_fields(words));
  return words;
}

}  // namespace viscard::python
