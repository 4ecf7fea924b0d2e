#include "io/basics/atomic_file.h"
#include "io/materials/piezo_file.h"
#include "io/scenes/scene_file.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <filesystem>

namespace viscard {
namespace {

using test::error_text;

const char* const kGeometry =
    "[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
    "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33, rho = \"965 kg/m3\" }\n";

struct Files {
  test::ScratchFolder folder;
  SceneFile read(const std::string& rest, const std::string& before = kGeometry) {
    const std::filesystem::path path = folder.path() / "scene.toml";
    write_file(path, before + rest, true);
    return read_scene(path);
  }
  std::string error(const std::string& rest, const std::string& before = kGeometry) {
    return error_text([&] { read(rest, before); });
  }
  std::string medium_error(const std::string& json) {
    const std::filesystem::path path = folder.path() / "medium.json";
    write_file(path, json, true);
    return error_text([&] { read_medium(path); });
  }
};

}  // namespace

TEST_CASE("a sweep is read with its frequencies, load and direction", "[io]") {
  Files files;
  const Scene scene = files
                          .read(
                              "[analysis]\nkind = \"harmonic\"\n"
                              "load = { acceleration = \"2 m/s2\", on = \"base\", direction = "
                              "\"lateral\" }\n"
                              "frequencies = { from = \"1 Hz\", to = \"10 kHz\", count = 5 }\n")
                          .scene;
  const auto& drive = std::get<HarmonicDrive>(std::get<PillarScene>(scene).drive);
  CHECK(drive.load_place == LoadPlace::kBase);
  CHECK(drive.direction == LoadDirection::kLateral);
  CHECK(drive.base_acceleration_m_s2 == 2.0);
  REQUIRE(drive.frequencies_Hz.size() == 5);
  CHECK(drive.frequencies_Hz[0] == 1.0);
  CHECK(drive.frequencies_Hz[2] == Approx(100.0).epsilon(1e-14));  // rounding
  CHECK(drive.frequencies_Hz[4] == Approx(1e4).epsilon(1e-14));
}

TEST_CASE("a pulse becomes half a sine", "[io]") {
  Files files;
  const Scene scene = files
                          .read(
                              "[analysis]\nkind = \"transient\"\nend_time = \"50 us\"\n"
                              "pulse = { height = \"1 kPa\", duration = \"10 us\" }\n")
                          .scene;
  const auto& drive = std::get<TransientDrive>(std::get<PillarScene>(scene).drive);
  REQUIRE(drive.history.size() > 100);
  CHECK(drive.history.front().value == 0.0);
  CHECK(drive.history.back().time_s == Approx(1e-5).epsilon(1e-14));  // rounding
  CHECK(drive.history[drive.history.size() / 2].value == Approx(1e3).epsilon(1e-12));
  CHECK(drive.end_time_s == Approx(5e-5).epsilon(1e-14));
}

TEST_CASE("mistakes in the load of a pillar are reported with their key", "[io]") {
  Files files;
  struct Case {
    const char* rest;
    const char* expected;
  };
  const auto c = GENERATE(
      Case{"[analysis]\nkind = \"harmonics\"\n", "did you mean 'harmonic'"},
      Case{"[analysis]\nkind = \"harmonic\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n",
           "frequencies"},
      Case{"[analysis]\nkind = \"harmonic\"\nload = { pressure = \"1 kPa\", on = \"base\" }\n",
           "analysis.load.pressure"},
      Case{"[analysis]\nkind = \"static\"\nload = { acceleration = \"1 m/s2\", on = \"base\" }\n",
           "analysis.load.on"},
      Case{"[analysis]\nkind = \"static\"\nload = { pressure = \"1 kPa\" }\n", "no place"},
      Case{"[analysis]\nkind = \"static\"\nload = { voltage = \"1 V\" }\n", "electrode"},
      Case{"[analysis]\nkind = \"static\"\nload = { pressure = \"1 s\", on = \"top\" }\n",
           "scene.toml:8"},
      Case{"[analysis]\nkind = \"transient\"\nend_time = \"1 ms\"\n", "history"},
      Case{"[analysis]\nkind = \"transient\"\nhistory = [[\"0 s\", \"1 Pa\"], [\"1 s\", \"1 "
           "Pa\"]]\n",
           "end_time"},
      Case{"[analysis]\nkind = \"static\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n"
           "[readout]\nkind = \"voltage\"\n",
           "electrode"},
      Case{"[analysis]\nkind = \"harmonic\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n"
           "frequencies = { from = \"10 Hz\", to = \"1 Hz\", count = 3 }\n",
           "above"});
  CAPTURE(c.rest);
  CHECK_THAT(files.error(c.rest), Catch::Contains(c.expected));
}

TEST_CASE("a sweep of more points than anybody waits for is refused with its line", "[io]") {
  const std::string path = VISCARD_SOURCE_DIR "/data/scenes/array_map.toml";
  std::string text = read_file(path);
  const auto list_of = [&](const std::string& key, int count) {
    std::string list = key + " = [20e-6";
    for (int i = 1; i < count; ++i) list += ", 20e-6";
    const auto at = text.find("\n" + key + " = ", text.find("[sweep]")) + 1;
    text.replace(at, text.find('\n', at) - at, list + "]");
  };
  list_of("diameter", 320);
  list_of("spacing", 320);
  CHECK(test::contains(error_text([&] { scene_from_toml(text, path); }),
                       "array_map.toml:21: sweep: combines 102400 points; at most 100000"));
}

TEST_CASE("impossible geometry is refused with the length that is wrong", "[io]") {
  Files files;
  const std::string load =
      "[analysis]\nkind = \"static\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n";
  const std::string material = "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33 }\n";
  CHECK_THAT(
      files.error(load, "[geometry]\ndiameter = \"-40 um\"\nlength = \"120 um\"\n" + material),
      Catch::Contains("diameter"));
  CHECK_THAT(files.error(load, "[geometry]\ndiameter = \"40 um\"\n" + material),
             Catch::Contains("length"));
  CHECK_THAT(files.error(load,
                         "[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
                         "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.6 }\n"),
             Catch::Contains("oisson"));
  CHECK_THAT(files.error(load, "[geometry]\ndiameter = 40\nlength = \"120 um\"\n" + material),
             Catch::Contains("diameter: is 40 m; plausible are 0 to 1 m") &&
                 Catch::Contains("write \"40 um\""));
  CHECK_THAT(files.error("", "[geometry\n"), Catch::Contains("scene.toml:1"));
}

TEST_CASE("a medium file is refused with the key that is wrong", "[io]") {
  Files files;
  CHECK_THAT(files.medium_error("{"), Catch::Contains("is not JSON"));
  CHECK_THAT(files.medium_error("{}"), Catch::Contains("schema"));
  const std::string head = "{\"schema\": \"viscard-medium/1\", \"rho_kg_m3\": 1780, ";
  CHECK_THAT(files.medium_error(head + "\"x\": 1}"), Catch::Contains("'x'"));
  const std::string elastic = head + "\"elastic\": {\"E_Pa\": 2e9, \"nu\": 0.29}";
  CHECK_THAT(files.medium_error(head + "\"elastic\": {\"E_Pa\": 2e9}}"), Catch::Contains("nu"));
  CHECK_THAT(files.medium_error(elastic + ", \"charge_C_N\": {\"d31\": 1e-12}}"),
             Catch::Contains("d33"));
  CHECK_THAT(files.medium_error(elastic + ", \"charge_C_N\": {\"d31\": 1e-12, \"d33\": 1e-12}, "
                                          "\"relative_permittivity\": [12]}"),
             Catch::Contains("three numbers"));
  CHECK_THAT(files.medium_error(elastic + ", \"charge_C_N\": {\"d31\": 1e-9, \"d33\": -3e-9}, "
                                          "\"relative_permittivity\": [12, 12, 12]}"),
             Catch::Contains("permittivity"));
  const std::string s33 =
      "\"elastic\": {\"s11\": 1e-9, \"s12\": -3e-10, \"s13\": -3e-10, \"s33\": ";
  const std::string shears = ", \"s55\": 3e-9, \"s66\": 2.6e-9}}";
  CHECK(files.medium_error(head + s33 + "1e-9" + shears).empty());
  CHECK_THAT(files.medium_error(head + s33 + "-1e-9" + shears),
             Catch::Contains("1/s33 is -1e") && Catch::Contains("it must be positive"));
  for (const char* wrong : {"0", "1e-10", "1e-310"}) {
    CAPTURE(wrong);
    CHECK_THAT(files.medium_error(head + s33 + wrong + shears),
               Catch::Contains("not symmetric and positive definite"));
  }
  CHECK_THAT(files.medium_error("{\"schema\": \"viscard-medium/1\", \"rho_kg_m3\": -5, " + s33 +
                                "1e-9" + shears),
             Catch::Contains("rho_kg_m3 is -5 kg/m3; it must be positive"));
}

TEST_CASE("a film's file and its scene state what it loses", "[io]") {
  Files files;
  const auto medium = [&](const std::string& rest) {
    write_file(
        files.folder.path() / "film.json",
        "{\"schema\": \"viscard-medium/1\", \"rho_kg_m3\": 1780, \"elastic\": {\"E_Pa\": 2e9, "
        "\"nu\": "
        "0.29}, \"charge_C_N\": {\"d31\": 23e-12, \"d33\": -33e-12}, \"relative_permittivity\": "
        "[12, 12, 12]" +
            rest + "}",
        true);
    return read_medium(files.folder.path() / "film.json");
  };
  const double at_once = medium("").medium.permittivity_F_m(2, 2);
  CHECK(medium("").loss.is_lossless());
  const FilmLoss stated = medium(
                              ", \"dielectric\": {\"resistivity_Ohm_m\": 1e13, \"terms\": "
                              "[{\"relative_permittivity\": 0.6, \"tau_s\": 1e-3}]}")
                              .loss;
  CHECK(stated.leakage_s == Approx(1e13 * at_once).epsilon(1e-12));
  REQUIRE(stated.terms.size() == 1);
  CHECK(stated.terms[0].share ==
        Approx(0.6 * kVacuumPermittivity_F_m / at_once).epsilon(1e-12));  // at constant strain
  // The permittivity of a table is that at its frequency: less at once.
  const MediumFile table = medium(
      ", \"dielectric\": {\"frequency_Hz\": [1, 1e6], \"tan_delta\": [0.02, 0.02], "
      "\"permittivity_at_Hz\": 1000}");
  const double omega = 2.0 * 3.14159265358979 * 1000.0;
  const double added = added_permittivity(table.loss, {0.0, omega}).real();
  CHECK(table.permittivity_stress_F_m + added * table.medium.permittivity_F_m(2, 2) ==
        Approx(12.0 * kVacuumPermittivity_F_m).epsilon(1e-12));
  CHECK_THAT(error_text([&] { medium(", \"dielectric\": {\"tan\": 1}"); }),
             Catch::Matchers::Contains("no key 'dielectric.tan'"));

  medium(", \"dielectric\": {\"resistivity_Ohm_m\": 1e12}");
  const std::string film =
      "[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
      "film = { thickness = \"25 um\", radius = \"60 um\", material = \"pvdf\" }\n"
      "electrode = { face = \"top\", radius = \"20 um\" }\n"
      "[analysis]\nkind = \"harmonic\"\nfrequencies = { from = \"10 Hz\", to = \"100 Hz\", count = "
      "2 }\n"
      "load = { pressure = \"1 kPa\", on = \"top\" }\n"
      "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33, rho = \"965 kg/m3\" }\n";
  const auto loss_of = [&](const std::string& rest) {
    return common(files.read(rest, film).scene).film_loss;
  };
  CHECK(loss_of("pvdf = { file = \"film.json\" }").leakage_s ==
        Approx(1e12 * at_once).epsilon(1e-12));
  const std::string given =
      "pvdf = { file = \"film.json\", resistivity = \"1e13 ohm m\", dielectric = [[\"1 ms\", "
      "\"0.3\"]] }";
  CHECK(loss_of(given).leakage_s == Approx(1e13 * at_once).epsilon(1e-12));
  CHECK(loss_of(given).terms.at(0).tau_s == 1e-3);
  const SceneFile read = files.read(given, film);
  const SceneFile again = scene_from_toml(toml_of(read), files.folder.path() / "scene.toml");
  CHECK(common(again.scene).film_loss.leakage_s == common(read.scene).film_loss.leakage_s);
  CHECK(common(again.scene).film_loss.terms.at(0).share ==
        common(read.scene).film_loss.terms.at(0).share);
  CHECK_THAT(
      files.error(given + "\n[readout]\nkind = \"voltage\"\nfilm_resistivity = \"1e13 ohm m\"",
                  film),
      Catch::Matchers::Contains("readout.film_resistivity"));
  CHECK_THAT(files.error("pvdf = { E = \"2 GPa\", nu = 0.3, resistivity = \"1e13 ohm m\" }", film),
             Catch::Matchers::Contains("materials.pvdf"));
  medium(
      ", \"dielectric\": {\"frequency_Hz\": [1, 1e6], \"tan_delta\": [0.02, 0.02], "
      "\"permittivity_at_Hz\": 1e3}");
  CHECK_THAT(files.error(given, film),
             Catch::Matchers::Contains("states late polarisation itself"));
}

}  // namespace viscard
