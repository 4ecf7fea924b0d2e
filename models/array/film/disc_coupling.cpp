#include "models/array/film/disc_coupling.h"

#include "models/answer/scene_mistake.h"
#include "models/array/film/film_table.h"
#include "models/maths/require.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kApart_kt = 16.0;       // from here on p k is constant (disc_charge.cpp)
constexpr double kPhase = 5.0;           // farthest distance times a panel of k
constexpr double kStep = 0.7;            // panel of k times the thickness of the film
constexpr double kFirstPanel = 0.125;    // first panel over the others: long waves on a backing
constexpr double kLeastGap = 0.05;       // of the film's thickness, between discs
constexpr double kLeastOfRadius = 0.02;  // of their radius

// Waves and the potential per charge of each, quadrature weight included.
struct ChargeWaves {
  std::vector<double> k_1_m, potential_V_C;
};

// The integrand goes as k^-2.5 and oscillates with the gap between the discs, so that waves up to some multiple of the
// inverse of the gap and of the radius are needed; they fade out.
ChargeWaves charge_waves(const LayeredFilm& film, const CouplingAccuracy& accuracy, double gap_m,
                         double radius_m, double reach_m) {
  const double t_m = film.layers.front().thickness_m;
  const double apart_1_m = kApart_kt / t_m;
  const double shortest_m = std::min(radius_m, std::max(gap_m, kLeastGap * t_m));
  const double largest_1_m = accuracy.largest_kt / std::min(0.5 * t_m, shortest_m);
  const ChargePotential potential(film, apart_1_m, accuracy.film_degree);
  const double limit = apart_1_m * potential.at(apart_1_m);
  const double longest_1_m = std::min(kPhase / reach_m, kStep / t_m);
  ChargeWaves waves;
  each_graded_wave(
      kFirstPanel * longest_1_m, largest_1_m, longest_1_m, [&](double k_1_m, double weight_1_m2) {
        const double p = k_1_m < apart_1_m ? potential.at(k_1_m) : limit / k_1_m;
        waves.k_1_m.push_back(k_1_m);
        waves.potential_V_C.push_back((1.0 - cut(k_1_m / largest_1_m)) * weight_1_m2 * p);
      });
  return waves;
}

}  // namespace

double least_gap_m(double film_thickness_m, double radius_m) {
  return std::max(kLeastGap * film_thickness_m, kLeastOfRadius * radius_m);
}

void check_read_film(const Medium& film, double thickness_m, const std::string& what) {
  if (!film.has_permittivity() || !film.is_piezoelectric()) {
    throw SceneMistake("geometry.film.material",
                       what +
                           " is read by its film, which must be piezoelectric; give a material "
                           "from a file, such as pvdf_seed.json");
  }
  if (!(thickness_m > 0.0)) {
    throw SceneMistake("geometry.film.thickness", "the film's thickness must be positive");
  }
}

void check_electrode_gap(const std::string& key, const std::string& pair, double distance_m,
                         double radius_m, double least_m) {
  constexpr double kSame = 1e-9;  // lengths that only rounding tells apart
  const double gap_m = distance_m - 2.0 * radius_m;
  const std::string smaller =
      "; make them smaller, at most " + micrometres(0.5 * (distance_m - least_m), 4) + " in radius";
  if (gap_m < -kSame * radius_m)
    throw SceneMistake(key, "the electrodes of " + pair + " overlap" + smaller);
  if (!(gap_m < (1.0 - kSame) * least_m)) return;
  if (gap_m < kSame * radius_m) {
    throw SceneMistake(key, "the electrodes of " + pair +
                                " touch, which makes them one conductor with one voltage" +
                                smaller);
  }
  throw SceneMistake(key, "the gap of " + micrometres(gap_m, 3) + " between the electrodes of " +
                              pair + " is smaller than " + micrometres(least_m, 3) +
                              ", below which the charges on their rims are not resolved" + smaller);
}

