// What is written with --strip-paths.
#include "io/basics/atomic_file.h"
#include "io/basics/written_path.h"
#include "io/cli/words/folderless_stream.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

TEST_CASE("with --strip-paths no file states a folder of this computer", "[cli]") {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "home/miller").string();
  std::filesystem::create_directories(folder);
  const std::string table = folder + "/curve.csv", material = folder + "/m.json",
                    card = folder + "/card.inp", page = folder + "/page.html";
  write_file(table, read_file(VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv"), false);
  const auto run = [](std::vector<std::string> words) {
    words.emplace_back("--strip-paths");
    const CommandOutcome outcome = run_command(words);
    CAPTURE(words, outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome;
  };
  const CommandOutcome fit = run({"fit", table, "--out", material, "--json"});
  CHECK_THAT(fit.out, !Contains("miller"));
  run({"card", material, "--for", "abaqus", "--units", "mm-t-s", "--out", card});
  run({"report", table, "--out", page});
  for (const std::string& file : {material, card, page}) {
    CAPTURE(file);
    CHECK_THAT(read_file(file), !Contains("miller"));
  }
  CHECK_THAT(read_file(material), Contains("curve.csv"));
  run_command({"fit", table, "--out", material, "--force"});  // and without it, as before
  CHECK_THAT(read_file(material), Contains("miller"));
}

TEST_CASE("cards and laws of rubber of materials with folders are stripped, too", "[cli]") {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "home/miller").string();
  std::filesystem::create_directories(folder);
  const std::string table = folder + "/uniaxial.csv", law = folder + "/law.json",
                    card = folder + "/card.inp";
  write_file(table, read_file(VISCARD_SOURCE_DIR "/data/reference/treloar_uniaxial.csv"), false);
  const CommandOutcome fit =
      run_command({"fit", "uniaxial=" + table, "--model", "yeoh", "--out", law, "--strip-paths"});
  CAPTURE(fit.err);
  CHECK_THAT(read_file(law), !Contains("miller"));
  run_command({"fit", "uniaxial=" + table, "--model", "yeoh", "--out", law, "--force"});
  const CommandOutcome written =
      run_command({"card", law, "--for", "abaqus", "--units", "mm-t-s", "--bulk-modulus", "1 GPa",
                   "--accept-flags", "--out", card, "--strip-paths"});
  CAPTURE(written.err);
  CHECK_THAT(read_file(card), !Contains("miller"));
}

TEST_CASE("with --strip-paths no command states a folder in what it prints or in a file", "[cli]") {
  const ScratchFolder scratch;
  const std::string mine = (scratch / "home/miller").string(), out = mine + "/out",
                    other = (scratch / "home/osterkamp").string();
  std::filesystem::create_directories(out);
  std::filesystem::create_directories(other);
  for (const char* name : {"demo", "scenes", "materials"}) {
    std::filesystem::copy(std::string(VISCARD_SOURCE_DIR "/data/") + name, mine + "/" + name,
                          std::filesystem::copy_options::recursive);
  }
  const std::string table = mine + "/demo/example_relaxation.csv", material = out + "/m.json",
                    card = out + "/c.inp", capture = out + "/r.viscap", test = mine + "/short.toml",
                    scene = mine + "/scenes/pillar_creep.toml", study = other + "/study.toml",
                    film = mine + "/film.toml", lost = mine + "/lost.toml";
  write_file(test,
             "[approach]\nspeed = \"0.2 mm/s\"\nbaseline = \"1 s\"\n[ramp]\ndepth = \"0.13 mm\"\n"
             "duration = \"1 s\"\nhold = \"3 s\"\n[recovery]\nhold = \"2 s\"\n",
             false);
  write_file(study,
             "scene = \"../miller/scenes/pillar_press.toml\"\n[[parameter]]\n"
             "key = \"geometry.diameter\"\nvalues = [\"40 um\"]\n",
             false);
  write_file(other + "/soft.json",
             "{\"schema\": \"viscard-material/1\", \"E0_Pa\": 1.8e6, \"nu\": 0.4, \"terms\": []}\n",
             false);
  write_file(mine + "/film_scene.toml",
             "tolerance = 1e-2\n[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
             "[materials]\npillar = { file = \"../osterkamp/soft.json\" }\n"
             "[analysis]\nkind = \"static\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n"
             "[want]\nquantities = [\"top_displacement\"]\n",
             false);
  const auto study_of_files = [&](const std::string& values) {
    return "scene = \"film_scene.toml\"\n[[parameter]]\nkey = \"materials.pillar.file\"\nvalues = "
           "[" +
           values + "]\n";
  };
  // Values that are names of files: by their full path, from the scene, and one that is not there.
  write_file(film, study_of_files("\"../osterkamp/soft.json\", \"" + other + "/soft.json\""),
             false);
  write_file(lost, study_of_files("\"../osterkamp/lost.json\""), false);
  const std::vector<std::vector<std::string>> all{
      {"sweep", film, "--out", out + "/f.sqlite", "--csv", out + "/f.csv"},
      {"sweep", lost, "--out", out + "/l.sqlite", "--csv", out + "/l.csv"},
      {"fit", mine + "/demo/lost_far_away.csv"},
      {"fit", table, "--out", material, "--svg", out + "/m.svg"},
      {"fit", table, "--show-table"},
      {"fit", mine + "/missing.csv"},
      {"predict", material, "--against", table, "--csv", out + "/p.csv", "--svg", out + "/p.svg"},
      {"validate", material, "--csv", out + "/v.csv"},
      {"card", material, "--for", "abaqus", "--units", "mm-t-s", "--out", card},
      {"card", "--check", card, material},
      {"card", "--verify", card, material},
      {"card", card, "--import", out + "/imported.json"},
      {"capture", "--emulate", "--speed", "200", "--test", test, "--specimen",
       mine + "/demo/03_pdms_1to10.toml", "--out", capture},
      {"export", capture, "--out", out + "/r.csv"},
      {"report", capture, material, "--out", out + "/page.html"},
      {"scene", "check", scene, "--svg", out + "/scene.svg"},
      {"scene", "check", mine + "/scenes/missing.toml"},
      {"plan", scene},
      {"simulate", scene, "--compare", scene, "--out", out + "/answer"},
      {"simulate", "../" + std::filesystem::path(mine).filename().string() + "/none.toml"},
      {"sweep", study, "--out", out + "/s.sqlite", "--csv", out + "/s.csv"}};
  const auto has_folder = [](const std::string& text) {
    return text.find("miller") != std::string::npos || text.find("osterkamp") != std::string::npos;
  };
  for (const auto& one : all) {
    for (const bool as_json : {false, true}) {
      std::vector<std::string> words = one;
      words.emplace_back("--strip-paths");
      if (as_json) words.emplace_back("--json");
      const bool writes = std::any_of(one.begin(), one.end(), [](const std::string& word) {
        return word == "--out" || word == "--svg" || word == "--csv" || word == "--import";
      });
      if (as_json && writes) words.emplace_back("--force");
      const CommandOutcome outcome = run_command(words);
      CAPTURE(words, outcome.out, outcome.err);
      CHECK_FALSE(has_folder(outcome.out));
      CHECK_FALSE(has_folder(outcome.err));
      CHECK(outcome.status != kBadWords);
    }
  }
  std::size_t n_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
    if (!entry.is_regular_file()) continue;
    CAPTURE(entry.path());
    CHECK_FALSE(has_folder(read_file(entry.path())));
    ++n_files;
  }
  CHECK(n_files > 15);
  CHECK_THAT(read_file(out + "/f.csv"), Contains("soft.json"));
  strip_written_paths(false);  // for the tests behind it
}

