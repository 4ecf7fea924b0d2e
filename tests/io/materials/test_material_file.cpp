#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/basics/parallel.h"
#include "io/materials/material_file.h"
#include "models/contact/punch_contact.h"
#include "tests/support/error_text.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::error_text;

std::string error_of(const std::string& json) {
  return error_text([&] { material_from_json(json, "m.json"); });
}

Material full_material() {
  Material material;
  material.name = "PDMS \"1:10\" µ";
  material.E0_Pa = 1.88e6 / 3.0;
  material.nu = 0.1 + 0.2;
  material.rho_kg_m3 = 965.0;
  material.terms = {{0.1 / 3.0, 0.0, 0.1945}, {1e-300, 1e-17, 2.403}};
  material.T_ref_C = -5.0;
  material.valid = {0.0125, 60.0, 0.01};
  MaterialUncertainty uncertainty;
  uncertainty.E0_Pa_95 = {1.0 / 7.0, 2.0 / 7.0};
  uncertainty.E_inf_Pa_95 = {0.0, std::numeric_limits<double>::infinity()};
  uncertainty.terms = {{1.0, 0.2, {1, 2}, {3, 4}, {5, 6}}, {1.5, 0.3, {7, 8}, {9, 10}, {11, 12}}};
  uncertainty.covariance_parameters = {"E_inf_Pa", "E_1_Pa"};
  uncertainty.covariance = Eigen::MatrixXd::Constant(2, 2, 1.0 / 3.0);
  uncertainty.systematic_relative = 0.021;
  material.uncertainty = uncertainty;
  material.flags = {{"tau-below-sampling", 1, "too fast to be seen"}};
  material.provenance = {"viscard 0.1.0",
                         "2026-11-21T09:00:00Z",
                         "viscard fit run.viscap",
                         {{"run.viscap", std::string(64, 'a')}},
                         0.5,
                         60.25,
                         "measured",
                         "assumed"};
  return material;
}

TEST_CASE("a material survives being written and read, every double exactly", "[io][material]") {
  const Material before = full_material();
  const std::string text = json_from_material(before);
  const MaterialFile file = material_from_json(text, "m.json");
  const Material& after = file.material;
  CHECK(after.name == before.name);
  CHECK(after.E0_Pa == before.E0_Pa);
  CHECK(after.nu == before.nu);
  CHECK(after.rho_kg_m3 == before.rho_kg_m3);
  REQUIRE(after.terms.size() == 2);
  CHECK(after.terms[0].g == before.terms[0].g);
  CHECK(after.terms[0].k == 0.0);
  CHECK(after.terms[1].k == 1e-17);
  CHECK(after.terms[1].g == 1e-300);
  CHECK(after.T_ref_C == -5.0);
  CHECK(after.valid.t_max_s == 60.0);
  REQUIRE(after.uncertainty.has_value());
  CHECK(after.uncertainty->E0_Pa_95.low == 1.0 / 7.0);
  CHECK(std::isinf(after.uncertainty->E_inf_Pa_95.high));
  CHECK(after.uncertainty->terms[1].tau_s_95.high == 12.0);
  CHECK(after.uncertainty->covariance == before.uncertainty->covariance);
  CHECK(after.uncertainty->systematic_relative == 0.021);
  CHECK(after.flags[0].term == 1);
  CHECK(after.provenance.raw_files[0].sha256 == std::string(64, 'a'));
  CHECK(after.provenance.nu_origin == "measured");
  CHECK(json_from_material(file) == text);
  CHECK(json_from_material(after) == text);
}

TEST_CASE("a material written by hand needs a modulus, a Poisson ratio and its terms",
          "[io][material]") {
  const Material material =
      material_from_json(R"({"E0_Pa": 2e6, "nu": 0.45, "terms": [{"g": 0.1, "tau_s": 2}]})", "m")
          .material;
  CHECK(material.E0_Pa == 2e6);
  CHECK(material.terms[0].k == 0.1);  // constant Poisson ratio
  CHECK(material.rho_kg_m3 == 0.0);
  CHECK_FALSE(material.T_ref_C.has_value());
  CHECK_FALSE(material.uncertainty.has_value());
}

