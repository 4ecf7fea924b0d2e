// From voltages back to loads: against dense generalised least squares, closed forms and the loads that made the frames.
#include "models/array/inverse/load_reader.h"
#include "models/array/space/space_array.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>

namespace viscard {
namespace {

constexpr double kPitch_m = 100e-6;

// Pillars of 40 x 120 um on the thesis' film, rows from the lowest y; with quarters, or their mean.
ReadArray read_array(int rows, int columns, bool has_quarters) {
  static const auto responses = [] {
    struct Response {
      SpaceArray array;
      std::unique_ptr<SpaceResponse> response;
    };
    auto all = std::make_unique<Response>();
    all->array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
    all->array.film = test::film_of_the_thesis();
    all->array.electrode = SpaceElectrode::kQuadrants;
    all->array.electrode_radius_m = 20e-6;
    all->array.pillars = {{0.0, 0.0, 0}};
    all->response = std::make_unique<SpaceResponse>(all->array, space_accuracies(all->array)[1]);
    return all;
  }();
  ReadArray array;
  array.readings = has_quarters ? 4 : 1;
  array.loads = has_quarters ? 3 : 1;
  array.reach_m = responses->response->reach_m();
  array.kernel = [has_quarters](int, double x_m, double y_m) -> Eigen::MatrixXd {
    const auto all = responses->response->kernel(0, x_m, y_m);
    return all.block(has_quarters ? 2 : 1, 0, has_quarters ? 4 : 1, 3);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      array.pillars.push_back({column * kPitch_m, row * kPitch_m, 0});
    }
  }
  array.works.assign(array.pillars.size() * static_cast<std::size_t>(array.readings), 1);
  return array;
}

std::vector<std::size_t> in_order(const ReadArray& array) {
  std::vector<std::size_t> places(array.pillars.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

// Readings x loads of all pairs, without the readings that do not work.
Eigen::MatrixXd dense_kernel(const ReadArray& array) {
  const auto n = static_cast<Eigen::Index>(array.pillars.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n * array.readings, n * array.loads);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const SourcePoint &to = array.pillars[static_cast<std::size_t>(i)],
                        &from = array.pillars[static_cast<std::size_t>(j)];
      const double x_m = to.x_m - from.x_m, y_m = to.y_m - from.y_m;
      if (std::hypot(x_m, y_m) > array.reach_m) continue;
      K.block(i * array.readings, j * array.loads, array.readings, array.loads) =
          array.kernel(0, x_m, y_m).leftCols(array.loads);
    }
  }
  for (Eigen::Index row = 0; row < K.rows(); ++row) {
    if (array.works[static_cast<std::size_t>(row)] == 0) K.row(row).setZero();
  }
  return K;
}

// Frames by column: loads with independent normal values, and what is read of them.
struct Frames {
  Eigen::MatrixXd loads_Pa, voltages_V;
  VoltageFrames view() const {
    return {voltages_V.data(), static_cast<std::size_t>(voltages_V.cols())};
  }
};
Frames random_frames(const ReadArray& array, int count, double size_Pa, double noise_V,
                     double gain_spread = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd K = dense_kernel(array);
  const auto draw = [&](Eigen::Index rows, Eigen::Index columns, double size) {
    Eigen::MatrixXd values(rows, columns);
    for (double& one : values.reshaped()) one = size * normal(random);
    return values;
  };
  Frames frames;
  frames.loads_Pa = draw(K.cols(), count, size_Pa);
  const Eigen::VectorXd gains = (draw(K.rows(), 1, gain_spread).array() + 1.0).matrix();
  frames.voltages_V = gains.asDiagonal() * (K * frames.loads_Pa) + draw(K.rows(), count, noise_V);
  for (Eigen::Index row = 0; row < K.rows(); ++row) {
    if (array.works[static_cast<std::size_t>(row)] == 0) {
      frames.voltages_V.row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return frames;
}

struct Found {
  Eigen::MatrixXd loads_Pa, half_widths_Pa;
};
Found read_with(const LoadReader& reader, const Frames& frames) {
  Found found{Eigen::MatrixXd(frames.loads_Pa.rows(), frames.loads_Pa.cols()), {}};
  found.half_widths_Pa = found.loads_Pa;
  reader.read(frames.view(), found.loads_Pa.data(), found.half_widths_Pa.data());
  return found;
}

double coverage(const Found& found, const Eigen::MatrixXd& loads_Pa) {
  const auto is_inside =
      (found.loads_Pa - loads_Pa).cwiseAbs().array() <= found.half_widths_Pa.array();
  return is_inside.cast<double>().mean();
}

TEST_CASE("estimates and their widths are those of a dense generalised least squares", "[models]") {
  const bool has_quarters = GENERATE(false, true);
  const Penalty penalty = GENERATE(Penalty::kSize, Penalty::kSlope);
  CAPTURE(has_quarters, penalty == Penalty::kSlope);
  ReadArray array = read_array(12, 12, has_quarters);
  for (const std::size_t dead : {0, 17, 66, 67, 140}) {
    for (Eigen::Index r = 0; r < array.readings; ++r) {
      array.works[dead * static_cast<std::size_t>(array.readings) + static_cast<std::size_t>(r)] =
          0;
    }
  }
  if (has_quarters) array.works[4 * 80 + 2] = 0;  // one quarter of an electrode that works
  constexpr double kNoise_V = 2e-4, kWeight = 3e-3;
  const Frames frames = random_frames(array, 6, 10e3, kNoise_V);
  const LoadReader reader(array, in_order(array), array.pillars.size(), {.noise_V = kNoise_V},
                          {.penalty = penalty, .weight = kWeight}, frames.view());
  const Found found = read_with(reader, frames);

  const Eigen::MatrixXd K = dense_kernel(array);
  Eigen::MatrixXd L = Eigen::MatrixXd::Identity(K.cols(), K.cols());
  if (penalty == Penalty::kSlope) {
    L *= 1e-9;
    for (int i = 0; i < 144; ++i) {
      for (const int j : {i % 12 < 11 ? i + 1 : -1, i < 132 ? i + 12 : -1}) {
        for (Eigen::Index l = 0; l < array.loads && j >= 0; ++l) {
          Eigen::RowVectorXd difference = Eigen::RowVectorXd::Zero(K.cols());
          difference[i * array.loads + l] = 1.0;
          difference[j * array.loads + l] = -1.0;
          L += difference.transpose() * difference;
        }
      }
    }
  }
  const double scale_V2_Pa2 = array.kernel(0, 0.0, 0.0).leftCols(array.loads).squaredNorm() /
                              static_cast<double>(array.loads);
  const Eigen::MatrixXd inverse = (K.transpose() * K + kWeight * scale_V2_Pa2 * L)
                                      .llt()
                                      .solve(Eigen::MatrixXd::Identity(K.cols(), K.cols()));
  const Eigen::MatrixXd read_V = frames.voltages_V.array().isNaN().select(0.0, frames.voltages_V);
  const Eigen::MatrixXd right = inverse * K.transpose() * read_V;
  CHECK((found.loads_Pa - right).cwiseAbs().maxCoeff() < 1e-6 * right.cwiseAbs().maxCoeff());
  const Eigen::VectorXd half = 1.959964 * kNoise_V * inverse.diagonal().cwiseSqrt();
  const Eigen::ArrayXd ratio = found.half_widths_Pa.col(0).array() / half.array();
  CHECK(ratio.minCoeff() > 0.99);
  CHECK(ratio.maxCoeff() < 1.01);
  CHECK(reader.is_resolved(30, 0));
  CHECK_FALSE(reader.is_resolved(66, 0));  // without an electrode of its own
}

TEST_CASE("95 of 100 intervals hold the load, where the data choose the weight", "[models]") {
  const bool has_quarters = GENERATE(false, true);
  const double size_Pa = GENERATE(10e3, 500.0);  // far above the noise, and as large as it
  CAPTURE(has_quarters, size_Pa);
  ReadArray array = read_array(12, 12, has_quarters);
  for (const std::size_t dead : {5, 40, 41, 100, 143}) {
    for (Eigen::Index r = 0; r < array.readings; ++r) {
      array.works[dead * static_cast<std::size_t>(array.readings) + static_cast<std::size_t>(r)] =
          0;
    }
  }
  constexpr double kNoise_V = 4e-4, kGainSpread = 0.02;
  const Frames frames = random_frames(array, 100, size_Pa, kNoise_V, kGainSpread);
  const LoadReader reader(array, in_order(array), array.pillars.size(),
                          {.noise_V = kNoise_V, .gain_spread = kGainSpread}, {}, frames.view());
  CHECK(reader.regularisation().rule == WeightRule::kDiscrepancy);
  const Found found = read_with(reader, frames);
  const double share = coverage(found, frames.loads_Pa);
  CHECK(share > 0.92);
  CHECK(share < 0.98);
  // The weight stands for the loads that there are: s^2 = noise^2/weight.
  CHECK(reader.regularisation().prior_Pa == Approx(size_Pa).epsilon(0.1));
}

TEST_CASE("smooth loads show their noise by cross-validation", "[models]") {
  const ReadArray array = read_array(20, 20, false);
  constexpr double kNoise_V = 3e-4;
  Frames frames = random_frames(array, 8, 0.0, kNoise_V);
  for (Eigen::Index f = 0; f < 8; ++f) {
    for (Eigen::Index i = 0; i < 400; ++i) {
      const double x = static_cast<double>(i % 20) / 20.0, y = static_cast<double>(i / 20) / 20.0;
      frames.loads_Pa(i, f) =
          2e3 * (1.0 + std::sin(5.0 * x + static_cast<double>(f)) * std::cos(4.0 * y));
    }
  }
  frames.voltages_V += dense_kernel(array) * frames.loads_Pa;
  const LoadReader reader(array, in_order(array), 400, {}, {}, frames.view());
  CHECK(reader.regularisation().rule == WeightRule::kCrossValidation);
  CHECK(reader.regularisation().penalty == Penalty::kSlope);
  CHECK(reader.regularisation().noise_V == Approx(kNoise_V).epsilon(0.1));
  const Found found = read_with(reader, frames);
  CHECK(coverage(found, frames.loads_Pa) > 0.92);
  // Smoothing pays: less than the noise of single readings.
  const double error_Pa = std::sqrt((found.loads_Pa - frames.loads_Pa).array().square().mean());
  CHECK(error_Pa < 0.8 * kNoise_V / 1.92665e-6);
}

TEST_CASE("a lone pillar has the closed form of ridge regression", "[models]") {
  const ReadArray array = read_array(1, 1, false);
  const double k_V_Pa = array.kernel(0, 0.0, 0.0)(0, 0);
  constexpr double kWeight = 0.25, kNoise_V = 1e-4, kVoltage_V = -0.02;
  const LoadReader reader(array, {1}, 3, {.noise_V = kNoise_V}, {.weight = kWeight},
                          {std::vector<double>{0.0, kVoltage_V, 0.0}.data(), 1});
  const std::vector<double> frame = {0.0, kVoltage_V, 0.0};
  std::vector<double> load_Pa(3), half_Pa(3);
  reader.read({frame.data(), 1}, load_Pa.data(), half_Pa.data());
  CHECK(load_Pa[1] == Approx(kVoltage_V / k_V_Pa / (1.0 + kWeight)).epsilon(1e-12));
  CHECK(half_Pa[1] ==
        Approx(1.959964 * kNoise_V / std::abs(k_V_Pa) / std::sqrt(1.0 + kWeight)).epsilon(1e-6));
  CHECK(reader.own_share()[0] == Approx(1.0 / (1.0 + kWeight)).epsilon(1e-12));
  CHECK(std::isnan(load_Pa[0]));  // nothing stands there
  CHECK(std::isnan(half_Pa[2]));
}

TEST_CASE("a shear that nobody measures widens the intervals of its neighbours", "[models]") {
  const ReadArray array = read_array(9, 9, false);
  const std::vector<double> frame(81, -0.01);
  const auto half_Pa = [&](double shear_Pa, double noise_V) {
    const LoadReader reader(array, in_order(array), 81,
                            {.noise_V = noise_V, .disturbing_Pa = shear_Pa}, {.weight = 1e-9},
                            {frame.data(), 1});
    std::vector<double> load_Pa(81), half(81);
    reader.read({frame.data(), 1}, load_Pa.data(), half.data());
    return half[40];
  };
  // 3.02 % of a neighbour's shear along x and 1.42 % along y read as pressure, from both sides; the diagonal ones
  // 0.23 %, and what the others add is below 0.1 %.
  const double of_shear =
      1.959964 * 1000.0 *
      std::sqrt(2.0 * (0.0302 * 0.0302 + 0.0142 * 0.0142) + 4.0 * 0.0023 * 0.0023);
  CHECK(half_Pa(1000.0, 1e-9) == Approx(of_shear).epsilon(0.03));
  CHECK(half_Pa(0.0, 1e-9) < 1e-3 * of_shear);
}

TEST_CASE("errors of the kernel are bounds beside the noise", "[models]") {
  const ReadArray array = read_array(3, 3, false);
  const Frames frames = random_frames(array, 5, 1e3, 1e-9);
  const LoadReader reader(array, in_order(array), 9,
                          {.noise_V = 1e-9, .own_model = 0.01, .other_model = 0.001}, {},
                          frames.view());
  const Found found = read_with(reader, frames);
  for (Eigen::Index f = 0; f < 5; ++f) {
    const double largest_Pa = found.loads_Pa.col(f).cwiseAbs().maxCoeff();
    CHECK(found.half_widths_Pa(4, f) ==
          Approx(0.01 * std::abs(found.loads_Pa(4, f)) + 0.001 * largest_Pa).epsilon(1e-3));
  }
}

TEST_CASE("a blurred kernel is resolved no finer than it blurs", "[models]") {
  ReadArray array = read_array(15, 15, false);
  array.reach_m = 4.5 * kPitch_m;
  array.kernel = [](int, double x_m, double y_m) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Constant(
        1, 1, std::exp(-(x_m * x_m + y_m * y_m) / (2.25 * kPitch_m * kPitch_m)));
  };
  const std::vector<double> frame(225, 1.0);
  const auto reader_with = [&](double weight) {
    return LoadReader(array, in_order(array), 225, {.noise_V = 0.1}, {.weight = weight},
                      {frame.data(), 1});
  };
  const LoadReader noisy = reader_with(3.0), clean = reader_with(1e-6);
  CHECK(noisy.condition() > 10.0);
  CHECK(noisy.resolution_m()[112] > kPitch_m);
  CHECK_FALSE(noisy.is_resolved(112, 0));
  CHECK(clean.resolution_m()[112] < 0.75 * kPitch_m);
  CHECK(clean.is_resolved(112, 0));
}

TEST_CASE("noise that is not stated is not taken from loads", "[models]") {
  const ReadArray array = read_array(3, 3, false);
  const Frames frames = random_frames(array, 5, 1e3, 1e-5);
  CHECK_THROWS_WITH(
      LoadReader(array, in_order(array), 9, {}, {.penalty = Penalty::kSize}, frames.view()),
      Catch::Contains("state the noise"));
}

}  // namespace
}  // namespace viscard
