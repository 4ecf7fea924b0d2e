// Fields for ParaView, and pictures of them.
#include "io/pictures/picture_numbers.h"
#include "io/pictures/section_picture.h"
#include "io/scenes/scene_file.h"
#include "models/scene/simulate.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

using namespace viscard;

namespace {

const Discretisation kMesh{.degree = 4, .layers = 2};

PillarScene pressed_pillar() {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.drive = StaticDrive{.pressure_Pa = 1e4};
  return scene;
}

PillarScene sensor() {
  PillarScene scene = pressed_pillar();
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << 23e-12, 23e-12, -33e-12, 0, 0, 0;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.film_charge_C_N = d;
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  return scene;
}

const SectionField& field_of(const SectionGrid& grid, const std::string& name) {
  for (const SectionField& field : grid.fields) {
    if (field.name == name) return field;
  }
  throw std::runtime_error("no field " + name);
}

// The numbers of one array of a .vtu file.
std::vector<double> array_of(const std::string& vtu, const std::string& name) {
  const std::size_t tag = vtu.find("Name=\"" + name + "\"");
  REQUIRE(tag != std::string::npos);
  const std::size_t from = vtu.find('>', tag) + 1;
  std::istringstream text(vtu.substr(from, vtu.find('<', from) - from));
  std::vector<double> values;
  for (double value; text >> value;) values.push_back(value);
  return values;
}

}  // namespace

TEST_CASE("the field of a pressed pillar holds its top displacement and its equilibrium",
          "[pillar][io]") {
  const std::vector<SectionGrid> grids = solution_fields(pressed_pillar(), kMesh);
  REQUIRE(grids.size() == 1);
  const SectionGrid& grid = grids[0];
  const SectionField& u = field_of(grid, "displacement_m");
  double top = 0.0;
  for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
    if (grid.z_m[i] > 119.999e-6) top = std::min(top, u.value[i][2]);
    if (grid.z_m[i] == 0.0) CHECK(std::abs(u.value[i][2]) < 1e-15);
  }
  CHECK(top == Approx(-659.7e-9).epsilon(1e-3));  // of this mesh
  const SectionField& stress = field_of(grid, "stress_zz_Pa");
  for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
    const bool is_mid_height = std::abs(grid.z_m[i] - 100e-6) < 5e-6;
    if (is_mid_height) CHECK(stress.value[i][0] == Approx(-1e4).epsilon(2e-3));  // Saint-Venant
  }
}

TEST_CASE(
    "the potential of the field is the electrode's voltage on the electrode and zero on "
    "ground",
    "[pillar][io]") {
  PillarScene scene = sensor();
  const bool is_driven = GENERATE(false, true);
  if (is_driven) std::get<StaticDrive>(scene.drive).drive_V = 2.0;
  const SectionGrid grid = solution_fields(scene, kMesh).front();
  const SectionField& phi = field_of(grid, "potential_V");
  const double wanted_V = is_driven ? 2.0 : phi.value[0][0];
  for (std::size_t i = 0; i < grid.x_m.size(); ++i) {
    const bool in_film = grid.z_m[i] <= 0.0 && phi.value[i][0] != 0.0;
    if (grid.z_m[i] < -24.999e-6) CHECK(std::abs(phi.value[i][0]) < 1e-12);
    if (in_film && grid.z_m[i] == 0.0 && grid.x_m[i] < 19.9e-6 && is_driven) {
      CHECK(phi.value[i][0] == Approx(wanted_V).epsilon(1e-6));
    }
  }
}

TEST_CASE("mode shapes turn with their harmonic", "[pillar][io]") {
  PillarScene scene = pressed_pillar();
  scene.drive = ModalDrive{.modes = 2};
  const std::vector<SectionGrid> grids = solution_fields(scene, kMesh);
  REQUIRE(grids.size() == 4);
  const double pi = std::numbers::pi;
  const auto top = [](const SectionGrid& grid) {
    return static_cast<std::size_t>(std::max_element(grid.z_m.begin(), grid.z_m.end()) -
                                    grid.z_m.begin());
  };
  // The axis of the top moves sideways as a whole in the lateral mode, one direction on all sides.
  const SectionGrid& lateral = grids[0];
  const auto here = displacement_at(lateral, lateral.fields[0], top(lateral), 0.0);
  const auto behind = displacement_at(lateral, lateral.fields[0], top(lateral), 0.5 * pi);
  CHECK(std::abs(here[0]) > 0.9);
  CHECK(behind[0] == Approx(here[0]).epsilon(1e-9));
  CHECK(behind[1] == Approx(0.0).margin(1e-9));
  // Torsion: around the axis, whatever the angle.
  const SectionGrid& torsion = grids[2];
  for (std::size_t i = 0; i < torsion.x_m.size(); ++i) {
    const auto u = displacement_at(torsion, torsion.fields[0], i, 1.0);
    CHECK(u[2] == 0.0);
    CHECK(u[0] * std::cos(1.0) + u[1] * std::sin(1.0) == Approx(0.0).margin(1e-12));
  }
  // Ovalling: out at 0 where it is in at 90 degrees.
  const SectionGrid& ovalling = grids[3];
  double largest = 0.0;
  for (std::size_t i = 0; i < ovalling.x_m.size(); ++i) {
    const double out = displacement_at(ovalling, ovalling.fields[0], i, 0.0)[0];
    const double in = displacement_at(ovalling, ovalling.fields[0], i, 0.5 * pi)[1];
    CHECK(out == Approx(-in).margin(1e-12));
    largest = std::max(largest, std::abs(out));
  }
  CHECK(largest > 0.5);
}

