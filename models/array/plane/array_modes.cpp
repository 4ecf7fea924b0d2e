#include "models/array/plane/array_modes.h"

#include "models/maths/dense.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace viscard {

namespace {

// `all` are the readings of all ports under the inertia of unit amplitudes, which `vector` are the
// amplitudes of. Sums of modes on a fixed base are scaled with them.
void add_motion(const ArrayModel& model, const Eigen::MatrixXd& all, const Eigen::VectorXd& vector,
                ArrayMode& mode) {
  const int n = model.geometry().count;
  const ArrayLoad load = mode.is_lateral ? ArrayLoad::kShear : ArrayLoad::kPressure;
  mode.amplitude = vector.reshaped(vector.size() / n, n);
  mode.top.resize(n);
  for (int i = 0; i < n; ++i) {
    mode.top[i] = metres_per_reading(load, model.geometry()) *
                  all.row(model.pillar_port(i, port_of(load))).dot(vector);
  }
  // Of pillars that move as much as each other, the first one moves along the axis.
  constexpr double kAsMuch = 1.0 - 1e-6;
  const double largest = mode.top.cwiseAbs().maxCoeff();
  int first = 0;
  while (std::abs(mode.top[first]) < kAsMuch * largest) ++first;
  if (mode.top[first] < 0.0) mode.amplitude = -mode.amplitude;
  if (largest > 0.0) mode.top /= mode.top[first] < 0.0 ? -largest : largest;
}

}  // namespace

int inertia_ports_for(int clusters) {
  return 3 * clusters + 6;
}

std::vector<ArrayMode> array_modes(const ArrayModel& model, int clusters) {
  const int n = model.geometry().count;
  const CondensedPillar& pillar = model.pillar();
  const int per_pillar = static_cast<int>(pillar.mode_rad_s.size());
  std::vector<int> ports;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < per_pillar; ++k) ports.push_back(model.pillar_port(i, kFirstModePort + k));
  }
  if (ports.empty()) throw std::invalid_argument("the array model has no inertia ports");
  const Eigen::MatrixXd all = model.chain().compliance(ports);
  const Eigen::MatrixXd G = all(ports, Eigen::all);
  const EigenSystem system = symmetric_eigen(0.5 * (G + G.transpose()));
  std::vector<ArrayMode> modes;
  int left[2] = {clusters * n, clusters * n};
  for (Eigen::Index j = G.rows() - 1; j >= 0 && (left[0] > 0 || left[1] > 0); --j) {
    const Eigen::VectorXd amplitude = system.vectors.col(j).cwiseAbs2();
    ArrayMode mode{1.0 / (2.0 * std::numbers::pi * std::sqrt(system.values[j])),
                   false,
                   Eigen::VectorXd::Zero(n),
                   {},
                   {}};
    double lateral = 0.0;
    for (Eigen::Index row = 0; row < amplitude.size(); ++row) {
      mode.share[row / per_pillar] += amplitude[row];
      if (pillar.mode_is_lateral[static_cast<std::size_t>(row % per_pillar)]) {
        lateral += amplitude[row];
      }
    }
    mode.is_lateral = lateral > 0.5;
    int& wanted = left[mode.is_lateral ? 1 : 0];
    if (wanted-- <= 0) continue;
    add_motion(model, all, system.vectors.col(j), mode);
    modes.push_back(std::move(mode));
  }
  // Left-out modes would change the highest of the modes in use, so only lower ones are trusted.
  const double trusted_Hz = pillar.mode_rad_s[per_pillar - 1] / (2.0 * std::numbers::pi);
  if (left[0] > 0 || left[1] > 0 || modes.back().frequency_Hz > trusted_Hz) {
    throw std::invalid_argument("the pillars have inertia ports for " + std::to_string(per_pillar) +
                                " modes, too few for " + std::to_string(clusters) +
                                " of each family");
  }
  return modes;
}

double film_inertia_error(const ArrayModel& model, const ArrayMedia& media,
                          const std::vector<ArrayMode>& modes) {
  const double shear_speed = std::sqrt(media.film.stiffness_Pa(4, 4) / media.film.rho_kg_m3);
  const double film_Hz = shear_speed / (4.0 * model.geometry().film_thickness_m);
  double largest = 0.0;
  for (const ArrayMode& mode : modes) {
    double nearest = 1.0;  // share of the film in the compliance of this mode
    for (const double rad_s : model.pillar().mode_rad_s) {
      const double ratio = 2.0 * std::numbers::pi * mode.frequency_Hz / rad_s;
      nearest = std::min(nearest, std::abs(1.0 - ratio * ratio));
    }
    const double ratio = mode.frequency_Hz / film_Hz;
    largest = std::max(largest, nearest * ratio * ratio);
  }
  return largest;
}

}  // namespace viscard
