#pragma once

// Derivatives of a scene's results by all its quantities: from first-order answers (models/pillar/README.md,
// eq. 26) against differences of whole answers on one mesh.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/pillar_model.h"
#include "models/uncertainty/linear_propagation.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard::test {

inline const Discretisation kMesh{.degree = 5, .layers = 2};

// A film of given constants: E, nu, d31, d33, relative permittivity.
struct FilmConstants {
  double E_Pa = 2e9, nu = 0.29, d31 = 23e-12, d33 = -33e-12, permittivity = 12.0;
};

inline void set_film(const FilmConstants& c, PillarScene& scene) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << c.d31, c.d31, c.d33, 0, 0, 0;
  scene.film_charge_C_N = d;
  scene.film =
      piezo_medium(isotropic_moduli_Pa(c.E_Pa, c.nu), d,
                   c.permittivity * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

// The sensor of data/scenes/pillar_sensor.toml with an electrode of 18 um, whose edge is not the rim.
inline PillarScene sensor() {
  PillarScene scene;
  scene.tolerance = 1e-3;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  set_film({}, scene);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 18e-6};
  as<StaticDrive>(scene).pressure_Pa = 1e4;
  return scene;
}

inline PillarScene without_film() {
  PillarScene scene = sensor();
  scene.geometry.film.reset();
  scene.film.reset();
  scene.film_charge_C_N.setZero();
  scene.electrodes.reset();
  return scene;
}

// A scene whose parameters move: its film is made of the constants at the end.
struct Moved {
  PillarScene scene;
  FilmConstants film;
};

// A parameter and its standard deviation, relative to its value.
struct Parameter {
  std::string name;
  double deviation;
  std::function<double&(Moved&)> value;
  bool is_length = false;
};

// The load of a scene; of a history its last point.
inline double& load_of(PillarScene& scene) {
  if (auto* creep = std::get_if<CreepDrive>(&scene.drive)) return creep->history.back().value;
  if (auto* held = std::get_if<RelaxationDrive>(&scene.drive)) return held->history.back().value;
  if (auto* modal = std::get_if<ModalDrive>(&scene.drive)) return modal->pressure_Pa;
  if (auto* harmonic = std::get_if<HarmonicDrive>(&scene.drive)) return harmonic->pressure_Pa;
  return std::get<StaticDrive>(scene.drive).pressure_Pa;
}

inline std::vector<Parameter> parameters_of_terms(const PillarScene& scene) {
  std::vector<Parameter> all;
  for (std::size_t i = 0; i < scene.pillar.terms.size(); ++i) {
    const auto add = [&](const char* name, double MaterialTerm::*member) {
      if (scene.pillar.terms[i].*member == 0.0) return;
      all.push_back({name + std::to_string(i + 1), 0.03,
                     [i, member](Moved& m) -> double& { return m.scene.pillar.terms[i].*member; }});
    };
    add("g", &MaterialTerm::g);
    add("k", &MaterialTerm::k);
    add("tau", &MaterialTerm::tau_s);
  }
  return all;
}

inline std::vector<Parameter> parameters_of(const PillarScene& scene) {
  std::vector<Parameter> all = {
      {"diameter", 0.01, [](Moved& m) -> double& { return m.scene.geometry.diameter_m; }, true},
      {"length", 0.02, [](Moved& m) -> double& { return m.scene.geometry.length_m; }, true},
      {"E", 0.1, [](Moved& m) -> double& { return m.scene.pillar.E0_Pa; }},
      {"rho", 0.1, [](Moved& m) -> double& { return m.scene.pillar.rho_kg_m3; }}};
  if (scene.pillar.nu < 0.5) {
    all.push_back({"nu", 0.005, [](Moved& m) -> double& { return m.scene.pillar.nu; }});
  }
  if (pressure_Pa(scene) != 0.0 || has_history(scene)) {
    all.push_back({"load", 0.1, [](Moved& m) -> double& { return load_of(m.scene); }});
  }
  for (Parameter& one : parameters_of_terms(scene)) all.push_back(std::move(one));
  if (!scene.geometry.film) return all;
  const auto film_length = [&](const char* name, double FilmGeometry::*member) {
    all.push_back({name, 0.02,
                   [member](Moved& m) -> double& { return (*m.scene.geometry.film).*member; },
                   true});
  };
  film_length("film thickness", &FilmGeometry::thickness_m);
  film_length("film radius", &FilmGeometry::radius_m);
  const auto film_constant = [&](const char* name, double FilmConstants::*member) {
    all.push_back({name, 0.04, [member](Moved& m) -> double& { return m.film.*member; }});
  };
  film_constant("film E", &FilmConstants::E_Pa);
  film_constant("film nu", &FilmConstants::nu);
  if (!scene.electrodes) return all;
  film_constant("d31", &FilmConstants::d31);
  film_constant("d33", &FilmConstants::d33);
  film_constant("permittivity", &FilmConstants::permittivity);
  if (scene.electrodes->electrode_radius_m > 0.0) {
    all.push_back({"electrode radius", 0.01,
                   [](Moved& m) -> double& { return m.scene.electrodes->electrode_radius_m; },
                   true});
  }
  return all;
}