TEST_CASE("a text loses the folders of files that the command reads, and no others", "[cli]") {
  strip_written_paths(true);
  remember_folder_of("/home/Anna Miller/data/b.csv");
  remember_folder_of("../secret/c.csv");
  CHECK(written_text("/home/Anna Miller/data/b.csv: 3 rows") == "b.csv: 3 rows");
  CHECK(written_text("see '/home/Anna Miller/data/sub/x'") == "see 'sub/x'");
  CHECK(written_text("nothing in '/home/Anna Miller/data' is so") == "nothing in '.' is so");
  CHECK(written_text("(../secret/c.csv)") == "(c.csv)");
  CHECK(written_text("/home/Anna Miller/database/b.csv") == "/home/Anna Miller/database/b.csv");
  CHECK(written_text("E/E0 in 1/Pa") == "E/E0 in 1/Pa");
  CHECK(written_path("../secret/c.csv") == "c.csv");
  // As a scene in another folder names it.
  remember_folder_of("scenes/../../hidden/deep/m.json");
  CHECK(written_text("no '../../hidden/deep/m.json' here") == "no 'm.json' here");
  strip_written_paths(false);
  CHECK(written_text("/home/Anna Miller/data/b.csv") == "/home/Anna Miller/data/b.csv");
}

TEST_CASE("a question without a line break is printed when it is flushed, without folders",
          "[cli]") {
  strip_written_paths(true);
  remember_folder_of("/home/anna/soft.toml");
  std::ostringstream shown;
  {
    FolderlessStream stream(shown);
    stream << "Put /home/anna/";
    CHECK(shown.str().empty());
    stream << "soft.toml under the punch: " << std::flush;
    CHECK(shown.str() == "Put soft.toml under the punch: ");
  }
  CHECK(shown.str() == "Put soft.toml under the punch: ");
  strip_written_paths(false);
}

TEST_CASE("only absolute paths are cut, in words too", "[cli]") {
  strip_written_paths(true);
  CHECK(written_path("/home/a/b.csv") == "b.csv");
  CHECK(written_path("/home/a/") == "a");
  CHECK(written_path("/") == "/");
  CHECK(written_path("data/b.csv") == "data/b.csv");
  CHECK(written_word("--out=/home/a/b.json") == "--out=b.json");
  CHECK(written_word("modulus_Pa=1e6*E/2") == "modulus_Pa=1e6*E/2");
  strip_written_paths(false);
  CHECK(written_path("/home/a/b.csv") == "/home/a/b.csv");
}

