#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/cards/card.h"
#include "io/cards/targets/card_targets.h"
#include "io/flow/card_material.h"
#include "io/flow/predict_file.h"
#include "io/flow/validation_keys.h"
#include "io/materials/material_file.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "models/material/retardation_spectrum.h"
#include "models/material/series_band.h"
#include "models/pillar/validate_material.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>
#include <numbers>
#include <stdexcept>

namespace viscard::python {
namespace {

namespace py = pybind11;
using Values = std::vector<double>;

Values storage_or_loss(const PronySeries& series, const Values& frequency_Hz,
                       double ComplexModulus::*part) {
  Values values;
  for (const double f : frequency_Hz) {
    values.push_back(complex_modulus_Pa(series, 2.0 * std::numbers::pi * f).*part);
  }
  return values;
}

// A curve of E(t) at times or frequencies.
Values curve_of(const std::string& name, const PronySeries& series, const Values& at) {
  if (name == "storage") return storage_or_loss(series, at, &ComplexModulus::storage_Pa);
  if (name == "loss") return storage_or_loss(series, at, &ComplexModulus::loss_Pa);
  Values values;
  if (name == "creep") {
    const RetardationSpectrum spectrum = retardation_from_relaxation(series);
    for (const double t : at) values.push_back(creep_compliance_1_Pa(spectrum, t));
  } else {
    for (const double t : at) values.push_back(relaxation_modulus_Pa(series, t));
  }
  return values;
}

py::tuple curve(const Material& material, const std::string& name, const Values& at,
                bool with_band) {
  BandedCurve found;
  {
    const py::gil_scoped_release others_may_run;
    const CurveOfSeries of_series = [&](const PronySeries& series) {
      return curve_of(name, series, at);
    };
    if (with_band && has_band(material)) {
      found = banded_curve(material, of_series);
    } else {
      found.value = of_series(young_series(material));
    }
  }
  return py::make_tuple(array_of(std::move(found.value)), array_of(std::move(found.low_95)),
                        array_of(std::move(found.high_95)));
}

py::dict moduli(const Material& material) {
  const DerivedModuli found = derived_moduli(material);
  py::dict out;
  out["E0_Pa"] = found.E0_Pa;
  out["E_inf_Pa"] = found.E_inf_Pa;
  out["G0_Pa"] = found.G0_Pa;
  out["G_inf_Pa"] = found.G_inf_Pa;
  out["K0_Pa"] = found.K0_Pa;
  out["K_inf_Pa"] = found.K_inf_Pa;
  out["nu_inf"] = found.nu_inf;
  out["sum_g"] = found.sum_g;
  out["G_Pa"] = array_of(found.G_Pa);
  out["E_Pa"] = array_of(found.E_Pa);
  return out;
}

Material changed(const Material& material, double temperature_C) {
  refuse_keyword("temperature_C", temperature_C, quantities::kTemperature, Plausible::kMeasured);
  return material_at_temperature(material, temperature_C);
}

std::optional<double> number_of(const py::dict& keywords, const char* name) {
  return keywords[name].is_none() ? std::nullopt : std::optional(keywords[name].cast<double>());
}

py::dict card(const Material& material, const std::string& target, const std::string& units,
              const py::dict& keywords) {
  const auto word = [&](const char* name) { return keywords[name].cast<std::string>(); };
  const Plausible judged = judged_by(word("plausible"));
  if (const auto temperature_C = number_of(keywords, "temperature_C")) {
    refuse_keyword("temperature_C", *temperature_C, quantities::kTemperature, judged);
  }
  const CardMaterialRequest request{
      .material = material.name.empty() ? "the material" : material.name,
      .target = target,
      .bound = word("bound"),
      .elastic_only = word("elastic_only"),
      .terms =
          keywords["terms"].is_none() ? std::nullopt : std::optional(keywords["terms"].cast<int>()),
      .temperature_C = number_of(keywords, "temperature_C"),
      .plausible = judged,
      .may_approximate = keywords["approximate"].cast<bool>()};
  CardOptions options{.units = units,
                      .is_reproducible = keywords["reproducible"].cast<bool>(),
                      .may_approximate = request.may_approximate,
                      .accepts_flags = keywords["accept_flags"].cast<bool>(),
                      .clamped_nu = number_of(keywords, "clamp_nu"),
                      .created_at = now_iso8601(),
                      .command = "viscard.Material.card()"};
  if (request.terms && !request.may_approximate) {
    throw OptionError("--terms changes the material; pass --approximate too");
  }
  if (const auto nu = options.clamped_nu; nu && !(*nu > -1.0 && *nu < 0.5)) {
    throw OptionError(fmt::format("--clamp-nu is {:g}; it must lie in (-1, 0.5)", *nu));
  }
  const Card written = in_background({}, [=](Job&) mutable {
    const PreparedMaterial prepared = prepare_card_material(material, request);
    state_changes(prepared, options);
    return write_card(prepared.material, card_target(target), options);
  });
  py::dict out;
  out["text"] = written.text;
  out["n_terms"] = written.written.terms.size();
  out["largest_difference"] = written.largest_difference;
  py::list companions, fidelity;
  for (const CompanionFile& one : written.companions) {
    companions.append(py::make_tuple(one.suffix, one.text));
  }
  for (const FidelityItem& one : written.fidelity) {
    fidelity.append(py::make_tuple(one.item, to_word(one.mapping), one.text));
  }
  out["companions"] = companions;
  out["fidelity"] = fidelity;
  return out;
}

// tables: arrays by the name that a keyword, history or against, gives in the place of a file.
PythonResult predict(const Material& material, const py::dict& keywords, const py::dict& tables,
                     const std::vector<std::string>& inputs) {
  PredictFileRequest request = predict_request(
      predict_words_from(keywords), material.name.empty() ? "the material" : material.name);
  const auto in_memory = [&](const std::string& name) -> std::shared_ptr<const CsvTable> {
    if (name.empty() || !tables.contains(name)) return nullptr;
    return std::make_shared<const CsvTable>(table_from_arrays(tables[py::str(name)], name));
  };
  request.history_in_memory = in_memory(request.history);
  request.against_in_memory = in_memory(request.against);
  const auto found = in_background({}, [=](Job&) {
    return std::make_shared<const PredictedFile>(predict_material(material, request));
  });
  return {"viscard-predict/1", inputs, [found](ResultVisitor& v) { show_keys(v, *found); }, {}};
}

PythonResult validate(const Material& material, double max_error, const py::object& progress) {
  if (!(max_error > 0.0 && max_error < 1.0)) {
    throw OptionError(fmt::format("max_error is {:g}; it must lie between 0 and 1", max_error));
  }
  const auto found = in_background({.progress = progress}, [=](Job& job) {
    ValidateOptions options;
    options.tolerance = max_error;
    options.progress = [&](double done) { job.report(done, "validate"); };
    return std::make_shared<const ValidationResult>(validate_material(material, options));
  });
  const std::string name = material.name.empty() ? "the material" : material.name;
  return {"viscard-validate/1", {}, [=](ResultVisitor& v) { show_keys(v, *found, name); }, {}};
}

// From text that Python has composed, or from a file.
Material material_from_text(const std::string& text, const std::string& name,
                            const std::string& plausible) {
  return material_from_json(text, name, judged_by(plausible)).material;
}

}  // namespace

void add_materials(py::module_& module) {
  module.def("material_from_json", &material_from_text);
  module.def("read_material", [](const std::string& path, const std::string& plausible) {
    return read_material(path, judged_by(plausible)).material;
  });
  module.def("json_from_material",
             [](const Material& material) { return json_from_material(material); });
  module.def("write_file", [](const std::string& path, const std::string& text, bool overwrite) {
    write_file(path, text, overwrite);
  });
  module.def("moduli", &moduli);
  module.def("curve", &curve);
  module.def("material_at_temperature", &changed);
  module.def("card", &card);
  module.def("card_targets", [] {
    std::vector<std::string> names;
    for (const CardTarget& target : card_targets()) names.push_back(target.name);
    return names;
  });
  module.def("predict", &predict);
  module.def("validate", &validate);
}

}  // namespace viscard::python