DiscCoupling::DiscCoupling(const LayeredFilm& film, const DiscCharge& charge, double nearest_m,
                           const CouplingAccuracy& accuracy)
    : charge_(&charge),
      nearest_m_(nearest_m),
      reach_m_(nearest_m + accuracy.beyond_nearest_m),
      far_m_(std::max(reach_m_, accuracy.far_m)),
      harmonics_(std::min(accuracy.harmonics, charge.harmonics() - 1)),
      modes_each_(std::min(accuracy.modes, charge.modes())) {
  require_positive("distance of two electrodes", nearest_m, "m");
  functions_.push_back({});
  for (int m = 0; m <= harmonics_; ++m) {
    for (const bool is_sine : {false, true}) {
      for (int l = m == 0 ? 1 : 0; l < modes_each_ && !(m == 0 && is_sine); ++l) {
        functions_.push_back({static_cast<Eigen::Index>(m) * modes_each_ + l, m, is_sine});
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(functions_.size());
  modes_ = count - 1;
  scale_.setOnes(count);
  induced_.setZero(modes_, modes_);
  for (Eigen::Index i = 1, size = 0; i < count; i += size) {
    const int m = functions_[static_cast<std::size_t>(i)].order;
    scale_.tail(count - i).setConstant(m == 0 ? 1.0 : std::numbers::sqrt2);
    // The first mode of m = 0 has the net charge.
    size = m == 0 ? modes_each_ - 1 : modes_each_;
    const Eigen::MatrixXd all =
        charge.induced(m, Eigen::MatrixXd::Identity(modes_each_, modes_each_));
    induced_.block(i - 1, i - 1, size, size) = all.bottomRightCorner(size, size);
  }
  const ChargeWaves waves =
      charge_waves(film, accuracy, nearest_m - 2.0 * charge.radius_m(), charge.radius_m(), far_m_);
  const RadialWaves receivers = transforms(waves.k_1_m);
  RadialWaves sources = receivers;
  for (std::size_t i = 0; i < waves.k_1_m.size(); ++i) {
    sources.amplitude.row(static_cast<Eigen::Index>(i)) *= waves.potential_V_C[i];
  }
  table_.emplace(waves.k_1_m, receivers, sources,
                 GrafTable::Range{nearest_m, far_m_, 2.0 * charge.radius_m()});
}

// The charge at equal potential stands in the place of the first mode.
RadialWaves DiscCoupling::transforms(const std::vector<double>& k_1_m) const {
  RadialWaves waves;
  const int count = (harmonics_ + 1) * modes_each_;
  for (int f = 0; f < count; ++f) waves.order.push_back(f / modes_each_);
  waves.amplitude.resize(static_cast<Eigen::Index>(k_1_m.size()), count);
  for (std::size_t i = 0; i < k_1_m.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (int m = 0; m <= harmonics_; ++m) {
      waves.amplitude.row(row).segment(static_cast<Eigen::Index>(m) * modes_each_, modes_each_) =
          charge_->transforms(m, k_1_m[i]).head(modes_each_).transpose();
    }
    waves.amplitude(row, 0) = charge_->weight(k_1_m[i]);
  }
  return waves;
}

Eigen::MatrixXd DiscCoupling::between(double x_m, double y_m) const {
  const Eigen::MatrixXd seen = table_->between(functions_, functions_, x_m, y_m);
  return scale_.cwiseInverse().asDiagonal() * seen * scale_.asDiagonal();
}

Eigen::MatrixXd DiscCoupling::own_charges(const AxialField& field) const {
  const RadialWaves read = transforms(field.k_1_m);
  const RadialWaves read_own = transforms(field.own_k_1_m);
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(modes_, field.loads);
  for (Eigen::Index i = 0; i < modes_; ++i) {
    const AngularFunction& mode = functions_[static_cast<std::size_t>(i) + 1];
    for (std::size_t f = 0; f < field.load.size(); ++f) {
      const AngularFunction& one = field.functions[f];
      if (one.order != mode.order || one.is_sine != mode.is_sine) continue;
      moments(i, field.load[f]) +=
          read.amplitude.col(mode.radial).dot(field.waves.amplitude.col(one.radial)) /
          scale_[i + 1];
    }
    for (std::size_t k = 0; k < field.own_k_1_m.size() && mode.order == 0; ++k) {
      moments(i, 0) +=
          read_own.amplitude(static_cast<Eigen::Index>(k), mode.radial) * field.own_amplitude[k];
    }
  }
  return induced_ * moments;
}

GrafTable DiscCoupling::table_of(const AxialField& field, double cause_radius_m) const {
  const double singular_m = charge_->radius_m() + std::max(charge_->radius_m(), cause_radius_m);
  return {field.k_1_m, transforms(field.k_1_m), field.waves, {nearest_m_, reach_m_, singular_m}};
}

Eigen::MatrixXd DiscCoupling::moments_at(const GrafTable& table, const AxialField& field,
                                         double x_m, double y_m) const {
  const std::vector<AngularFunction> modes(functions_.begin() + 1, functions_.end());
  const Eigen::MatrixXd of_functions = table.between(modes, field.functions, x_m, y_m);
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(modes_, field.loads);
  for (std::size_t f = 0; f < field.load.size(); ++f) {
    moments.col(field.load[f]) += of_functions.col(static_cast<Eigen::Index>(f));
  }
  return scale_.tail(modes_).cwiseInverse().asDiagonal() * moments;
}

}  // namespace viscard
