#include "models/array/plane/array_modes.h"
#include "models/array/plane/row_shapes.h"
#include "models/pillar/body/pillar_modes.h"
#include "tests/models/array/plane/seed_array.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace viscard;
using namespace viscard::test;

namespace {

std::vector<ArrayMode> modes_of(const ArrayGeometry& geometry, int clusters, PlaneState plane,
                                bool is_lateral) {
  ArrayMedia media = seed_media(plane);
  const ArrayModel model(geometry, {}, media, {.degree = 6, .layers = 2},
                         {.modes = inertia_ports_for(clusters)});
  std::vector<ArrayMode> modes = array_modes(model, clusters);
  CHECK(film_inertia_error(model, media, modes) < 1e-6);
  std::erase_if(modes, [&](const ArrayMode& m) { return m.is_lateral != is_lateral; });
  return modes;
}

}  // namespace

TEST_CASE("modes of a row of one pillar equal those of the pillar solver", "[array]") {
  const PlaneState plane = GENERATE(PlaneState::kStress, PlaneState::kStrain);
  const bool is_lateral = GENERATE(true, false);
  const std::vector<ArrayMode> row =
      modes_of({.count = 1, .film_edge_m = 40e-6}, 4, plane, is_lateral);
  const ArrayMedia media = seed_media(plane);
  Medium film = isotropic_medium(2e9, 0.29, 1780.0);
  const PillarModel pillar(
      {40e-6, 120e-6, FilmGeometry{25e-6, 60e-6}}, {.degree = 6, .layers = 2}, {media.pillar, film},
      {.motion = is_lateral ? Motion::kPlaneAntisymmetric : Motion::kPlaneSymmetric,
       .plane = plane});
  const std::vector<PillarMode> single = lowest_modes(pillar, 4);
  REQUIRE(row.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k);
    // Meshes of one degree, and a film stiffened by its charge: some 1e-5 of the film's 2e-4.
    CHECK(row[k].frequency_Hz == Approx(single[k].frequency_Hz).epsilon(2e-5));
  }
}

TEST_CASE("modes of the seed's row come in clusters of eight", "[array]") {
  const ArrayGeometry eight{.count = 8};
  const std::vector<double> printed_Hz = {17962.0, 82045.0};
  const std::vector<ArrayMode> lateral = modes_of(eight, 2, PlaneState::kStress, true);
  REQUIRE(lateral.size() == 16);
  for (std::size_t cluster = 0; cluster < 2; ++cluster) {
    const double low = lateral[8 * cluster].frequency_Hz;
    const double high = lateral[8 * cluster + 7].frequency_Hz;
    CAPTURE(cluster, low, high);
    CHECK(high / low - 1.0 < 1e-5);
    CHECK(low == Approx(printed_Hz[cluster]).epsilon(6e-4));  // the thesis' mesh is stiffer
  }
  const std::vector<ArrayMode> axial = modes_of(eight, 2, PlaneState::kStress, false);
  CHECK(axial[7].frequency_Hz / axial[0].frequency_Hz - 1.0 < 1e-5);
  CHECK(axial[0].frequency_Hz == Approx(90321.0).epsilon(2e-4));
  CHECK(axial[8].frequency_Hz == Approx(2.68e5).epsilon(2e-3));  // printed with three digits
}

TEST_CASE("neighbours at 20 um split the clusters as in an independent code", "[array]") {
  // Reference: plane p-elements of the whole array, film elastic, 10 um of film beyond the ends.
  ArrayMedia media = seed_media();
  media.film = isotropic_medium(2e9, 0.29, 1780.0);
  const ArrayModel model({.count = 8, .spacing_m = 20e-6, .film_edge_m = 10e-6}, {}, media,
                         {.degree = 6, .layers = 2}, {.modes = inertia_ports_for(2)});
  std::vector<ArrayMode> modes = array_modes(model, 2);
  const auto is_axial = std::stable_partition(modes.begin(), modes.end(),
                                              [](const ArrayMode& m) { return m.is_lateral; });
  CHECK(modes[0].frequency_Hz == Approx(17952.8).epsilon(2e-5));
  CHECK(modes[7].frequency_Hz - modes[0].frequency_Hz < 0.3);  // prints one decimal
  CHECK(modes[8].frequency_Hz == Approx(82000.5).epsilon(2e-5));
  CHECK(modes[15].frequency_Hz == Approx(82003.9).epsilon(2e-5));
  CHECK(is_axial->frequency_Hz == Approx(90306.3).epsilon(2e-5));
  CHECK((is_axial + 7)->frequency_Hz == Approx(90306.8).epsilon(2e-5));
}

