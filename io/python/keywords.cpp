#include "io/python/keywords.h"

#include <pybind11/stl.h>

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
  } catch (const py::cast_error&) {
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
  if (py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value)) {
    target = {value.cast<double>()};
    return;
  }
  take(keywords, name, "a number or a list of numbers", target);
}

}  // namespace

OptionalText text_from(const char* name, const py::handle& value) {
  if (value.is_none()) return std::nullopt;
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__fspath__")) {
    return value.attr("__fspath__")().cast<std::string>();
  }
  if (!py::isinstance<py::bool_>(value) && py::hasattr(value, "__float__")) {
    return py::str(py::repr(py::float_(value.cast<double>()))).cast<std::string>();
  }
  refuse_type(name, "a text or a number", value);
}

FitWords fit_words_from(const py::dict& keywords) {
  FitWords words;
  const std::pair<const char*, OptionalText*> texts[] = {
      {"kind", &words.kind},
      {"noise", &words.noise},
      {"model", &words.model},
      {"constraints", &words.constraints},
      {"vertical_shift", &words.vertical_shift},
      {"sheet", &words.sheet},
      {"time_zero", &words.time_zero},
      {"from_", &words.from},
      {"to", &words.to},
      {"crop", &words.crop},
      {"depth", &words.depth},
      {"specimen", &words.specimen},
      {"punch_diameter", &words.punch_diameter},
      {"layer_thickness", &words.layer_thickness},
      {"frame_stiffness", &words.frame_stiffness},
      {"reference_temperature", &words.reference_temperature},
      {"density", &words.density}};
  for (const auto& [name, text] : texts) {
    if (keywords.contains(name)) *text = text_from(name, keywords[name]);
  }
  const std::pair<const char*, bool*> flags[] = {{"liquid", &words.liquid},
                                                 {"solid", &words.solid},
                                                 {"allow_negative", &words.allow_negative},
                                                 {"full_data", &words.full_data},
                                                 {"profiles", &words.profiles},
                                                 {"diagnose", &words.diagnose},
                                                 {"joint", &words.joint},
                                                 {"own_terms", &words.own_terms},
                                                 {"drift", &words.drift},
                                                 {"no_drift", &words.no_drift}};
  for (const auto& [name, flag] : flags) take(keywords, name, "True or False", *flag);
  const std::pair<const char*, Texts*> lists[] = {
      {"fix", &words.fix},         {"bound", &words.bound}, {"column", &words.column},
      {"segment", &words.segment}, {"share", &words.share}, {"specimen_id", &words.specimen_id}};
  for (const auto& [name, list] : lists) take_texts(keywords, name, *list);
  const std::pair<const char*, std::optional<int>*> numbers[] = {{"terms", &words.terms},
                                                                 {"max_terms", &words.max_terms},
                                                                 {"bootstrap", &words.bootstrap},
                                                                 {"hold", &words.hold}};
  for (const auto& [name, number] : numbers) take(keywords, name, "a whole number", *number);
  take(keywords, "poisson_ratio", "a number", words.poisson_ratio);
  take_numbers(keywords, "ratio", words.ratio);
  return words;
}

LargeStrainWords large_strain_words_from(const py::dict& keywords) {
  LargeStrainWords words;
  const std::pair<const char*, OptionalText*> texts[] = {{"model", &words.model},
                                                         {"weight", &words.weight},
                                                         {"youngs_modulus", &words.youngs_modulus},
                                                         {"cycle", &words.cycle},
                                                         {"sheet", &words.sheet}};
  for (const auto& [name, text] : texts) {
    if (keywords.contains(name)) *text = text_from(name, keywords[name]);
  }
  take_texts(keywords, "column", words.column);
  return words;
}

PredictWords predict_words_from(const py::dict& keywords) {
  PredictWords words;
  const std::pair<const char*, OptionalText*> texts[] = {{"test", &words.test},
                                                         {"strain", &words.strain},
                                                         {"stress", &words.stress},
                                                         {"ramp", &words.ramp},
                                                         {"hold", &words.hold},
                                                         {"recovery", &words.recovery},
                                                         {"period", &words.period},
                                                         {"from_", &words.from},
                                                         {"to", &words.to},
                                                         {"history", &words.history},
                                                         {"driven_by", &words.driven_by},
                                                         {"against", &words.against},
                                                         {"time_zero", &words.time_zero},
                                                         {"temperature", &words.temperature}};
  for (const auto& [name, text] : texts) {
    if (keywords.contains(name)) *text = text_from(name, keywords[name]);
  }
  take(keywords, "cycles", "a whole number", words.cycles);
  take(keywords, "points", "a whole number", words.points);
  take_texts(keywords, "column", words.column);
  return words;
}

}  // namespace viscard::python