TEST_CASE("a .vtu file has as many points and cells as it says, and corners that exist",
          "[pillar][io]") {
  PillarScene scene = pressed_pillar();
  const bool is_strip = GENERATE(false, true);
  if (is_strip) scene.plane = PlaneState::kStress;
  const SectionGrid grid = solution_fields(scene, kMesh).front();
  const std::string vtu = vtu_from_grid(grid);
  const std::size_t copies = is_strip ? 2 : 24;
  const std::vector<double> points = array_of(vtu, "Points");
  CHECK(points.size() == 3 * copies * grid.x_m.size());
  CHECK(array_of(vtu, "displacement_m").size() == points.size());
  CHECK(array_of(vtu, "stress_zz_Pa").size() == points.size() / 3);
  const std::vector<double> corners = array_of(vtu, "connectivity");
  const std::size_t per_cell = is_strip ? 4 : 8;
  CHECK(corners.size() == per_cell * copies * grid.quads.size());
  CHECK(*std::max_element(corners.begin(), corners.end()) <
        static_cast<double>(points.size()) / 3.0);
  const std::vector<double> offsets = array_of(vtu, "offsets");
  CHECK(offsets.back() == static_cast<double>(corners.size()));
  for (const double type : array_of(vtu, "types")) CHECK(type == (is_strip ? 9.0 : 12.0));
}

// A clamped-free column buckles as 1 - cos(pi z/(2 L)) (Timoshenko & Gere, Theory of Elastic
// Stability, 2.1); shear and the foot change the shape of one that is ten times longer than wide little.
TEST_CASE("a buckling scene has a picture of Euler's shape", "[pillar][io]") {
  PillarScene scene = pressed_pillar();
  scene.drive = BucklingDrive{};
  scene.geometry.length_m = 10.0 * scene.geometry.diameter_m;
  const auto grids = solution_fields(scene, kMesh);
  REQUIRE(grids.size() == 1);
  const SectionGrid& grid = grids.front();
  const SectionField& shape = field_of(grid, "buckling_shape");
  double sign = 0.0, tip = 0.0;
  for (std::size_t i = 0; i < grid.z_m.size(); ++i) {
    const double u = displacement_at(grid, shape, i, 0.0)[0];
    if (std::abs(u) > tip) tip = std::abs(u), sign = u > 0.0 ? 1.0 : -1.0;
  }
  CHECK(tip == Approx(1.0).epsilon(0.01));
  int points = 0;
  for (std::size_t i = 0; i < grid.z_m.size(); ++i) {
    if (grid.x_m[i] > 1e-9) continue;  // on the axis
    const double z = grid.z_m[i] / scene.geometry.length_m;
    const double euler = 1.0 - std::cos(0.5 * std::numbers::pi * z);
    CHECK(sign * displacement_at(grid, shape, i, 0.0)[0] == Approx(euler).margin(0.02));
    ++points;
  }
  CHECK(points > 10);
  const auto pictures = pictures_from_grid(grid);
  REQUIRE(pictures.size() == 1);
  CHECK(pictures.front().first == "buckling_shape");
  SceneAnswer answer;
  answer.results.push_back({"buckling_pressure", 29370.033, "Pa", 1.3});
  const auto named = pictures_from_grid(grid, captions_from_answer(answer), "stamp");
  CHECK_THAT(named.front().second,
             Catch::Contains(">buckling shape: 29.3700 ± 0.0013 kPa (stamp)</text>"));
}

TEST_CASE("every field has a picture with its name, scale and unit", "[pillar][io]") {
  const SectionGrid grid = solution_fields(sensor(), kMesh).front();
  const auto pictures = pictures_from_grid(grid);
  REQUIRE(pictures.size() == 3);
  CHECK(pictures[2].first == "static_potential_V");
  CHECK_THAT(pictures[2].second, Catch::Contains(">static potential</text>"));
  CHECK_THAT(pictures[1].second, Catch::Contains(">kPa</text>"));  // plain numbers beside the bar
  CHECK_THAT(pictures[2].second, Catch::Contains(">mV</text>"));
  CHECK_THAT(pictures[0].second, Catch::Contains("displacement drawn"));
  const auto named = pictures_from_grid(grid, {{"potential_V", "under 1 mN"}});
  CHECK_THAT(named[2].second, Catch::Contains(">static potential: under 1 mN</text>"));
  for (const auto& [name, svg] : pictures) {
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("<polygon") != std::string::npos);
    CHECK_THAT(svg, Catch::Contains("text-anchor=\"end\" fill=\"#444\">20 µm</text>"));  // a length
  }
}

