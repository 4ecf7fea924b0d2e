#include "models/array/plane/array_analysis.h"

#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

constexpr double kPercentScale = 10.0;  // a tolerance of 1e-3 gives per cents to 0.01 points

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
    // The voltage of a pillar where single numbers are compared.
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
  void add(const std::string& stem, int pillar, double value, const char* unit, double scale) {
    const std::string name = stem + "_" + std::to_string(pillar);
    answer_.results.push_back({name, value, unit, 0.0, scale, asks_for(scene_, name)});
  }
  void add_all(const std::string& name, const Eigen::VectorXd& values, const char* unit) {
    const double scale = values.size() == 0 ? 0.0 : values.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      add(name, static_cast<int>(i) + 1, values[i], unit, scale);
    }
  }
  // Empty for a voltage that the electrodes do not have.
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
    const auto largest = [](const Eigen::VectorXd& of) {
      Eigen::Index at = 0;
      of.cwiseAbs().maxCoeff(&at);
      return of[at];
    };
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
      const std::string deviation = "deviation_percent_" + std::to_string(number);
      if (scene_.wanted.empty() || !asks_for(scene_, deviation)) continue;
      add("deviation_percent", number, 100.0 * (V[i] / (lone_V() * load_Pa_[i]) - 1.0), "%",
          kPercentScale);
    }
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

std::vector<std::string> row_static_names(const ArrayScene& scene) {
  std::vector<std::string> names = {"top_displacement"};
  if (!is_electric(scene)) return names;
  const auto add = [&](const char* name) { names.emplace_back(name); };
  const bool is_read = !scene.electrodes.is_equipotential;
  const auto loaded = static_cast<int>(scene.loaded.size());
  const bool all_loaded = loaded == 0 || loaded == scene.geometry.count;
  const bool is_endless = scene.geometry.ends == FilmEnds::kMirror;
  const bool has_midway = is_endless || scene.geometry.count > 1;
  add(is_read ? "centre_voltage" : "electrode_voltage");
  add(is_read ? "mean_voltage" : "electrode_charge");
  if (has_midway) add("midway_voltage");
  if (has_midway && (all_loaded || loaded > 1 || is_endless)) add("coupling_percent");
  if (!all_loaded) add("crosstalk_percent");
  if (!all_loaded && is_read) add("crosstalk_centre_percent");
  add("neighbours_percent");
  add("deviation_percent");
  return names;
}

SceneAnswer run_row_static(const ArrayScene& scene, const Discretisation& mesh) {
  return Statics(scene, mesh).run();
}

PillarDrive row_static_alone(const ArrayScene& scene) {
  return StaticDrive{.pressure_Pa = scene.load_Pa};
}

}  // namespace

ArrayAnalysis array_static_analysis() {
  return {.name = "static",
          .drive = RowStatic{},
          .check = check_load,
          .result_names = row_static_names,
          .run = run_row_static,
          .alone = row_static_alone};
}

}  // namespace viscard