TEST_CASE("pillars of a symmetric row move in symmetric and antisymmetric modes", "[array]") {
  const int count = GENERATE(2, 5);
  const bool is_lateral = GENERATE(true, false);
  const std::vector<ArrayMode> modes =
      modes_of({.count = count, .spacing_m = 10e-6}, 1, PlaneState::kStress, is_lateral);
  REQUIRE(modes.size() == static_cast<std::size_t>(count));
  int symmetric = 0;
  for (const ArrayMode& mode : modes) {
    CAPTURE(count, is_lateral, mode.frequency_Hz, mode.top.transpose());
    CHECK(mode.top.maxCoeff() == Approx(1.0).epsilon(2e-6));
    CHECK(mode.top.minCoeff() > -1.0 - 2e-6);
    const Eigen::VectorXd mirrored = mode.top.reverse();
    const double sign = mode.top.dot(mirrored) > 0.0 ? 1.0 : -1.0;
    CHECK((mode.top - sign * mirrored).cwiseAbs().maxCoeff() < 1e-4);
    symmetric += sign > 0.0 ? 1 : 0;
    CHECK(mode.amplitude.squaredNorm() == Approx(1.0).epsilon(1e-12));
    for (const ArrayMode& other : modes) {  // orthogonal under the mass, other modes take part
      if (&other == &mode) continue;
      CHECK(std::abs((mode.amplitude.array() * other.amplitude.array()).sum()) < 1e-12);
      CHECK(std::abs(mode.top.dot(other.top)) < 1e-2 * mode.top.norm() * other.top.norm());
    }
  }
  CHECK(symmetric == (count + 1) / 2);
}

TEST_CASE("the outline of a pillar moves as its top does", "[array]") {
  ArrayScene scene = seed_scene();
  scene.geometry = {.count = 3, .spacing_m = 20e-6};
  scene.drive = RowModal{.modes = 2};
  scene.feels_film = GENERATE(true, false);
  scene.feels_neighbours = scene.feels_film && GENERATE(true, false);
  const RowShapes shapes = row_shapes(scene, {.degree = 6, .layers = 2});
  REQUIRE(shapes.modes.size() == 12);  // two families, two clusters, three pillars
  const std::size_t places = shapes.outline_m.size();
  CHECK(shapes.outline_m.front() == std::pair(-20e-6, 0.0));
  CHECK(shapes.outline_m.back() == std::pair(20e-6, 0.0));
  for (const RowShape& shape : shapes.modes) {
    const int axis = shape.family == "lateral" ? 0 : 1;
    CAPTURE(shape.family, shape.cluster, shape.top.transpose());
    REQUIRE(shape.outline.rows() == static_cast<Eigen::Index>(2 * places));
    // The mean over the top, by the trapezoidal rule, in proportion to that of the answer.
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(3);
    double largest = 0.0;
    for (std::size_t k = 0; k < places; ++k) {
      const auto row = static_cast<Eigen::Index>(2 * k);
      for (int i = 0; i < 3; ++i) {
        largest = std::max(largest, shape.outline.block(row, i, 2, 1).norm());
      }
      const bool is_top = k + 1 < places && shapes.outline_m[k].second > 119.99e-6 &&
                          shapes.outline_m[k + 1].second > 119.99e-6;
      if (!is_top) continue;
      const double width_m = shapes.outline_m[k + 1].first - shapes.outline_m[k].first;
      mean += 0.5 * width_m / 40e-6 *
              (shape.outline.row(row + axis) + shape.outline.row(row + 2 + axis)).transpose();
    }
    CHECK(largest == Approx(1.0).epsilon(1e-12));
    CHECK(shape.outline.topRows(2).norm() == 0.0);
    Eigen::Index most = 0;
    shape.top.cwiseAbs().maxCoeff(&most);
    CHECK(mean[most] * shape.top[most] > 0.0);
    for (int i = 0; i < 3; ++i) {  // modes left out: below 1 % of the motion of the top
      CHECK(mean[i] == Approx(mean[most] * shape.top[i] / shape.top[most]).margin(1e-2));
    }
  }
}

TEST_CASE("shapes of a cluster share the row between the pillars", "[array]") {
  const std::vector<ArrayMode> modes = modes_of({.count = 5}, 1, PlaneState::kStress, true);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(5);
  for (const ArrayMode& mode : modes) {
    CHECK(mode.share.sum() == Approx(1.0).epsilon(1e-12));
    sum += mode.share;
  }
  for (int i = 0; i < 5; ++i) CHECK(sum[i] == Approx(1.0).margin(1e-3));  // other modes take part
}

TEST_CASE("shapes that a load on a pillar excites are symmetric or antisymmetric about its axis",
          "[array]") {
  // Motions of the base have both kinds, so that rounding errors of the other kind would grow.
  const int load_port = GENERATE(kPressurePort, kShearPort);
  const ArrayModel model({.count = 1}, {}, seed_media(),
                         {.degree = 7, .layers = 3, .shaft_elements = 4},
                         {.waves = 48, .load_port = load_port});
  const Eigen::MatrixXd& motion = model.pillar().mode_on_outline;
  const Eigen::Index places = motion.rows() / 2;
  for (Eigen::Index shape = 0; shape < motion.cols(); ++shape) {
    double symmetric = 0.0, antisymmetric = 0.0;
    for (Eigen::Index left = 0; left < places; ++left) {
      const Eigen::Index right = places - 1 - left;
      const Eigen::Vector2d own = motion.block<2, 1>(2 * left, shape);
      const Eigen::Vector2d mirrored(-motion(2 * right, shape), motion(2 * right + 1, shape));
      symmetric += (own + mirrored).squaredNorm();
      antisymmetric += (own - mirrored).squaredNorm();
    }
    CAPTURE(load_port, shape);
    CHECK(std::min(symmetric, antisymmetric) < 1e-12 * (symmetric + antisymmetric));
  }
}
