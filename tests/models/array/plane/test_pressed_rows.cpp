// Rows of strips under rigid shapes: forces, moments and voltages beside another program's.
#include "models/answer/scene_mistake.h"
#include "models/array/plane/pressed_row.h"
#include "models/array/plane/simulate_array.h"
#include "tests/models/array/plane/pressed_rows.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

double value_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one.value;
  }
  throw std::runtime_error("no result " + name);
}

// Of the four pillars on the right, at 50, 150, 250 and 350 um from the middle.
struct ChapterEight {
  const char* name;
  bool feels_contact;
  Friction friction;
  std::vector<double> force_N_m, moment_uN, shear_N_m, centre_mV, mean_mV;
};

// One strip on a rigid base, condensed to its top, and voltages by the film's Green's function from its
// foot forces: a program of p-elements and Fourier integrals of its own.
const std::vector<ChapterEight>& chapter_eight() {
  static const std::vector<ChapterEight> kRows = {{"followed, sliding",
                                                   false,
                                                   Friction::kNone,
                                                   {5.81196, 4.15925, 0.85009, -4.12301},
                                                   {-1.0984, -3.2976, -5.5043, -7.7236},
                                                   {},
                                                   {-599.116, -428.777, -87.631, 425.098},
                                                   {-532.430, -381.027, -77.790, 377.247}},
                                                  {"followed, sticking",
                                                   false,
                                                   Friction::kStick,
                                                   {5.83949, 4.17862, 0.85312, -4.14455},
                                                   {-3.5684, -10.713, -17.882, -25.092},
                                                   {},
                                                   {-602.405, -431.225, -88.364, 427.857},
                                                   {-535.400, -383.250, -78.482, 379.750}},
                                                  {"contact, frictionless",
                                                   true,
                                                   Friction::kNone,
                                                   {5.81196, 4.15925, 0.85055, 0.0},
                                                   {-1.0984, -3.2976, -5.4958, 0.0},
                                                   {},
                                                   {-599.115, -428.745, -87.592, 0.097},
                                                   {-532.429, -380.993, -78.002, 0.065}},
                                                  {"contact, sticking",
                                                   true,
                                                   Friction::kStick,
                                                   {5.83949, 4.17862, 0.96617, 0.0},
                                                   {-3.5684, -10.713, -13.19, 0.0},
                                                   {0.0411, 0.1235, 0.1526, 0.0},
                                                   {-602.398, -431.013, -99.19, 0.48},
                                                   {-535.392, -383.036, -88.26, 0.43}}};
  return kRows;
}

}  // namespace

TEST_CASE("eight strips under the profile of chapter 8 bear and read what the reference does",
          "[array][contact]") {
  for (const ChapterEight& row : chapter_eight()) {
    ArrayScene scene = pressed_row(cylinder(10e-6, row.friction));
    scene.feels_contact = row.feels_contact;
    const SceneAnswer on_film = simulate_array(scene);
    scene.feels_film = false;  // forces of the reference are those on a rigid base
    const SceneAnswer on_rigid = simulate_array(scene);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string number = "_" + std::to_string(5 + i);
      INFO(row.name << number);
      // The third top is touched in part: 2e-3.
      const double share = row.feels_contact && i == 2 ? 2e-3 : 1e-4;
      CHECK(value_of(on_rigid, "pillar_force" + number) ==
            Approx(row.force_N_m[i]).epsilon(share).margin(1e-9));
      CHECK(value_of(on_rigid, "moment" + number) ==
            Approx(1e-6 * row.moment_uN[i]).epsilon(share).margin(1e-15));
      // The film takes 1.05e-4 of a pillar's way.
      CHECK(value_of(on_film, "pillar_force" + number) ==
            Approx(row.force_N_m[i]).epsilon(share + 1.1e-4).margin(1e-9));
      CHECK(value_of(on_film, "centre_voltage" + number) ==
            Approx(1e-3 * row.centre_mV[i]).epsilon(share + 1.1e-4).margin(599e-7));
      CHECK(value_of(on_film, "mean_voltage" + number) ==
            Approx(1e-3 * row.mean_mV[i]).epsilon(share + 1.1e-4).margin(532e-7));
      if (row.shear_N_m.empty() || row.friction == Friction::kNone) continue;
      CHECK(value_of(on_rigid, "shear_force" + number) ==
            Approx(row.shear_N_m[i]).epsilon(2e-3).margin(1e-9));
    }
  }
}