inline PillarScene moved(const PillarScene& scene, const std::vector<Parameter>& parameters,
                         const Eigen::VectorXd& deviates) {
  Moved at{scene, {}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].value(at) *=
        1.0 + parameters[i].deviation * deviates[static_cast<Eigen::Index>(i)];
  }
  if (scene.film) set_film(at.film, at.scene);
  return at.scene;
}

inline std::vector<std::string> names_of(const SceneAnswer& answer) {
  std::vector<std::string> names;
  for (const SceneResult& r : answer.results) names.push_back(r.name);
  for (const SceneMode& m : answer.modes) {
    names.push_back(m.family + " frequency");
    if (m.damping_ratio) names.push_back(m.family + " damping");
  }
  return names;
}

inline BatchFunction batch_of(const PillarScene& scene, const std::vector<Parameter>& parameters,
                              std::size_t n_values, const FirstOrderAnswers& answer_of) {
  return [=](const Eigen::MatrixXd& points) {
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Constant(points.rows(), static_cast<Eigen::Index>(n_values),
                                  std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const auto answer = answer_of(moved(scene, parameters, points.row(i)));
      if (!answer) continue;
      Eigen::Index k = 0;
      for (const SceneResult& r : answer->results) values(i, k++) = r.value;
      for (const SceneMode& m : answer->modes) {
        values(i, k++) = m.frequency_Hz;
        if (m.damping_ratio) values(i, k++) = *m.damping_ratio;
      }
    }
    return values;
  };
}

// Every derivative comes from the solver, those by lengths only if `lengths_too`, and agrees to 1e-5 of
// itself, or to the tolerance of both, relative to the standard uncertainty. Returns the number of
// derivatives that were compared.
inline int check_derivatives(const PillarScene& scene, bool lengths_too = true,
                             const Discretisation& mesh = kMesh) {
  constexpr double kSlopes = 1e-6;
  // The iterated pressures of an incompressible pillar leave 1e-8 of a voltage, which differences see.
  const double allowed = scene.pillar.nu == 0.5 ? 1e-5 : kSlopes;
  const std::vector<std::string> names = names_of(pillar_answer_on(scene, mesh));
  const std::vector<Parameter> parameters = parameters_of(scene);
  std::vector<UncertainInput> inputs;
  for (const Parameter& one : parameters) inputs.push_back({one.name});
  const FirstOrderAnswers first_order = first_order_answers(scene, mesh);
  REQUIRE(first_order);
  const BatchFunction own =
      batch_of(scene, parameters, names.size(), [mesh](const PillarScene& one) {
        return std::optional<SceneAnswer>(pillar_answer_on(one, mesh));
      });
  const LinearAnswer expected = linear_answer(own, inputs, kSlopes);
  const LinearAnswer found =
      linear_answer(own, inputs, kSlopes, batch_of(scene, parameters, names.size(), first_order));
  int n_compared = 0;
  for (std::size_t d = 0; d < parameters.size(); ++d) {
    CAPTURE(parameters[d].name);
    CHECK(found.by_solver[d] == (lengths_too || !parameters[d].is_length));
    for (std::size_t r = 0; r < names.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(d);
      const double by_solver = found.slope(row, column);
      const double by_differences = expected.slope(row, column);
      const double uncertainty = expected.slope.row(row).norm();
      if (uncertainty == 0.0) {  // the voltage of a driven electrode
        CHECK(by_solver == 0.0);
        continue;
      }
      CAPTURE(names[r], by_solver / uncertainty, by_differences / uncertainty);
      CHECK(std::abs(by_solver - by_differences) / uncertainty <=
            1e-5 * std::abs(by_differences) / uncertainty + allowed);
      CHECK(found.slope_error(row, column) <= 1e-5 * uncertainty);
      ++n_compared;
    }
  }
  return n_compared;
}

}  // namespace viscard::test