TEST_CASE("with --strip-paths values of a list that are different files stay different", "[cli]") {
  const auto written = [](const std::vector<std::string>& values) {
    const WrittenValues of(values, "/home/anna/study");
    std::vector<std::string> all;
    for (const std::string& value : values) all.push_back(of(value));
    return all;
  };
  using Texts = std::vector<std::string>;
  CHECK(written({"/x/alpha/m.json", "/x/beta/m.json"}) ==
        Texts{"/x/alpha/m.json", "/x/beta/m.json"});
  strip_written_paths(true);
  CHECK(written({"/x/alpha/m.json", "/x/beta/m.json", "/x/beta/n.json"}) ==
        Texts{"alpha/m.json", "beta/m.json", "n.json"});
  CHECK(written({"/x/p/m.json", "/y/p/m.json", "/y/q/m.json"}) ==
        Texts{"x/p/m.json", "y/p/m.json", "q/m.json"});
  CHECK(written({"../../bert/m.json", "/home/anna/m.json", "/data/x/m.json", "40 um"}) ==
        Texts{"m.json (1)", "m.json (2)", "x/m.json", "40 um"});
  CHECK(written({"m.json", "../m.json"}) == Texts{"m.json", "m.json (1)"});
  // Two names of one file.
  CHECK(written({"../m.json", "/home/anna/m.json"}) == Texts{"m.json", "m.json"});
  CHECK(written({"/home/anna/study/m.json", "m.json"}) == Texts{"m.json", "m.json"});
  CHECK(WrittenValues({}, "")("/home/anna/m.json") == "m.json");
  strip_written_paths(false);
}

TEST_CASE("with --strip-paths rows of a sweep over files of one name in two folders differ",
          "[cli]") {
  const ScratchFolder scratch;
  const std::string study = (scratch / "study.toml").string(),
                    store = (scratch / "s.sqlite").string(), csv = (scratch / "s.csv").string();
  for (const char* const folder : {"alpha", "beta", "scenes"})
    std::filesystem::create_directory(scratch / folder);
  for (const char* const name : {"alpha/m.json", "beta/m.json"}) {
    write_file(scratch / name,
               "{\"schema\": \"viscard-material/1\", \"E0_Pa\": " +
                   std::string(name[0] == 'a' ? "1.0e6" : "2.0e6") +
                   ", \"nu\": 0.4, \"terms\": []}\n",
               false);
  }
  write_file(scratch / "scenes/scene.toml",
             "tolerance = 1e-2\n[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
             "[materials]\npillar = { file = \"../alpha/m.json\" }\n"
             "[analysis]\nkind = \"static\"\nload = { pressure = \"1 kPa\", on = \"top\" }\n"
             "[want]\nquantities = [\"top_displacement\"]\n",
             false);
  write_file(study,
             "scene = \"scenes/scene.toml\"\n[[parameter]]\nkey = \"materials.pillar.file\"\n"
             "values = [\"../alpha/m.json\", \"../beta/m.json\"]\n",
             false);
  const CommandOutcome outcome =
      run_command({"sweep", study, "--out", store, "--csv", csv, "--strip-paths"});
  strip_written_paths(false);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  for (const std::string& file : {csv, store}) {
    CAPTURE(file);
    const std::string text = read_file(file);
    CHECK_THAT(text, Contains("alpha/m.json"));
    CHECK_THAT(text, Contains("beta/m.json"));
    CHECK_THAT(text, !Contains("../beta/m.json"));
  }
}

TEST_CASE("with --strip-paths fits of files of one name in two folders stay different", "[cli]") {
  const ScratchFolder scratch;
  std::vector<std::string> words{"fit"};
  for (const char* const folder : {"alpha", "beta"}) {
    std::filesystem::create_directory(scratch / folder);
    words.push_back((scratch / folder / "x.csv").string());
    const double factor = folder[0] == 'a' ? 1.0 : 2.0;
    std::string table = "time_s,modulus_Pa\n";
    for (int k = 1; k <= 200; ++k) {
      const double E_Pa = 1e6 * (1.0 + 0.2 * std::exp(-0.05 * k) + 1e-4 * std::sin(7.0 * k));
      table += std::to_string(0.05 * k) + "," + std::to_string(factor * E_Pa) + "\n";
    }
    write_file(words.back(), table, false);
  }
  const std::string csv = (scratch / "fits.csv").string();
  words.insert(words.end(), {"--strip-paths", "--csv", csv});
  run_command(words);
  words.insert(words.end(), {"--force", "--json"});
  const CommandOutcome json = run_command(words);
  strip_written_paths(false);
  CAPTURE(json.out, json.err);
  for (const std::string& text : {read_file(csv), json.out}) {
    CHECK_THAT(text, Contains("\"alpha/x.csv\"") && Contains("\"beta/x.csv\""));
    CHECK_THAT(text, !Contains(scratch.path().string()));
  }
}