TEST_CASE("strips in plane strain and a shallow profile agree with the reference",
          "[array][contact]") {
  const SceneAnswer strain = simulate_array(pressed_row(cylinder(10e-6), 8, PlaneState::kStrain));
  const SceneAnswer shallow = simulate_array(pressed_row(cylinder(1e-6)));
  const auto agrees = [](const SceneAnswer& answer, const std::string& name, double value,
                         double share, double margin) {
    INFO(name);
    CHECK(value_of(answer, name) == Approx(value).epsilon(share).margin(margin));
  };
  agrees(strain, "pillar_force_5", 6.55868, 2e-4, 0.0);
  agrees(strain, "pillar_force_6", 4.69363, 2e-4, 0.0);
  agrees(strain, "pillar_force_7", 0.9598, 2e-3, 0.0);
  agrees(strain, "pillar_force_8", 0.0, 0.0, 1e-9);
  agrees(strain, "centre_voltage_5", -0.59058, 2e-4, 0.0);
  agrees(strain, "centre_voltage_6", -0.42290, 2e-4, 0.0);
  agrees(strain, "centre_voltage_7", -0.08441, 2e-3, 0.0);
  agrees(shallow, "pillar_force_5", 0.38543, 2e-4, 0.0);
  agrees(shallow, "pillar_force_6", 0.0, 0.0, 1e-9);
  agrees(shallow, "centre_voltage_5", -0.039744, 2e-4, 0.0);
  agrees(simulate_array(pressed_row(cylinder(10e-6))), "contact_force", 21.6435, 2e-4, 0.0);
}

TEST_CASE("one strip that is touched in part bears what uniform grids converge to",
          "[array][contact]") {
  struct Partial {
    RigidShape shape;
    double force_N_m, moment_N, width_m, share, of_width_m;
  };
  RigidShape inclined{.kind = ShapeKind::kPlane, .table = {}};
  inclined.tilt_x = -0.1;  // deeper to the right
  const Partial cases[] = {
      {inclined, 0.6360, 7.539e-6, 22.05e-6, 1e-3, 0.3e-6},
      {{.kind = ShapeKind::kCylinder, .radius_m = 100e-6, .table = {}},
       0.4648,
       0.0,
       11.36e-6,
       2e-3,
       0.3e-6},
      // Its pressure is singular at the edge: the error falls as the elements.
      {{.kind = ShapeKind::kEdge, .table = {}}, 0.455, 1.82e-6, 15.4e-6, 5e-3, 0.3e-6}};
  for (const Partial& one : cases) {
    INFO("kind " << static_cast<int>(one.shape.kind));
    ArrayScene scene = pressed_row({.shape = one.shape, .depth_m = 1e-6}, 1);
    scene.feels_film = false;  // the reference stands on a rigid base
    const RowContact fine = row_contact_on(scene, 3);
    CHECK(fine.tops[0].force_N_m == Approx(one.force_N_m).epsilon(one.share));
    CHECK(fine.tops[0].moment_N ==
          Approx(one.moment_N).epsilon(2.0 * one.share).margin(1e-9 * 40e-6));
    CHECK(40e-6 * fine.tops[0].share == Approx(one.width_m).margin(one.of_width_m));
    // Coarser grids err by less than they claim, but for a fiftieth of the tolerance.
    const RowContact coarse = row_contact_within(scene, 1.0);
    CHECK(std::abs(coarse.tops[0].force_N_m - fine.tops[0].force_N_m) <=
          coarse.top_changes[0].force_N_m + 0.02 * scene.tolerance * one.force_N_m);
  }
}

TEST_CASE("a row under a shape obeys symmetry, scale and its own force", "[array][contact]") {
  const Friction friction = GENERATE(Friction::kNone, Friction::kStick);
  ArrayScene scene = pressed_row(cylinder(6e-6, friction), 5);
  scene.press->shape.x_m = 0.0;
  const RowContact row = row_contact_on(scene, 0);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(row.tops[i].force_N_m == Approx(row.tops[4 - i].force_N_m).epsilon(1e-9));
    CHECK(row.tops[i].moment_N == Approx(-row.tops[4 - i].moment_N).epsilon(1e-8).margin(1e-13));
    CHECK(row.tops[i].shear_N_m == Approx(-row.tops[4 - i].shear_N_m).epsilon(1e-8).margin(1e-8));
  }
  ArrayScene stiffer = scene;
  stiffer.feels_film = scene.feels_film = false;
  stiffer.pillar.E0_Pa *= 3.0;
  const RowContact soft = row_contact_on(scene, 0), stiff = row_contact_on(stiffer, 0);
  CHECK(stiff.force_N_m == Approx(3.0 * soft.force_N_m).epsilon(1e-10));
  ArrayScene by_force = scene;
  by_force.press->force_N = soft.force_N_m;
  by_force.press->depth_m = 0.0;
  const RowContact again = row_contact_on(by_force, 0);
  CHECK(again.depth_m == Approx(6e-6).epsilon(1e-10));
  CHECK(again.tops[2].force_N_m == Approx(soft.tops[2].force_N_m).epsilon(1e-9));
  // Each strip on a rigid base is alone.
  ArrayScene one = scene;
  one.geometry.count = 1;
  CHECK(row_contact_on(one, 0).tops[0].force_N_m == Approx(soft.tops[2].force_N_m).epsilon(1e-12));
  double last_N_m = 0.0;
  for (const double depth_m : {0.5e-6, 1e-6, 2e-6, 4e-6, 6e-6}) {
    scene.press->depth_m = depth_m;
    const double force_N_m = row_contact_on(scene, 0).force_N_m;
    CHECK(force_N_m > last_N_m);
    last_N_m = force_N_m;
  }
}

