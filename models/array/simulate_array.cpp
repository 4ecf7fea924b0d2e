#include "models/array/array_modes.h"
#include "models/array/array_scene.h"
#include "models/pillar/effects.h"
#include "models/pillar/error_control.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace viscard {
namespace {

constexpr double kPercentScale = 10.0;  // at a tolerance of 1e-3 per cents are known to .01 points

ArrayMedia media_of(const ArrayScene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3), scene.film,
          scene.plane};
}

// A lone pillar on a film so wide that no end of it is felt.
ArrayGeometry lone(ArrayGeometry geometry) {
  geometry.count = 1;
  geometry.ends = FilmEnds::kMirror;
  geometry.spacing_m = 15.0 * std::max(geometry.diameter_m, 1.6 * geometry.film_thickness_m);
  return geometry;
}

// Static results on one mesh.
class Statics {
 public:
  Statics(const ArrayScene& scene, const Discretisation& mesh) : scene_(scene) {
    answer_.discretisation = mesh;
    const ArrayModel model(scene.geometry, scene.electrodes, media_of(scene), mesh);
    answer_.unknowns = model.unknowns();
    response_ = array_response(model, scene.load);
    load_Pa_ =
        Eigen::VectorXd::Constant(scene.geometry.count, scene.loaded.empty() ? scene.load_Pa : 0.0);
    for (const int pillar : scene.loaded) load_Pa_[pillar - 1] = scene.load_Pa;
    // What stands for the voltage of a pillar where a single number is compared.
    const bool has_electrodes = response_.electrode_V.size() > 0;
    single_ = has_electrodes ? response_.electrode_V : response_.centre_V;
    mean_ = has_electrodes ? response_.electrode_V : response_.mean_V;
  }

  SceneAnswer run() {
    add_all("centre_voltage", response_.centre_V * load_Pa_, "V");
    add_all("mean_voltage", response_.mean_V * load_Pa_, "V");
    add_all("electrode_voltage", response_.electrode_V * load_Pa_, "V");
    add_all("midway_voltage", response_.midway_V * load_Pa_, "V");
    if (response_.V_per_C.size() > 0) {  // V = V_open + V_per_C Q = 0
      add_all("electrode_charge", -response_.V_per_C.lu().solve(response_.electrode_V * load_Pa_),
              "C");
    }
    add_all("top_displacement", response_.top_m * load_Pa_, "m");
    if (single_.size() > 0 && load_Pa_.any()) per_cents();
    return std::move(answer_);
  }

 private:
  bool is_wanted(const std::string& name, int pillar, bool by_default = true) const {
    if (scene_.wanted.empty()) return by_default;
    return std::any_of(scene_.wanted.begin(), scene_.wanted.end(), [&](const std::string& w) {
      return w == name || w == name + "_" + std::to_string(pillar);
    });
  }
  void add(const std::string& name, int pillar, double value, const char* unit, double scale) {
    answer_.results.push_back(
        {name + "_" + std::to_string(pillar), value, unit, 0.0, scale, is_wanted(name, pillar)});
  }
  void add_all(const std::string& name, const Eigen::VectorXd& values, const char* unit) {
    const double scale = values.size() == 0 ? 0.0 : values.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      add(name, static_cast<int>(i) + 1, values[i], unit, scale);
    }
  }
  bool is_loaded(Eigen::Index pillar) const { return load_Pa_[pillar] != 0.0; }

  void per_cents() {
    const Eigen::Index n = load_Pa_.size();
    const Eigen::VectorXd V = single_ * load_Pa_;
    const Eigen::VectorXd mean_V = mean_ * load_Pa_;
    const Eigen::VectorXd midway_V = response_.midway_V * load_Pa_;
    const auto largest = [&](const Eigen::VectorXd& of) { return of[index_of_largest(of)]; };
    for (Eigen::Index i = 0; i < n; ++i) {
      const int number = static_cast<int>(i) + 1;
      if (i < midway_V.size() && is_loaded(i) && is_loaded(std::min(i + 1, n - 1))) {
        const double between_V = 0.5 * (V[i] + V[std::min(i + 1, n - 1)]);
        add("coupling_percent", number, 50.0 * midway_V[i] / between_V, "%", kPercentScale);
      }
      if (!is_loaded(i)) {
        add("crosstalk_percent", number, 100.0 * mean_V[i] / largest(mean_V), "%", kPercentScale);
        if (response_.centre_V.size() > 0) {
          add("crosstalk_centre_percent", number, 100.0 * V[i] / largest(V), "%", kPercentScale);
        }
        continue;
      }
      const double own_V = single_(i, i) * load_Pa_[i];
      add("neighbours_percent", number, 100.0 * (V[i] / own_V - 1.0), "%", kPercentScale);
      if (!is_wanted("deviation_percent", number, false)) continue;
      add("deviation_percent", number, 100.0 * (V[i] / (lone_V() * load_Pa_[i]) - 1.0), "%",
          kPercentScale);
    }
  }
  static Eigen::Index index_of_largest(const Eigen::VectorXd& values) {
    Eigen::Index at = 0;
    values.cwiseAbs().maxCoeff(&at);
    return at;
  }
  double lone_V() {
    if (lone_V_ == 0.0) {
      const ArrayModel model(lone(scene_.geometry), scene_.electrodes, media_of(scene_),
                             answer_.discretisation);
      const ArrayResponse alone = array_response(model, scene_.load);
      lone_V_ = (alone.electrode_V.size() > 0 ? alone.electrode_V : alone.centre_V)(0, 0);
    }
    return lone_V_;
  }

  const ArrayScene& scene_;
  SceneAnswer answer_;
  ArrayResponse response_;
  Eigen::VectorXd load_Pa_;
  Eigen::MatrixXd single_, mean_;
  double lone_V_ = 0.0;
};

