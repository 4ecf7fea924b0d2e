#include "fit/large_strain/rubber_band.h"
#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/flow/large_strain/large_strain_words.h"
#include "io/options/option.h"
#include "io/python/job.h"
#include "io/python/keywords.h"
#include "io/python/parts.h"
#include "io/python/values.h"
#include "models/hyperelastic/finite_viscoelasticity.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <sstream>

namespace viscard::python {
namespace {

namespace py = pybind11;

std::vector<LargeStrainFile> large_strain_given(const std::vector<std::string>& words) {
  try {
    return large_strain_from_words(words);
  } catch (const std::invalid_argument& error) {
    throw OptionError(error.what());
  }
}

py::dict fit_rubber(const std::vector<std::string>& files, const py::dict& tables,
                    const py::dict& keywords) {
  LargeStrainRequest request =
      large_strain_request(large_strain_words_from(keywords), large_strain_given(files));
  for (LargeStrainFile& file : request.files) {
    if (!tables.contains(file.path)) continue;
    const py::dict arrays = tables[py::str(file.path)];
    file.in_memory = std::make_shared<const CsvTable>(table_from_arrays(arrays, file.path));
  }
  FittedLargeStrain fitted =
      in_background({}, [=](Job&) { return fit_large_strain_files(request); });
  std::ostringstream text;
  print_large_strain(fitted, text);
  py::dict out;
  out["text"] = text.str();
  out["json_text"] = file_of_large_strain(fitted);
  py::list tests, times, stresses;
  for (LargeStrainTest& test : fitted.tests) {
    times.append(array_of(std::vector<double>(test.time_s)));
    stresses.append(array_of(stresses_Pa(fitted.result.best(), test)));
    tests.append(py::make_tuple(array_of(std::move(test.stretch)),
                                array_of(std::move(test.nominal_stress_Pa))));
  }
  out["tests"] = tests;
  out["times"] = times;
  out["stresses"] = stresses;
  return out;
}

Deformation deformation_from(const std::string& name) {
  const auto& names = deformation_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<Deformation>(found - names.begin());
  throw OptionError("deformation is '" + name + "'; use " + names[0] + ", " + names[1] + " or " +
                    names[2]);
}

py::array rubber_stress(const HyperelasticFile& rubber, const std::string& deformation,
                        std::vector<double> stretch,
                        const std::optional<std::vector<double>>& time_s) {
  if (rubber.foam) {
    const auto& names = foam_test_names();
    const auto found = std::find(names.begin(), names.end(), deformation);
    if (found == names.end())
      throw OptionError("deformation of a foam is '" + deformation + "'; use " + listed(names));
    const auto test = static_cast<FoamTest>(found - names.begin());
    for (double& value : stretch) value = foam_state(*rubber.foam, test, value).nominal_stress_Pa;
    return array_of(std::move(stretch));
  }
  const Deformation kind = deformation_from(deformation);
  if (rubber.damage) {
    return array_of(nominal_stress_Pa(rubber.law, *rubber.damage, kind, stretch));
  }
  if (time_s) {
    const Course history = course_from_columns(*time_s, stretch);
    return array_of(nominal_stress_Pa(rubber.law, rubber.terms, kind, history));
  }
  for (double& value : stretch) value = nominal_stress_Pa(rubber.law, kind, value);
  return array_of(std::move(stretch));
}

std::string rubber_card_text(const HyperelasticFile& rubber, const std::string& name,
                             const std::string& target, const std::string& units,
                             std::optional<double> bulk_Pa, std::optional<double> density_kg_m3,
                             bool accepts_flags, bool may_approximate,
                             const std::string& elastic_only, const std::string& plausible) {
  const Plausible judged = judged_by(plausible);
  if (bulk_Pa) refuse_keyword("bulk_modulus_Pa", *bulk_Pa, quantities::kBulkModulus, judged);
  if (density_kg_m3) {
    refuse_keyword("density_kg_m3", *density_kg_m3, quantities::kDensity, judged);
  }
  if (!elastic_only.empty() && elastic_only != "instantaneous" && elastic_only != "long-term")
    throw OptionError("--elastic-only is '" + elastic_only + "'; use instantaneous or long-term");
  RubberCardOptions options;
  options.target = target;
  options.units = units;
  options.bulk_Pa = bulk_Pa;
  options.density_kg_m3 = density_kg_m3;
  options.accepts_flags = accepts_flags;
  options.may_approximate = may_approximate;
  options.elastic_only = elastic_only;
  options.plausible = judged;
  return rubber_file_card(rubber, name, options);
}

}  // namespace

void add_rubber(py::module_& module) {
  const py::class_<HyperelasticFile> opaque(module, "Rubber");
  module.def("is_large_strain", [](const std::vector<std::string>& words) {
    return !large_strain_given(words).empty();
  });
  module.def("fit_rubber", &fit_rubber);
  module.def("rubber_from_json", [](const std::string& text, const std::string& name) {
    return hyperelastic_from_json(text, name);
  });
  // The text of a file that is a law.
  module.def("text_of_rubber", [](const std::string& path) {
    std::string text = read_file(path);
    hyperelastic_from_json(text, path);
    return text;
  });
  module.def("rubber_stress", &rubber_stress);
  module.def("rubber_card", &rubber_card_text);
  module.def("rubber_card_targets", &rubber_card_targets);
}

}  // namespace viscard::python
