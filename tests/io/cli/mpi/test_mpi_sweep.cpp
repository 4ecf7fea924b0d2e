// viscard-mpi under mpirun, as users start it.
#include "io/basics/atomic_file.h"
#include "io/flow/sweep/run_study.h"
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace viscard;
using namespace viscard::test;

namespace {

// Points with nu = 0.6 have no answer. Those of the slow tests take tenths of a second, so that ranks are
// killed in the midst of one.
const char* const kQuickScene = R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { E = "1.8 MPa", nu = 0.33 }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
[want]
quantities = ["top_displacement"]
)";
const char* const kSlowScene = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
film = { thickness = "25 um", radius = "60 um", material = "pvdf" }
electrode = { face = "top", kind = "equipotential", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33 }
pvdf = { file = "DATA/materials/pvdf_film_manual.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
)";

const char* const kMpiStudy = R"(scene = "scene.toml"
[[parameter]]
key = "geometry.diameter"
from = "30 um"
to = "50 um"
count = 10
[[parameter]]
key = "materials.pillar.nu"
values = ["0.3", "0.4", "-1"]
)";

struct MpiStudy {
  SceneText scene;
  std::string study = scene.beside("study.toml");
  std::string store = scene.beside("mpi.sqlite"), out = scene.beside("out.txt");
  explicit MpiStudy(const char* text) : scene(text) { write_file(study, kMpiStudy, false); }
  std::string rows(const std::string& file) const {
    const Study read = read_study(study);
    StudyStore kept(file, read);
    return csv_from_study(kept, read);
  }
  std::string whole() const {
    const std::string file = scene.beside("whole.sqlite");
    REQUIRE(run_command({"sweep", study, "--out", file}).status == 0);
    return rows(file);
  }
};

// mpirun as a child process; what it prints goes to a file.
class MpiRun {
 public:
  MpiRun(const MpiStudy& study, int n_ranks, const std::vector<std::string>& of_mpirun,
         const std::vector<std::string>& of_sweep)
      : out_(study.out) {
    std::vector<std::string> words{"mpirun", "--oversubscribe", "-n", std::to_string(n_ranks)};
    words.insert(words.end(), of_mpirun.begin(), of_mpirun.end());
    words.insert(words.end(), {VISCARD_MPI_PROGRAM, "sweep", study.study, "--out", study.store});
    words.insert(words.end(), of_sweep.begin(), of_sweep.end());
    pid_ = fork();
    if (pid_ != 0) return;
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Open MPI does not free what its modules allocated; a sanitized build still checks addresses.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (std::freopen(out_.c_str(), "w", stdout) == nullptr) _exit(1);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(1);
  }
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }
  std::string printed() const {
    std::ifstream in(out_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // Process of a rank; 0: there is none yet. mpirun marks it in its environment.
  pid_t process_of(int rank) const {
    const std::string mark = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string folder = entry.path().string();
      std::ifstream stat(folder + "/stat");
      std::string number, name, state;
      pid_t parent = 0;
      if (!(stat >> number >> name >> state >> parent) || parent != pid_) continue;
      std::ifstream environment(folder + "/environ");
      for (std::string one; std::getline(environment, one, '\0');) {
        if (one == mark) return static_cast<pid_t>(std::stol(number));
      }
    }
    return 0;
  }
  // Kills a rank as soon as some points are done.
  void kill_rank(int rank, const MpiStudy& study, std::size_t after_points) const {
    while (waitpid(pid_, nullptr, WNOHANG) == 0) {
      usleep(2000);
      if (!std::filesystem::exists(study.store)) continue;
      if (StudyStore(study.store, read_study(study.study)).done().size() < after_points) continue;
      const pid_t process = process_of(rank);
      if (process > 0) kill(process, SIGKILL);
      return;
    }
  }

 private:
  std::string out_;
  pid_t pid_ = 0;
};

// The object of --json. Both streams are in one file, with a line about the points outside the model.
nlohmann::json object_in(const std::string& printed) {
  const std::size_t begin = printed.find('{');
  return nlohmann::json::parse(printed.substr(begin, printed.rfind('}') + 1 - begin));
}

}  // namespace

TEST_CASE("two ranks give the same rows as one process, bit for bit", "[cli][sweep][mpi]") {
  const MpiStudy study(kQuickScene);
  MpiRun run(study, 2, {}, {"--json"});
  const int status = run.wait();
  CAPTURE(run.printed());
  CHECK(status == 0);
  CHECK(study.rows(study.store) == study.whole());
  const std::string printed = run.printed();
  CHECK(printed.find("10 of the 30 points answered now are refused") != std::string::npos);
  const auto object = object_in(printed);
  CHECK(object["schema"] == "viscard-sweep/1");
  CHECK(object["answered"] == 30);
  CHECK(object["failed"] == 0);
  CHECK(object["refused"] == 10);
}

TEST_CASE("a rank that is killed ends the job, and the next one goes on with the points left",
          "[cli][sweep][mpi][slow]") {
  const MpiStudy study(kSlowScene);
  MpiRun first(study, 3, {}, {});
  first.kill_rank(1, study, 4);
  CHECK(first.wait() != 0);
  const std::size_t n_done = StudyStore(study.store, read_study(study.study)).done().size();
  CHECK(n_done >= 4);
  CHECK(n_done < 30);
  MpiRun second(study, 3, {}, {"--json"});
  CHECK(second.wait() == 0);
  CAPTURE(second.printed());
  CHECK(object_in(second.printed())["answered"] == 30 - n_done);
  CHECK(study.rows(study.store) == study.whole());
}

TEST_CASE("with --enable-recovery others answer the point of a rank that is killed",
          "[cli][sweep][mpi][slow]") {
  const MpiStudy study(kSlowScene);
  MpiRun run(study, 4, {"--enable-recovery"}, {"--lost-after", "2 s"});
  run.kill_rank(2, study, 4);
  const int status = run.wait();
  CAPTURE(run.printed());
  CHECK(status == 0);
  CHECK(run.printed().find("rank 2 has been silent for 2 s") != std::string::npos);
  CHECK(study.rows(study.store) == study.whole());
}

TEST_CASE("mistakes end all ranks at once with the status of viscard sweep",
          "[cli][sweep][mpi][slow]") {
  const MpiStudy study(kQuickScene);
  MpiRun bad_word(study, 2, {}, {"--lost-after", "0.1 s"});
  CHECK(bad_word.wait() == 2);
  CHECK(bad_word.printed().find("at least 1 s") != std::string::npos);
  write_file(study.study, "scene = \"nowhere.toml\"\n", true);
  MpiRun no_scene(study, 2, {}, {});
  CHECK(no_scene.wait() == 1);
  CHECK(no_scene.printed().find("nowhere.toml") != std::string::npos);
}
