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

TEST_CASE("a film may end with the electrodes of the outer pillars", "[array]") {
  const double half_width_m = GENERATE(20e-6, 24e-6);
  const ArrayElectrodes electrodes{half_width_m < 22e-6 ? FilmFace::kTop : FilmFace::kBottom,
                                   half_width_m, true};
  const Discretisation mesh{.degree = 4, .layers = 4};
  const auto voltages = [&](double beyond_m, int count) {
    const ArrayModel row(
        {.count = count, .spacing_m = 20e-6, .film_edge_m = half_width_m - 20e-6 + beyond_m},
        electrodes, seed_media(), mesh);
    return array_answer(row, ArrayLoad::kPressure, Eigen::VectorXd::Ones(count)).electrode_V;
  };
  const Eigen::VectorXd cut = voltages(0.0, 3);
  CHECK(cut[0] == Approx(cut[2]).epsilon(1e-9));
  CHECK(std::abs(cut[0]) > 1.05 * std::abs(cut[1]));  // less film short-circuits the outer ones
  // 10 nm of film more hardly matters.
  CHECK((cut - voltages(10e-9, 3)).norm() < 1e-3 * cut.norm());
  CHECK(voltages(0.0, 1)[0] == Approx(voltages(10e-9, 1)[0]).epsilon(1e-3));
}

TEST_CASE("electrodes as wide as their pillars have the symmetry of the row", "[array]") {
  const ArrayModel row({.count = 3, .spacing_m = 20e-6}, {.is_equipotential = true}, seed_media(),
                       {.degree = 5, .layers = 5});
  const ArrayResponse r = array_response(row, ArrayLoad::kPressure);
  CHECK((r.electrode_V - r.electrode_V.reverse()).norm() < 1e-9 * r.electrode_V.norm());
}

TEST_CASE("the answer to all loads is the sum of the responses to each", "[array]") {
  const bool is_equipotential = GENERATE(false, true);
  const ArrayLoad load = GENERATE(ArrayLoad::kPressure, ArrayLoad::kShear);
  const ArrayModel row({.count = 4, .spacing_m = 12e-6}, {.is_equipotential = is_equipotential},
                       seed_media(), {.degree = 4, .layers = 3});
  const Eigen::Vector4d load_Pa(1.0, 0.0, -2.5, 3.0);
  const ArrayAnswer answer = array_answer(row, load, load_Pa);
  const ArrayResponse r = array_response(row, load);
  const auto same = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    CHECK(a.size() == b.size());
    CHECK((a - b).norm() <= 1e-9 * b.norm());
  };
  same(answer.top_m, r.top_m * load_Pa);
  same(answer.midway_V, r.midway_V * load_Pa);
  const Eigen::MatrixXd& single = is_equipotential ? r.electrode_V : r.centre_V;
  same(is_equipotential ? answer.electrode_V : answer.centre_V, single * load_Pa);
  if (is_equipotential) {
    same(r.V_per_C * answer.electrode_C, -(r.electrode_V * load_Pa));
  } else {
    same(answer.mean_V, r.mean_V * load_Pa);
  }
  for (int i = 0; i < 4; ++i) {
    CHECK(own_V_per_Pa(row, load, i) ==
          Approx(single(i, i)).epsilon(1e-9).margin(1e-10 * single.norm()));
  }
}

TEST_CASE("a long row takes work in proportion to its pillars", "[array]") {
  struct Work {
    int factors = 0;
    long joints = 0;
  };
  const auto work_of = [](int count) {
    const ArrayModel row({.count = count, .spacing_m = 20e-6}, {}, seed_media(),
                         {.degree = 4, .layers = 2});
    array_answer(row, ArrayLoad::kPressure, Eigen::VectorXd::Ones(count));
    for (int i = 0; i < count; ++i) own_V_per_Pa(row, ArrayLoad::kPressure, i);
    return Work{row.chain().factors(), row.chain().solved_joints()};
  };
  const Work some = work_of(100);
  const Work many = work_of(1000);
  CHECK(many.factors == some.factors);  // of 201 and 2001 joints
  CHECK(many.factors < 60);
  CHECK(many.joints < 11 * some.joints);
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
  // Lengths of a file that agree to nine digits.
  CHECK_NOTHROW(validate({.count = 1, .diameter_m = 0.6e-6, .film_edge_m = 0.1e-6},
                         {.half_width_m = 0.4e-6 * (1.0 + 1e-12)}));
}