TEST_CASE("unknown keys survive at every depth", "[io][material]") {
  MaterialFile file = material_from_json(
      R"({"E0_Pa": 2e6, "nu": 0.45, "colour": {"r": 0.1}, "valid": {"t_max_s": 3, "why": "short"},
          "terms": [{"g": 0.1, "tau_s": 2, "origin": "batch 7"}],
          "provenance": {"operator": "Ann"}})",
      "m");
  file.material.E0_Pa = 3e6;
  const std::string text = json_from_material(file);
  CHECK(contains(text, "\"r\": 0.1"));
  CHECK(contains(text, "\"why\": \"short\""));
  CHECK(contains(text, "\"origin\": \"batch 7\""));
  CHECK(contains(text, "\"operator\": \"Ann\""));
  const MaterialFile again = material_from_json(text, "m");
  CHECK(again.material.E0_Pa == 3e6);
  CHECK(json_from_material(again) == text);
}

TEST_CASE("a known key that was removed does not return from the original", "[io][material]") {
  MaterialFile file =
      material_from_json(R"({"E0_Pa": 2e6, "nu": 0.45, "terms": [], "T_ref_C": 20})", "m");
  file.material.T_ref_C.reset();
  CHECK_FALSE(contains(json_from_material(file), "T_ref_C"));
}

TEST_CASE("a material file that is large beyond any use is refused by its number",
          "[io][material]") {
  std::string terms = R"({"g": 1e-6, "tau_s": 1})";
  for (int i = 1; i < 200000; ++i) terms += R"(,{"g": 1e-6, "tau_s": 1})";
  CHECK(error_of(R"({"E0_Pa": 1e6, "nu": 0.4, "terms": [)" + terms + "]}") ==
        "m.json: terms: has 200000 terms; at most 1000 are taken");
  std::string keys = R"({"E0_Pa": 1e6, "nu": 0.4, "terms": [])";
  for (int i = 0; i < 100000; ++i) keys += ",\"k" + std::to_string(i) + "\": 1";
  CHECK(contains(error_of(keys + "}"), "m.json: an object has more than 10000 keys, the limit"));
  CHECK(contains(error_of(R"({"E0_Pa": 1, "nu": 0, "terms": [], "a": )" + std::string(70, '[') +
                          "1" + std::string(70, ']') + "}"),
                 "m.json: is nested deeper than 64 levels"));
  CHECK(contains(error_of(R"({"name": "a\u0000b", "E0_Pa": 1, "nu": 0, "terms": []})"),
                 "m.json: a text has the character \\u0000"));
}

TEST_CASE("an impossible material file is refused with file and key", "[io][material]") {
  CHECK(contains(error_of("{\"E0_Pa\": 1e6,\n  nu: 3}"), "m.json:2: is not JSON: at column"));
  CHECK(contains(error_of(""), "m.json:1: is empty, not a material"));
  CHECK(error_of("[1, 2]") == "m.json: the file must be an object, { ... }");
  CHECK(contains(error_of(R"({"E0": 1e6, "nu": 0.4, "terms": []})"),
                 "m.json: 'E0_Pa' is missing; expected the instantaneous Young's modulus in Pa "
                 "(the file has 'E0')"));
  CHECK(error_of(R"({"E0_Pa": "2 MPa", "nu": 0.4, "terms": []})") ==
        "m.json: E0_Pa: expected a number in SI, without quotes or unit");
  CHECK(error_of(R"({"E0_Pa": 1e6, "nu": 0.4, "terms": {}})") ==
        "m.json: terms: expected a list, [ ... ]");
  CHECK(contains(error_of(R"({"E0_Pa": 1e6, "nu": 0.4, "terms": [{"g": 0.1}]})"),
                 "m.json: 'terms[1].tau_s' is missing"));
  CHECK(contains(
      error_of(
          R"({"E0_Pa": 1e6, "nu": 0.4, "terms": [{"g": 0.6, "tau_s": 1}, {"g": 0.5, "tau_s": 2}]})"),
      "m.json: the g of all terms add up to 1.1"));
  CHECK(contains(error_of(R"({"E0_Pa": 1e6, "nu": 0.51, "terms": []})"),
                 "m.json: Poisson ratio is 0.51"));
  CHECK(contains(error_of(R"({"E0_Pa": -1e6, "nu": 0.4, "terms": []})"), "m.json: E0 is -1"));
  CHECK(contains(error_of(R"({"E0_Pa": 1e999, "nu": 0.4, "terms": []})"), "m.json: is not JSON: "));
  CHECK(contains(error_of(R"({"E0_Pa": 1, "E0_Pa": 2, "nu": 0.4, "terms": []})"),
                 "m.json: key 'E0_Pa' is given twice"));
  CHECK(contains(error_of(R"({"schema": "viscard-material/2", "E0_Pa": 1, "nu": 0, "terms": []})"),
                 "update viscard"));
  CHECK(contains(error_of(R"({"schema": "geojson", "E0_Pa": 1, "nu": 0, "terms": []})"),
                 "not a material file"));
  CHECK(contains(error_of(R"({"E0_Pa": 1, "nu": 0, "terms": [], "uncertainty":
                 {"covariance_parameters": ["a", "b"], "covariance": [[1, 2], [3]]}})"),
                 "m.json: uncertainty.covariance: expected 2 rows of 2 numbers"));
  CHECK(contains(error_text([] { read_material("/nowhere/m.json"); }), "/nowhere/m.json"));
}

