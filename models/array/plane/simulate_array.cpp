#include "models/array/plane/array_dynamics.h"
#include "models/array/plane/array_modes.h"
#include "models/array/plane/array_plan.h"
#include "models/array/plane/array_scene.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/error_control.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace viscard {
namespace {

constexpr double kPercentScale = 10.0;  // at a tolerance of 1e-3 per cents are known to .01 points

// A lone pillar on a film so wide that no end of it is felt.
ArrayGeometry lone(ArrayGeometry geometry) {
  geometry.count = 1;
  geometry.ends = FilmEnds::kMirror;
  geometry.spacing_m = 15.0 * std::max(geometry.diameter_m, 1.6 * geometry.film_thickness_m);
  return geometry;
}

// The response of one pillar for each of a row, and nothing between them.
ArrayResponse each_alone(const ArrayResponse& one, int count) {
  const auto repeated = [&](const Eigen::MatrixXd& value) {
    return value.size() == 0
               ? value
               : Eigen::MatrixXd(value(0, 0) * Eigen::MatrixXd::Identity(count, count));
  };
  ArrayResponse row;
  row.centre_V = repeated(one.centre_V);
  row.mean_V = repeated(one.mean_V);
  row.electrode_V = repeated(one.electrode_V);
  row.top_m = repeated(one.top_m);
  row.V_per_C = repeated(one.V_per_C);
  return row;
}

// Static results on one mesh.
class Statics {
 public:
  Statics(const ArrayScene& scene, const Discretisation& mesh) : scene_(scene) {
    answer_.discretisation = mesh;
    const ArrayModel model(scene.feels_neighbours ? scene.geometry : lone(scene.geometry),
                           scene.electrodes, media_of(scene), mesh);
    answer_.unknowns = model.unknowns();
    response_ = array_response(model, scene.load);
    if (!scene.feels_neighbours) response_ = each_alone(response_, scene.geometry.count);
    load_Pa_ =
        Eigen::VectorXd::Constant(scene.geometry.count, scene.loaded.empty() ? scene.load_Pa : 0.0);
    for (const int pillar : scene.loaded) load_Pa_[pillar - 1] = scene.load_Pa;
    // What stands for the voltage of a pillar where a single number is compared.
    const bool has_electrodes = response_.electrode_V.size() > 0;
    single_ = has_electrodes ? response_.electrode_V : response_.centre_V;
    mean_ = has_electrodes ? response_.electrode_V : response_.mean_V;
  }

