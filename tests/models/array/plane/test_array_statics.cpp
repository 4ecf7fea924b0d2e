#include "models/array/plane/array_statics.h"
#include "models/pillar/body/piezo_static.h"
#include "tests/models/array/plane/seed_array.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("a row of one pillar equals the solver of one pillar", "[array]") {
  const PlaneState plane = GENERATE(PlaneState::kStress, PlaneState::kStrain);
  const bool is_equipotential = GENERATE(false, true);
  const FilmFace grounded = GENERATE(FilmFace::kTop, FilmFace::kBottom);
  CAPTURE(is_equipotential, grounded == FilmFace::kTop);
  const ArrayMedia media = seed_media(plane);
  const Discretisation fine{.degree = 6, .layers = 3};
  const ArrayModel array({.count = 1, .film_edge_m = 60e-6},
                         {.grounded = grounded, .is_equipotential = is_equipotential}, media, fine);
  const ArrayResponse response = array_response(array, ArrayLoad::kPressure);

  const PillarGeometry geometry{40e-6, 120e-6, FilmGeometry{25e-6, 80e-6}};
  const Discretisation single{.degree = 6, .layers = 3, .film_elements = 2};
  ModelOptions options{.motion = Motion::kPlaneSymmetric, .plane = plane};
  options.electrodes = ElectrodeOptions{grounded, is_equipotential ? 20e-6 : 0.0};
  const PillarModel pillar(geometry, single, {media.pillar, media.film}, options);
  // The meshes differ; the other is not graded toward an electrode edge on the bottom.
  const double digits = is_equipotential ? 3e-3 : 1e-4;
  if (is_equipotential) {
    const PiezoAnswer answer = piezo_static(pillar, 1.0);
    CHECK(response.electrode_V(0, 0) == Approx(answer.voltage_V).epsilon(digits));
    CHECK(1.0 / response.V_per_C(0, 0) == Approx(answer.capacitance_F).epsilon(digits));
    CHECK(response.top_m(0, 0) == Approx(answer.top_displacement_m).epsilon(1e-6));
  } else {
    const PillarState state = piezo_sampled(pillar, 1.0);
    const double z = grounded == FilmFace::kTop ? -25e-6 : 0.0;
    CHECK(response.centre_V(0, 0) == Approx(potential_at_V(pillar, state, 0.0, z)).epsilon(digits));
  }
}

TEST_CASE("three pillars between mirrors, all loaded, respond as one does", "[array]") {
  ArrayGeometry row = endless_row(30e-6);
  const ArrayResponse one = seed_response(row);
  row.count = 3;
  const ArrayResponse three = seed_response(row);
  for (int i = 0; i < 3; ++i) {
    // Same elements, other arithmetic: the difference is rounding.
    CHECK(three.centre_V.row(i).sum() == Approx(one.centre_V(0, 0)).epsilon(1e-9));
    CHECK(three.midway_V.row(i).sum() == Approx(one.midway_V(0, 0)).epsilon(1e-9));
    CHECK(three.mean_V.row(i).sum() == Approx(one.mean_V(0, 0)).epsilon(1e-9));
  }
}

TEST_CASE("responses of a row are reciprocal and mirror-symmetric", "[array]") {
  const bool is_equipotential = GENERATE(false, true);
  const ArrayModel model({.count = 5, .spacing_m = 20e-6},
                         {.half_width_m = 26e-6, .is_equipotential = is_equipotential},
                         seed_media(), {.degree = 4, .layers = 2});
  const ArrayResponse r = array_response(model, ArrayLoad::kPressure);
  CHECK((r.top_m - r.top_m.transpose()).norm() < 1e-11 * r.top_m.norm());
  CHECK((r.top_m - r.top_m.reverse()).norm() < 1e-11 * r.top_m.norm());
  const Eigen::MatrixXd& V = is_equipotential ? r.electrode_V : r.mean_V;
  CHECK((V - V.reverse()).norm() < 1e-9 * V.norm());
  if (is_equipotential) {
    CHECK((r.V_per_C - r.V_per_C.transpose()).norm() < 1e-10 * r.V_per_C.norm());
    // Capacitances to ground are positive and those between neighbours negative (Maxwell's matrix).
    const Eigen::MatrixXd C = r.V_per_C.inverse();
    CHECK(C.diagonal().minCoeff() > 0.0);
    CHECK(C.diagonal(1).maxCoeff() < 0.0);
  }
}

TEST_CASE("an electrode wider than the pillar reads the same on different cells", "[array]") {
  // A reading of the same width on the same face, once with cells that end at the rim and once with
  // cells that reach beyond it.
  const ArrayGeometry row{.count = 2, .spacing_m = 30e-6};
  const Discretisation fine{.degree = 6, .layers = 3};
  const auto centres = [&](double half_width_m) {
    const ArrayModel model(row, {.half_width_m = half_width_m}, seed_media(), fine);
    return array_response(model, ArrayLoad::kPressure).centre_V;
  };
  const Eigen::MatrixXd at_rim = centres(20e-6);
  const Eigen::MatrixXd beyond = centres(23e-6);
  CHECK((at_rim - beyond).norm() < 2e-5 * at_rim.norm());  // both within 1e-5 at this degree
}

TEST_CASE("rows of pillars refuse impossible geometry", "[array]") {
  const auto refused = [](const ArrayGeometry& g, const ArrayElectrodes& e, const char* word) {
    CHECK_THROWS_WITH(validate(g, e), Catch::Contains(word));
  };
  refused({.count = 0}, {}, "between 1 and 4096");
  refused({.spacing_m = 0.0}, {}, "overlap");
  refused({.spacing_m = std::nan("")}, {}, "spacing");
  refused({.film_thickness_m = -1e-6}, {}, "thickness");
  refused({.spacing_m = 10e-6}, {.half_width_m = 26e-6}, "overlap");
  refused({.film_edge_m = 2e-6}, {.half_width_m = 25e-6}, "outside the film");
  CHECK_NOTHROW(validate({.count = 1, .film_edge_m = 0.0}, {}));
}
