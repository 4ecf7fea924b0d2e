#include "models/array/plane/array_analysis.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace viscard {
namespace {

constexpr double kPercentScale = 10.0;  // a tolerance of 1e-3 gives percentages to 0.01 points

// A voltage that is smaller than that of an equally pressed pillar by this factor is zero by
// symmetry, for example under a pillar sheared between mirrors. No percentage or error can refer to
// it.
constexpr double kNoVoltage = 1e-9;

// A model of a single pillar for each pillar of the row.
ArrayAnswer each_alone(const ArrayAnswer& one, const Eigen::VectorXd& load_Pa) {
  ArrayAnswer row;
  for (const auto value : {&ArrayAnswer::centre_V, &ArrayAnswer::mean_V, &ArrayAnswer::electrode_V,
                           &ArrayAnswer::electrode_C, &ArrayAnswer::top_m}) {
    if ((one.*value).size() > 0) row.*value = (one.*value)[0] * load_Pa;
  }
  return row;
}

const Eigen::VectorXd& single_V(const ArrayAnswer& of) {
  return of.electrode_V.size() > 0 ? of.electrode_V : of.centre_V;
}

// Static results on one mesh.
class Statics {
 public:
  Statics(const ArrayScene& scene, const Discretisation& mesh)
      : scene_(scene), model_(model_of(scene, mesh)) {
    answer_.discretisation = mesh;
    answer_.unknowns = model_.unknowns();
    load_Pa_ =
        Eigen::VectorXd::Constant(scene.geometry.count, scene.loaded.empty() ? scene.load_Pa : 0.0);
    for (const int pillar : scene.loaded) load_Pa_[pillar - 1] = scene.load_Pa;
    row_ = scene.feels_neighbours
               ? array_answer(model_, scene.load, load_Pa_)
               : each_alone(array_answer(model_, scene.load, Eigen::VectorXd::Ones(1)), load_Pa_);
  }

  SceneAnswer run() {
    double charge_C = 0.0;
    if (single_V(row_).size() > 0) {
      pressed_V_ = std::abs(own_V_per_Pa(model_, ArrayLoad::kPressure, 0) * scene_.load_Pa);
    }
    if (row_.electrode_C.size() > 0) charge_C = std::abs(pressed_V_ / own_V_per_C(model_, 0));
    add_all("centre_voltage", row_.centre_V, "V", pressed_V_);
    add_all("mean_voltage", row_.mean_V, "V", pressed_V_);
    add_all("electrode_voltage", row_.electrode_V, "V", pressed_V_);
    add_all("midway_voltage", row_.midway_V, "V", pressed_V_);
    add_all("electrode_charge", row_.electrode_C, "C", charge_C);
    add_all("top_displacement", row_.top_m, "m", 0.0);
    if (single_V(row_).size() > 0 && load_Pa_.any() && scene_.feels_neighbours) per_cents();
    return std::move(answer_);
  }

 private:
  void add(const std::string& stem, int pillar, double value, const char* unit, double scale) {
    const std::string name = stem + "_" + std::to_string(pillar);
    answer_.results.push_back({name, value, unit, 0.0, scale, asks_for(scene_, name)});
  }
  // `pressed` is the reference value for values that are zero by symmetry.
  void add_all(const std::string& name, const Eigen::VectorXd& values, const char* unit,
               double pressed) {
    double scale = values.size() == 0 ? 0.0 : values.cwiseAbs().maxCoeff();
    if (scale <= kNoVoltage * pressed) scale = pressed;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      add(name, static_cast<int>(i) + 1, values[i], unit, scale);
    }
  }
  bool is_loaded(Eigen::Index pillar) const { return load_Pa_[pillar] != 0.0; }

  // `part` in per cent of `whole`, unless that is zero by symmetry.
  void add_per_cent(const char* stem, Eigen::Index i, double part, double whole) {
    if (std::abs(whole) <= kNoVoltage * pressed_V_) {
      ++without_whole_;
      return;
    }
    add(stem, static_cast<int>(i) + 1, 100.0 * part / whole, "%", kPercentScale);
  }

  void per_cents() {
    const Eigen::Index n = load_Pa_.size();
    const Eigen::VectorXd& V = single_V(row_);
    const Eigen::VectorXd& mean_V = row_.mean_V.size() > 0 ? row_.mean_V : V;
    const Eigen::VectorXd& midway_V = row_.midway_V;
    const auto largest = [](const Eigen::VectorXd& of) {
      Eigen::Index at = 0;
      of.cwiseAbs().maxCoeff(&at);
      return of[at];
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i < midway_V.size() && is_loaded(i) && is_loaded(std::min(i + 1, n - 1))) {
        const double between_V = 0.5 * (V[i] + V[std::min(i + 1, n - 1)]);
        add_per_cent("coupling_percent", i, 0.5 * midway_V[i], between_V);
      }
      if (!is_loaded(i)) {
        add_per_cent("crosstalk_percent", i, mean_V[i], largest(mean_V));
        if (row_.centre_V.size() > 0) {
          add_per_cent("crosstalk_centre_percent", i, V[i], largest(V));
        }
        continue;
      }
      const double own_V = own_V_per_Pa(model_, scene_.load, static_cast<int>(i)) * load_Pa_[i];
      add_per_cent("neighbours_percent", i, V[i] - own_V, own_V);
      const std::string deviation = "deviation_percent_" + std::to_string(i + 1);
      if (scene_.wanted.empty() || !asks_for(scene_, deviation)) continue;
      add_per_cent("deviation_percent", i, V[i] - lone_V() * load_Pa_[i], lone_V() * load_Pa_[i]);
    }
    if (without_whole_ == 0) return;
    answer_.notes.push_back(
        std::to_string(without_whole_) +
        " percentages are left out: the voltage that they are relative to is zero by symmetry");
  }
  double lone_V() {
    if (lone_V_ == 0.0) {
      const ArrayModel model(lone(scene_.geometry), scene_.electrodes, media_of(scene_),
                             answer_.discretisation);
      lone_V_ = single_V(array_answer(model, scene_.load, Eigen::VectorXd::Ones(1)))[0];
    }
    return lone_V_;
  }

  const ArrayScene& scene_;
  const ArrayModel model_;
  SceneAnswer answer_;
  ArrayAnswer row_;
  Eigen::VectorXd load_Pa_;
  double lone_V_ = 0.0;
  double pressed_V_ = 0.0;  // of a pillar that is pressed by the load
  int without_whole_ = 0;
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