TEST_CASE("a joint file whose numbers cannot belong together is refused with what is wrong",
          "[io][material][joint]") {
  const std::string good = read_file(VISCARD_SOURCE_DIR "/tests/fuzz/seeds/fuzz_joint/law");
  const auto error_with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
    REQUIRE(text != good);
    return error_text([&] { ratio_fit_from_json(text, "j.json"); });
  };
  CHECK_NOTHROW(ratio_fit_from_json(good, "j.json"));
  const std::string terms = "\"n_terms\":1";
  CHECK(contains(error_with(terms, "\"n_terms\":100000000"), "fewer coefficients than"));
  CHECK(contains(error_with(terms, "\"n_terms\":2e9"), "expected a whole number"));
  CHECK(contains(error_with(terms, "\"n_terms\":20000000000"), "at most nine digits"));
  CHECK(contains(error_with(terms, terms + ",\"own_terms\":[-3,1,1]"), "own_terms must be"));
  CHECK(contains(error_with("\"E0_degree\":1", "\"E0_degree\":-5"), "a degree must be"));
  CHECK(contains(error_with("\"E0_degree\":1", "\"E0_degree\":7"), "a degree exceeds"));
  CHECK(contains(error_with("\"ln-ratio\"", "\"banana\""), "the variable must be"));
  CHECK(contains(error_with("[10.0,13.0,20.0]", "[20.0,13.0,10.0]"), "positive and ascend"));
  CHECK(contains(error_with("[10.0,13.0,20.0]", "[]"), "there are no ratios"));
  CHECK(contains(error_with("\"terms\":[]", "\"terms\":[{\"g\":0.5,\"tau_s\":1}]"),
                 "j.json: common.terms: must be empty"));
}

TEST_CASE("the seed's materials read, and their comment on the layer holds", "[io][material]") {
  for (const char* name :
       {"pdms_1to10_seed.json", "pdms_1to13_seed.json", "pdms_1to20_seed.json"}) {
    const MaterialFile file =
        read_material(std::filesystem::path(VISCARD_SOURCE_DIR) / "data/materials" / name);
    CHECK(file.material.terms.size() == 2);
    CHECK(has_constant_poisson_ratio(file.material));
    CHECK(contains(file.material.flags.at(0).text, "27 %"));
  }
  const PunchContact contact{
      .punch_radius_m = 2.2e-3, .layer_thickness_m = 11e-3, .poisson_ratio = 0.495};
  CHECK(layer_factor(contact) == Approx(1.27).margin(0.01));  // "overstates it by 27 %"
}

