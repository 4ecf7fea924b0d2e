#include "io/cards/proof/solvers.h"

#include "io/basics/patterns.h"
#include "io/basics/words.h"
#include "io/cards/card.h"
#include "io/cards/proof/cube_stress.h"
#include "io/cards/proof/solver_cubes.h"
#include "io/cards/targets/card_targets.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

namespace fs = std::filesystem;
using Commands = std::vector<std::vector<std::string>>;

// A small strain for solvers of finite strain, and the error that it leaves.
constexpr double kFiniteStrain = 1e-5;

template <CardTarget (*target)()>
std::vector<DeckFile> model_of(const std::vector<SolverTask>& tasks) {
  return target().deck->files(tasks.front().input, "deck");
}

// Both forms of FEBio share one writer of models; the card decides.
Solver febio_solver() {
  return {.name = "febio",
          .code = "FEBio",
          .programs = {"febio4", "febio", "febio3"},
          .install = "Debian has no FEBio; get it from febio.org or name it with --solver-path",
          .targets = {"febio", "febio-uncoupled"},
          .test = febio_target().deck->test,
          .resolves = kFiniteStrain,
          .model = model_of<febio_target>,
          .commands = [](const std::string& program) -> Commands {
            return {{program, "-noconfig", "-i", "deck.feb"}};
          },
          .samples = febio_samples,
          .cubes = CubeRunner{0.04, VolumeRule::kLogSquared, true, false, febio_cube, febio_rows},
          .error = "E R R O R   T E R M I N A T I O N",
          .has_finite_strain = true,
          .version_words = {"-info"},
          .version_pattern = "FEBio version\\s*=\\s*(\\S+)"};
}

Solver calculix_solver() {
  return {
      .name = "calculix",
      .code = "CalculiX",
      .programs = {"ccx"},
      .install = "run: apt-get install calculix-ccx, or name it with --solver-path",
      .targets = {"calculix"},
      .test = calculix_target().deck->test,
      // ccx prints seven digits, 5e-7 relative; the weights of the extrapolation,
      // (8, -6, 1)/3, multiply their rounding by up to 5.
      .resolves = 3e-6,
      .is_backward_euler = true,
      .model = model_of<calculix_target>,
      .commands = [](const std::string& program) -> Commands {
        return {{program, "deck"}};
      },
      .samples = calculix_samples,
      // It iterates twice, so that the steps of a stretch are small.
      .cubes = CubeRunner{0.04, VolumeRule::kUnitVolume, false, true, calculix_cube, calculix_rows},
      // checkconvergence.c: an increment that the creep law of a point could not solve.
      .divergence = "solution seems to diverge",
      .error = "*ERROR",
      .version_words = {"-v"},
      .version_pattern = "Version (\\S+)"};
}

// The program of this name beside another one, else that of PATH.
std::string beside(const std::string& program, const std::string& name) {
  const fs::path path = fs::path(program).parent_path() / name;
  return fs::exists(path) ? path.string() : name;
}

Commands mtest_commands(const std::string& program) {
  return {{beside(program, "mfront"), "--obuild", "--interface=generic", "card.mfront"},
          {program, "deck.mtest"}};
}

Solver mtest_solver() {
  return {.name = "mtest",
          .code = "MTest",
          .programs = {"mtest"},
          .install =
              "Debian has no TFEL; build it from github.com/thelfer/tfel, or name mtest with "
              "--solver-path",
          .targets = {"mfront"},
          .test = mfront_target().deck->test,
          .resolves = 1e-8,
          .model = model_of<mfront_target>,
          .commands = mtest_commands,
          .samples = mtest_samples,
          .cubes = CubeRunner{0.1, VolumeRule::kUnitVolume, true, false, mtest_cube, mtest_rows},
          .version_words = {"--version"},
          .version_pattern = "(\\d+\\.\\d+\\S*)",
          // MTestMain.cxx of TFEL 5.2 states no version.
          .answer = "mtest is an behaviour testing utility",
          .neighbour = "mfront"};
}

Solver frontistr_solver() {
  return {.name = "frontistr",
          .code = "FrontISTR",
          .programs = {"fistr1"},
          .install =
              "Debian has no FrontISTR; get it from www.frontistr.com, or name fistr1 with "
              "--solver-path",
          .targets = {"frontistr"},
          .test = frontistr_target().deck->test,
          // Error of its equilibrium iteration (CONVERG of the model), 3e-8 seen at nu = 0.495.
          .resolves = 1e-6,
          .model = model_of<frontistr_target>,
          .commands = [](const std::string& program) -> Commands { return {{program}}; },
          .samples = frontistr_samples,
          .divergence = "Fail to Converge",  // and its exit status is 0
          .version_words = {"-v"},
          .version_pattern = "([Vv]ersion[: ]*)?(\\d+\\.\\d+\\S*)"};
}

// The engine, and the converter of its time history, beside a starter: the names of all three end
// alike (HOWTO.md of OpenRadioss, tools/th_to_csv/linux64/build.bash).
Commands openradioss_commands(const std::string& program) {
  std::string engine = fs::path(program).filename().string();
  const std::size_t at = engine.find("starter");
  const std::string ending = at == std::string::npos ? "" : engine.substr(at + 7);
  if (at != std::string::npos) engine.replace(at, 7, "engine");
  std::string converter = beside(program, "th_to_csv" + ending);
  if (converter.find('/') == std::string::npos) {
    converter = beside(program, "th_to_csv_linux64_gf");
  }
  return {{program, "-i", "deck_0000.rad", "-np", "1"},
          {beside(program, engine), "-i", "deck_0001.rad"},
          {converter, "deckT01"}};
}