TEST_CASE("a level plane on a row is a uniform load, and a shape beside it none",
          "[array][contact]") {
  const ShapePress plane{.shape = {.kind = ShapeKind::kPlane, .table = {}}, .depth_m = 1e-6};
  const ArrayScene scene = pressed_row(plane, 3);
  const SceneAnswer answer = simulate_array(scene);
  // 6.6341e-11 m/Pa of the strip, by another program, and 1.05e-4 of it of the film.
  const double pressure_Pa = value_of(answer, "largest_pressure");
  CHECK(pressure_Pa == Approx(1e-6 / 6.6341e-11).epsilon(1.5e-4));
  // In plane strain 5.8788e-11 m/Pa: 6.8042e5 N/m2 for a strip of 40 um.
  const SceneAnswer strain = simulate_array(pressed_row(plane, 1, PlaneState::kStrain));
  CHECK(value_of(strain, "contact_force") == Approx(1e-6 * 6.8042e5).epsilon(1.5e-4));
  CHECK(value_of(answer, "centre_voltage_2") ==
        Approx(-4.12321e-6 * pressure_Pa).epsilon(2e-3));  // and neighbours, 0.16 %
  ArrayScene beside = pressed_row(cylinder(1e-6), 3);
  beside.press->shape.x_m = 2e-3;
  const SceneAnswer none = simulate_array(beside);
  for (const SceneResult& one : none.results) {
    if (one.name == "depth") continue;
    INFO(one.name);
    CHECK(one.value == 0.0);
  }
  CHECK(none.notes.front().find("touches no pillar") != std::string::npos);
}

TEST_CASE("strips let go at Kendall's force and show the way that the shape went",
          "[array][contact]") {
  // sqrt(pi E w d): a crack at the edge of a rigid punch in plane stress.
  const double limit_N_m = std::sqrt(3.14159265358979 * 1.8e6 * 0.04 * 40e-6);
  ArrayScene scene = pressed_row(cylinder(0.0, Friction::kNone, 50e-3), 4);
  scene.feels_film = false;
  scene.press->work_of_adhesion_J_m2 = 0.04;
  scene.press->before_m = {3e-6};
  const auto at = [&](double depth_m) {
    scene.press->depth_m = depth_m;
    return row_contact_on(scene, 0);
  };
  const double release_m = at(0.0).tops[1].release_m;
  CHECK(at(release_m + 1e-12).tops[1].force_N_m == Approx(-limit_N_m).epsilon(1e-5));
  CHECK(at(release_m - 1e-12).tops[1].force_N_m == 0.0);
  // Pulled columns stretch by the pull over the mean-gap stiffness 6.0295e5 N/m2.
  const double gap_m = (50e-6 * 50e-6 + 40e-6 * 40e-6 / 12.0) / 100e-3;
  CHECK(gap_m - release_m == Approx(limit_N_m / 6.0295e5).epsilon(1e-4));
  // The same depth on the way down and on the way back: hysteresis above the tops.
  const double back_N_m = at(-0.5e-6).force_N_m;
  CHECK(back_N_m < 0.0);
  scene.press->before_m.clear();
  scene.press->depth_m = 0.5e-6;
  const double down_N_m = row_contact_on(scene, 0).force_N_m;
  scene.press->before_m = {3e-6};
  CHECK(at(0.5e-6).force_N_m <= down_N_m);
  // Touched again, a top that let go is held again.
  scene.press->before_m = {3e-6, -20e-6, 3e-6};
  CHECK(at(-0.5e-6).force_N_m == Approx(back_N_m).epsilon(1e-12));
}

TEST_CASE("mistakes of a shape over a row are refused by name", "[array][contact]") {
  const auto refused = [](const ArrayScene& scene) {
    try {
      check_row_press(scene);
    } catch (const SceneMistake& mistake) {
      return std::string(mistake.key());
    }
    return std::string();
  };
  const ArrayScene good = pressed_row(cylinder(1e-6));
  CHECK(refused(good).empty());
  ArrayScene scene = good;
  scene.drive = RowModal{};
  CHECK(refused(scene) == "analysis.kind");
  scene = good;
  scene.load_Pa = 1e3;
  CHECK(refused(scene) == "analysis.load");
  scene = good;
  scene.geometry.ends = FilmEnds::kMirror;
  CHECK(refused(scene) == "geometry.film.ends");
  scene = good;
  scene.press->shape.tilt_y = 0.01;
  CHECK(refused(scene) == "shape");
  scene = good;
  scene.press->depth_m = 0.0;
  CHECK(refused(scene) == "shape");
  scene.press->depth_m = 130e-6;
  CHECK(refused(scene) == "shape.depth");
  scene = good;
  scene.press->before_m = {2e-6};
  CHECK(refused(scene) == "shape.before");
  scene = good;
  scene.press->work_of_adhesion_J_m2 = 0.04;
  scene.press->depth_m = 0.0;
  scene.press->force_N = 1.0;
  CHECK(refused(scene) == "shape.force");
  scene = pressed_row({.shape = {.kind = ShapeKind::kEdge, .table = {}}, .depth_m = 1e-6});
  scene.feels_contact = false;
  CHECK(refused(scene) == "effects.contact");
}