TEST_CASE("SHA-256 agrees with the examples of FIPS 180-4", "[io][sha256]") {
  // https://csrc.nist.gov/projects/cryptographic-standards-and-guidelines/example-values
  const test::ScratchFolder folder;
  write_file(folder / "abc", "abc", false);
  CHECK(sha256_of_file(folder / "abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_file(folder / "empty", "", false);
  CHECK(sha256_of_file(folder / "empty") ==
        "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  write_file(folder / "million", std::string(1'000'000, 'a'), false);
  CHECK(sha256_of_file(folder / "million") ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK(contains(error_text([&] { sha256_of_file(folder / "none"); }), "cannot open"));
  CHECK(contains(error_text([&] { sha256_of_file(folder.path()); }), "cannot read"));
}

TEST_CASE("a material file that was edited since it was written has a flag, and keeps it",
          "[io][material]") {
  const auto is_flagged = [](const std::string& json) {
    const Material material = material_from_json(json, "m.json").material;
    return std::any_of(material.flags.begin(), material.flags.end(),
                       [](const MaterialFlag& flag) { return flag.name == "edited"; });
  };
  const std::string json = json_from_material(full_material());
  CHECK(contains(json, "\"body_sha256\": \""));
  CHECK_FALSE(is_flagged(json));
  CHECK_FALSE(is_flagged("\n  " + json));  // spaces do not count
  for (const auto& [from, to] : {std::pair{"0.1945", "0.1946"}, std::pair{"965.0", "966.0"},
                                 std::pair{"too fast", "too slow"}}) {
    std::string edited = json;
    const std::size_t at = edited.find(from);
    REQUIRE(at != std::string::npos);
    edited.replace(at, std::string(from).size(), to);
    CHECK(is_flagged(edited));
    const std::string again = json_from_material(material_from_json(edited, "m.json"));
    CHECK(is_flagged(again));  // also after it was written again
  }
}

TEST_CASE("a series beyond any use is refused with the limit", "[io][material]") {
  std::string terms;
  for (int i = 0; i < 1001; ++i) {
    terms += (i == 0 ? "" : ",") + ("{\"g\": 1e-4, \"tau_s\": " + std::to_string(i + 1) + "}");
  }
  CHECK(contains(error_of("{\"E0_Pa\": 2e6, \"nu\": 0.4, \"terms\": [" + terms + "]}"),
                 "has 1001 terms; at most 1000"));
  CHECK(contains(error_of("{\"" + std::string(100000, 'k') + "\": 1}"), "1000 characters"));
}

TEST_CASE("a file that is replaced keeps its rights, and links in its folder are not followed",
          "[io][file]") {
  namespace fs = std::filesystem;
  const test::ScratchFolder folder;
  const auto path = folder / "private.json";
  write_file(path, "old", false);
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  write_file(path, "new", true);
  CHECK(read_file(path) == "new");
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  fs::permissions(path, static_cast<fs::perms>(0666));
  write_file(path, "newer", true);
  CHECK(fs::status(path).permissions() == static_cast<fs::perms>(0666));
  // Somebody has guessed the name of the temporary file.
  const auto victim = folder / "victim";
  write_file(victim, "untouched", false);
  fs::create_symlink(victim, folder / (".out.json." + std::to_string(::getpid()) + ".tmp"));
  write_file(folder / "out.json", "text", false);
  CHECK(read_file(folder / "out.json") == "text");
  CHECK(read_file(victim) == "untouched");
  CHECK_FALSE(fs::is_symlink(folder / "out.json"));
}

TEST_CASE("recorded inputs have the sums of what was read", "[io][file]") {
  const test::ScratchFolder folder;
  write_file(folder / "a", "abc", false);
  CHECK(provenance_of_inputs().empty());
  const InputRecorder recorder;
  read_file(folder / "a");
  read_file(folder / "a");
  read_own_file(folder / "a");
  REQUIRE(recorder.files().size() == 1);
  CHECK(recorder.files()[0].sha256 == sha256_of_text("abc"));
  CHECK_THROWS_WITH(write_file(folder / "a", "abd", true),
                    Catch::Contains("is read by this command"));
  rewrite_file(folder / "a", "abd");
  read_file(folder / "a");
  CHECK(provenance_of_inputs().size() == 2);  // it has changed meanwhile
}

TEST_CASE("the sum of a file that was read stays that of what was read", "[io][file]") {
  const test::ScratchFolder folder;
  write_file(folder / "a", "abc", false);
  CHECK(sha256_as_read(folder / "a") == sha256_of_text("abc"));  // nobody records
  const InputRecorder recorder(InputRecorder::Of::kCall);
  CHECK_FALSE(recorded_sum(folder / "a"));
  read_file(folder / "a");
  rewrite_file(folder / "a", "abd");
  CHECK(sha256_as_read(folder / "a") == sha256_of_text("abc"));
  read_file(folder / "a");
  CHECK(sha256_as_read(folder / "a") == sha256_of_text("abd"));
  rewrite_file(folder / "a", "abc");
  read_file(folder / "a");  // the old contents again, which are recorded
  CHECK(sha256_as_read(folder / "a") == sha256_of_text("abc"));
}

TEST_CASE("the recorder of a call sees its own thread and those that work for it", "[io][file]") {
  const test::ScratchFolder folder;
  for (const char* name : {"own", "worker", "other"}) write_file(folder / name, name, false);
  const InputRecorder recorder(InputRecorder::Of::kCall);
  read_file(folder / "own");
  std::thread(recorded_as_here([&] {
    read_file(folder / "worker");
    note_input(folder / "worker", "is edited");
  })).join();
  std::thread([&] {
    const InputRecorder of_other(InputRecorder::Of::kCall);
    read_file(folder / "other");
    read_file(folder / "own");
    note_input(folder / "own", "is odd");
    CHECK(of_other.files().size() == 2);
  }).join();
  const std::vector<InputFile> files = recorder.files();
  REQUIRE(files.size() == 2);
  CHECK(files[0].path == (folder / "own").string());
  CHECK(files[0].note.empty());
  CHECK(files[1].note == "is edited");
  CHECK(provenance_of_inputs().size() == 2);
}

TEST_CASE("all threads of a loop in parallel read for the call that started it", "[io][file]") {
  const test::ScratchFolder folder;
  for (int i = 0; i < 20; ++i) write_file(folder / std::to_string(i), std::to_string(i), false);
  const InputRecorder recorder(InputRecorder::Of::kCall);
  for_each_in_parallel(20, [&](std::size_t i) {
    const InputRecorder part(InputRecorder::Of::kPart);
    read_file(folder / std::to_string(i));
    if (part.files().size() != 1) throw std::runtime_error("a part sees what others read");
  });
  CHECK(recorder.files().size() == 20);
}

TEST_CASE("a file that somebody changes or removes while a command works is refused",
          "[io][file]") {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "a";
  const auto change = [&](const char* text) { std::ofstream(file) << text; };
  change("abc");
  const InputRecorder::Of of = GENERATE(InputRecorder::Of::kProcess, InputRecorder::Of::kCall);
  const InputRecorder recorder(of);
  read_file(file);
  change("abd");
  CHECK_THROWS_AS(read_file(file), InputChanged);
  CHECK_THROWS_WITH(sha256_of_file(file),
                    file.string() + " changed while viscard was working; start again");
  change("abc");
  CHECK(read_file(file) == "abc");
  std::filesystem::remove(file);
  CHECK_THROWS_WITH(read_file(file), Catch::Contains("was read before and cannot be read now"));
  CHECK(recorder.files().size() == 1);
}

TEST_CASE("a file may change for a live page, for the next command and while it is written",
          "[io][file]") {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder / "a";
  const auto change = [&](const char* text) { std::ofstream(file) << text; };
  change("abc");
  const InputRecorder outer;
  read_file(file);
  change("abd");
  {
    const InputRecorder next;
    CHECK(read_file(file) == "abd");
    change("abe");
    CHECK_THROWS_AS(read_file(file), InputChanged);
    accept_changed_inputs();
    CHECK(read_file(file) == "abe");
  }
  change("abf");
  CHECK_THROWS_AS(read_file(file), InputChanged);
  const int writer = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(::flock(writer, LOCK_EX) == 0);  // as the writer of a capture does
  CHECK(read_file(file) == "abf");
  change("abg");
  CHECK(read_file(file) == "abg");
  ::close(writer);
}

}  // namespace
}  // namespace viscard