TEST_CASE("frequencies of modes have one notation in all titles", "[io]") {
  SceneAnswer answer;
  for (const double frequency_Hz : {17952.4, 173657.0, 2.7468e5}) {
    answer.modes.push_back(
        {.family = "lateral", .frequency_Hz = frequency_Hz, .error_estimate = 1e-3 * frequency_Hz});
  }
  const auto captions = captions_from_answer(answer);
  CHECK(captions.at("lateral_1") == "17.952 ± 0.018 kHz");
  CHECK(captions.at("lateral_2") == "173.66 ± 0.17 kHz");
  CHECK(captions.at("lateral_3") == "274.68 ± 0.27 kHz");
}

TEST_CASE("numbers of pictures have prefixes and minus signs", "[io]") {
  CHECK(in_unit(25e-6, "m") == "25 µm");
  CHECK(in_unit(-1e-6, "m") == "−1 µm");
  CHECK(in_unit(0.0095, "m") == "9.5 mm");
  CHECK(in_unit(0.0, "m") == "0 m");
  CHECK(in_unit(1e4, "Pa") == "10 kPa");
  CHECK(in_unit(0.25, "1") == "0.25");
  CHECK(in_unit(0.25, "%") == "0.25 %");
  CHECK(in_unit(2e-9, "m^2") == "2e−09 m^2");  // a prefix would be squared, too
  CHECK(in_unit(3e3, "1/Pa") == "3000 1/Pa");
  CHECK(in_unit(1500.0, "N/m") == "1.5 kN/m");
  CHECK(in_unit(2e-9, "N m") == "2 nN m");
  CHECK(in_unit(345.0, "Hz", 2) == "340 Hz");
  CHECK(in_unit(999.6e-3, "N", 3) == "1 N");
  CHECK(in_unit(25.0, "degC") == "25 degC");
  CHECK(interval_in_unit(-7.326e-7, -6.002e-7, "m") == "−732.6 to −600.2 nm");
  CHECK(in_unit_with_error(0.5, 0.0, "V") == "500 mV");
  CHECK(in_unit_with_error(2.0, 300.0, "Hz") == "2 ± 300 Hz");
  CHECK(in_unit_with_error(17952.4, NAN, "Hz") == "17.9524 kHz");
}

TEST_CASE("a picture of a flat body is no higher than the body and its bar of colours", "[io]") {
  SectionGrid grid = solution_fields(sensor(), kMesh).front();
  const auto height_px = [&] {
    const std::string svg = pictures_from_grid(grid).front().second;
    return std::stod(svg.substr(svg.find("height=\"") + 8));
  };
  CHECK(height_px() > 500.0);
  for (double& x_m : grid.x_m) x_m *= 100.0;
  CHECK(height_px() < 260.0);
}

TEST_CASE("the factor of a drawn displacement has no exponent", "[io]") {
  SectionGrid grid = solution_fields(sensor(), kMesh).front();
  for (SectionField& field : grid.fields) {
    for (auto& value : field.value) {
      for (double& part : value) part *= 1e-5;
    }
  }
  const std::string svg = pictures_from_grid(grid).front().second;
  const std::size_t at = svg.find("displacement drawn ");
  REQUIRE(at != std::string::npos);
  const std::string factor = svg.substr(at + 19, svg.find(" times", at) - at - 19);
  CHECK(factor.size() > 5);
  CHECK(factor.find_first_not_of("0123456789") == std::string::npos);
}

TEST_CASE("a scene file's length in quotes needs a unit, and a tolerance is printed as written",
          "[pillar][io]") {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("viscard_scene_" + std::to_string(getpid()));
  const auto refusal = [&](const std::string& diameter, const std::string& tolerance) {
    std::ofstream(path) << "tolerance = " << tolerance << "\n[geometry]\ndiameter = " << diameter
                        << "\nlength = \"120 um\"\n[materials]\npillar = { E = \"1.8 MPa\" }\n"
                        << "[analysis]\nload = { pressure = \"10 kPa\", on = \"top\" }\n";
    std::string message;
    try {
      read_scene(path);
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    std::filesystem::remove(path);
    return message;
  };
  CHECK_THAT(refusal("\"40\"", "1e-3"),
             Catch::Contains(":3: geometry.diameter") && Catch::Contains("has no unit"));
  CHECK_THAT(refusal("\"40 um\"", "1e-14"), Catch::Contains("the tolerance is 1e-14"));
  CHECK(refusal("\"40 um\"", "1e-3") == "");
  CHECK(refusal("40e-6", "1e-3") == "");  // SI without quotes
}