  SceneAnswer run() {
    add_all("centre_voltage", under_load(response_.centre_V), "V");
    add_all("mean_voltage", under_load(response_.mean_V), "V");
    add_all("electrode_voltage", under_load(response_.electrode_V), "V");
    add_all("midway_voltage", under_load(response_.midway_V), "V");
    if (response_.V_per_C.size() > 0) {  // V = V_open + V_per_C Q = 0
      add_all("electrode_charge", -response_.V_per_C.lu().solve(under_load(response_.electrode_V)),
              "C");
    }
    add_all("top_displacement", under_load(response_.top_m), "m");
    if (single_.size() > 0 && load_Pa_.any() && scene_.feels_neighbours) per_cents();
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
  // What the electrodes do not have stays empty.
  Eigen::VectorXd under_load(const Eigen::MatrixXd& per_Pa) const {
    if (per_Pa.size() == 0) return {};
    return per_Pa * load_Pa_;
  }
  bool is_loaded(Eigen::Index pillar) const { return load_Pa_[pillar] != 0.0; }

  void per_cents() {
    const Eigen::Index n = load_Pa_.size();
    const Eigen::VectorXd V = under_load(single_);
    const Eigen::VectorXd mean_V = under_load(mean_);
    const Eigen::VectorXd midway_V = under_load(response_.midway_V);
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
  const ArrayModel model(scene.feels_neighbours ? scene.geometry : lone(scene.geometry),
                         scene.electrodes, media, mesh, inertia_ports_for(scene.modes));
  SceneAnswer answer;
  answer.discretisation = mesh;
  answer.unknowns = model.unknowns();
  const std::vector<ArrayMode> modes = array_modes(model, scene.modes);
  answer.step_error = film_inertia_error(model, media, modes);
  const int repeats = scene.feels_neighbours ? 1 : scene.geometry.count;
  for (const bool is_lateral : {true, false}) {
    for (const ArrayMode& mode : modes) {
      if (mode.is_lateral != is_lateral) continue;
      answer.modes.insert(answer.modes.end(), static_cast<std::size_t>(repeats),
                          {is_lateral ? "lateral" : "longitudinal", 0, mode.frequency_Hz, 0.0});
    }
  }
  return answer;
}

// The same pillar on a rigid base as often as there are pillars: no film, no unknowns for it.
SceneAnswer without_film(const ArrayScene& scene, const Discretisation& mesh) {
  Scene one = single_pillar(scene);
  one.kind = scene.analysis == ArrayAnalysis::kModal ? AnalysisKind::kModal : AnalysisKind::kStatic;
  one.modes = scene.modes;
  one.pressure_Pa = scene.load_Pa;
  SceneAnswer single;
  single.discretisation = mesh;
  analysis_of(one.kind).run(one, single);
  SceneAnswer answer;
  answer.discretisation = mesh;
  answer.unknowns = single.unknowns;
  for (const SceneMode& mode : single.modes) {
    answer.modes.insert(answer.modes.end(), static_cast<std::size_t>(scene.geometry.count), mode);
  }
  for (const SceneResult& result : single.results) {
    if (result.name != "top_displacement") continue;
    for (int i = 1; i <= scene.geometry.count; ++i) {
      const bool is_loaded =
          scene.loaded.empty() ||
          std::find(scene.loaded.begin(), scene.loaded.end(), i) != scene.loaded.end();
      answer.results.push_back({result.name + "_" + std::to_string(i),
                                is_loaded ? result.value : 0.0, "m", 0.0, std::abs(result.value)});
    }
  }
  return answer;
}

// No mesh mends what the film's own inertia, which modes of a row leave out, may change.
void refuse_film_modes(double film_error, double tolerance) {
  if (film_error <= tolerance) return;
  char text[260];
  std::snprintf(text, sizeof text,
                "the film's own inertia, which the modes of a row leave out, may change the "
                "frequencies by %.2g of them, more than the tolerance of %.2g; ask for a larger "
                "tolerance or fewer modes, or for one pillar on its film (kind = \"pillar\")",
                film_error, tolerance);
  throw std::runtime_error(text);
}

}  // namespace

ArrayMedia media_of(const ArrayScene& scene) {
  return {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, scene.pillar.rho_kg_m3), scene.film,
          scene.plane};
}

// The field is singular as r^(1/2) at an electrode's edge, which takes more layers than the weaker
// corners of the pillars do.
// The shaft matters to modes only.
std::vector<Discretisation> array_meshes(const ArrayScene& scene) {
  std::vector<Discretisation> all;
  for (const auto& [degree, layers] :
       {std::pair{3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}, {8, 4}, {9, 5}}) {
    all.push_back({.degree = degree,
                   .layers = scene.electrodes.is_equipotential ? degree : layers,
                   .shaft_elements = scene.analysis == ArrayAnalysis::kStatic ? 1 : 2});
  }
  return all;
}

SceneAnswer array_answer_on(const ArrayScene& scene, const Discretisation& mesh) {
  if (!scene.feels_film) return without_film(scene, mesh);
  switch (scene.analysis) {
    case ArrayAnalysis::kModal:
      return modes_on(scene, mesh);
    case ArrayAnalysis::kHarmonic:
    case ArrayAnalysis::kTransient:
      return array_dynamics_on(scene, mesh);
    case ArrayAnalysis::kStatic:
      break;
  }
  return Statics(scene, mesh).run();
}

SceneAnswer simulate_array(const ArrayScene& scene) {
  validate(scene);
  return answer_within({scene.tolerance, array_meshes(scene), scene.progress},
                       [&](const Discretisation& mesh) {
                         SceneAnswer answer = array_answer_on(scene, mesh);
                         if (scene.analysis == ArrayAnalysis::kModal) {
                           refuse_film_modes(answer.step_error, scene.tolerance);
                         }
                         return answer;
                       });
}

void simulate_arrays(const std::vector<ArrayScene>& points,
                     const std::function<void(std::size_t, const SceneAnswer&)>& done) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < points.size(); i = next++) {
      try {
        const SceneAnswer answer = simulate_array_planned(points[i]);
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