SceneAnswer modes_on(const ArrayScene& scene, const Discretisation& mesh) {
  const ArrayMedia media = media_of(scene);
  const ArrayModel model(scene.geometry, scene.electrodes, media, mesh,
                         inertia_ports_for(scene.modes));
  SceneAnswer answer;
  answer.discretisation = mesh;
  answer.unknowns = model.unknowns();
  const std::vector<ArrayMode> modes = array_modes(model, scene.modes);
  answer.step_error = film_inertia_error(model, media, modes);
  for (const bool is_lateral : {true, false}) {
    for (const ArrayMode& mode : modes) {
      if (mode.is_lateral != is_lateral) continue;
      answer.modes.push_back({is_lateral ? "lateral" : "longitudinal", 0, mode.frequency_Hz, 0.0});
    }
  }
  return answer;
}

std::vector<SceneEffect> effects_of(const ArrayScene& scene) {
  const bool is_electric = scene.film.permittivity_F_m(2, 2) > 0.0;
  const bool is_modal = scene.analysis == ArrayAnalysis::kModal;
  return {
      {"inertia", is_modal, is_modal ? "modal analysis, of the pillars alone" : "static analysis"},
      {"incompressibility", scene.pillar.nu >= kNearlyIncompressible,
       "pressures are condensed from a Poisson ratio of 0.45 on, in plane strain"},
      {"film_compliance", true, "the pillars share one film"},
      {"piezo_coupling", is_electric, is_electric ? "both ways" : "the film has no permittivity"},
      {"crosstalk", true, "all pillars, through film and field"},
      {"three_dimensional", false, "rows of pillars are solved in the plane"}};
}

// The field is singular as r^(1/2) at an electrode's edge, which takes more layers than the weaker
// corners of the pillars do.
// The shaft matters to modes only.
std::vector<Discretisation> meshes(const ArrayScene& scene) {
  std::vector<Discretisation> all;
  for (const auto& [degree, layers] :
       {std::pair{3, 2}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 4}, {9, 5}}) {
    all.push_back({.degree = degree,
                   .layers = scene.electrodes.is_equipotential ? degree : layers,
                   .shaft_elements = scene.analysis == ArrayAnalysis::kModal ? 2 : 1});
  }
  return all;
}

}  // namespace

SceneAnswer simulate_array(const ArrayScene& scene) {
  validate(scene);
  const ErrorControl control{scene.tolerance, meshes(scene), scene.progress};
  SceneAnswer answer = answer_within(control, [&](const Discretisation& mesh) {
    return scene.analysis == ArrayAnalysis::kModal ? modes_on(scene, mesh)
                                                   : Statics(scene, mesh).run();
  });
  answer.effects = effects_of(scene);
  return answer;
}

void simulate_arrays(const std::vector<ArrayScene>& points,
                     const std::function<void(std::size_t, const SceneAnswer&)>& done) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < points.size(); i = next++) {
      try {
        const SceneAnswer answer = simulate_array(points[i]);
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) done(i, answer);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = points.size();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t k = 1; k < std::min(cores, points.size()); ++k) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace viscard