Solver openradioss_solver() {
  return {
      .name = "openradioss",
      .code = "OpenRadioss",
      .programs = {"starter_linux64_gf", "starter_linux64_ifx", "starter_linuxa64"},
      .install =
          "Debian has no OpenRadioss; get it from github.com/OpenRadioss/OpenRadioss with its "
          "tool th_to_csv, set RAD_CFG_PATH and LD_LIBRARY_PATH as its INSTALL.md describes, and "
          "name its starter with --solver-path; engine and th_to_csv are taken from beside it",
      .targets = {"openradioss"},
      .test = openradioss_test(),
      // The strain of 1e-5, and six decimals of 10 (openradioss_model.cpp).
      .resolves = 2.0 * kFiniteStrain,
      .model = openradioss_model,
      .commands = openradioss_commands,
      .samples = openradioss_samples,
      .divergence = "ENERGY ERROR LIMIT REACHED",
      .error = "ERROR TERMINATION",
      // Of strain: six decimals of a displacement would show little of a stiff answer.
      .confined = ElementTestKind::kConfined,
      .version_words = {"-version"},
      // execargcheck.F of the starter states no version but this.
      .version_pattern = "OpenRadioss Starter[\\s\\S]*Date of build : *(\\S[^\\n]*\\S)",
      .most_ramps = openradioss_most_ramps,
      .counted = "times compared",
      .caution =
          "OpenRadioss itself has never run this test: its running and reading were tested "
          "with a stand-in, from its published source"};
}

// One of the two Python packages. Python's own error names the missing part.
Solver python_solver(const char* name, const char* code, const char* package,
                     std::vector<DeckFile> (*model)(const std::vector<SolverTask>&)) {
  return {.name = name,
          .code = code,
          .programs = {"python3", "/usr/bin/python3"},
          .install = std::string("run: apt-get install ") + package +
                     ", or name a python3 that has it with --solver-path",
          .test = calculix_target().deck->test,
          .resolves = 1e-8,
          .is_backward_euler = true,
          .model = model,
          .commands = [](const std::string& program) -> Commands {
            return {{program, "deck.py"}};
          },
          .samples = python_samples,
          .runs_together = true,
          .is_scaled = false,
          .version_words = {"-c", std::string("import ") + name + "; print('version', " + name +
                                      ".__version__)"},
          .version_pattern = "version (\\S+)"};
}

// All cubes of SfePy by one run; each of some 10 ms.
Solver with_cubes(Solver solver) {
  solver.cubes = CubeRunner{0.1, VolumeRule::kWholeOgden, true};
  return solver;
}

// The program in every folder of PATH, or itself if it is a path.
std::vector<std::string> paths_of(const std::string& program) {
  if (program.find('/') != std::string::npos) return {program};
  std::vector<std::string> out;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder.empty() ? "." : folder) / program;
    if (::access(candidate.c_str(), X_OK) == 0) out.push_back(candidate.string());
  }
  return out;
}

// The version that a program states; empty if it is not this solver.
std::string version_of(const Solver& solver, const std::string& program) {
  std::string text = printed_by(program, solver.version_words);
  const bool has_neighbour = *solver.neighbour != '\0';
  if (has_neighbour && text.find(solver.answer) != std::string::npos) {
    text = printed_by(beside(program, solver.neighbour), solver.version_words);
  }
  const auto match = first_match(text, solver.version_pattern);
  return match ? match->group.back() : "";
}

}  // namespace

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> table{
      calculix_solver(),
      febio_solver(),
      mtest_solver(),
      frontistr_solver(),
      openradioss_solver(),
      with_cubes(python_solver("sfepy", "SfePy", "python3-sfepy", sfepy_model)),
      python_solver("dolfinx", "dolfinx", "python3-dolfinx", dolfinx_model)};
  return table;
}

const Solver& solver_for(const std::string& name, const std::string& target) {
  std::vector<std::string> names;
  for (const Solver& solver : solvers()) {
    const auto& targets = solver.targets;
    // A module for Python is run by its package, without a name.
    const bool reads =
        solver.name == target || std::find(targets.begin(), targets.end(), target) != targets.end();
    const bool is_named = solver.name == name;
    if (is_named && !targets.empty() && !reads) {
      throw std::invalid_argument(solver.code + " does not read cards for " + target +
                                  "; sfepy and dolfinx run the numbers of any card");
    }
    if (is_named || (name.empty() && reads)) return solver;
    names.push_back(solver.name);
  }
  if (name.empty()) {
    throw std::invalid_argument("viscard runs no solver that reads cards for " + target +
                                "; --solver sfepy or dolfinx runs the card's numbers, and --deck "
                                "writes a model for the solver itself");
  }
  throw std::invalid_argument("there is no solver '" + name + "'; there are " + listed(names));
}

FoundSolver find_solver(const Solver& solver, const std::string& path) {
  if (!path.empty()) {
    const std::string program = fs::exists(path) ? fs::absolute(path).string() : path;
    const std::string version = version_of(solver, program);
    if (version.empty()) {
      throw std::runtime_error(path + " does not answer as " + solver.code + " does; " +
                               solver.install);
    }
    return {solver, program, version};
  }
  for (const std::string& name : solver.programs) {
    for (const std::string& program : paths_of(name)) {
      const std::string version = version_of(solver, program);
      if (!version.empty()) return {solver, program, version};
    }
  }
  throw std::runtime_error(solver.code + " is not installed; " + solver.install);
}

}  // namespace viscard
