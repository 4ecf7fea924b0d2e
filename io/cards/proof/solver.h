#pragma once

#include "io/cards/deck.h"
#include "io/cards/one_element.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

struct SolverSample {
  double time_s = 0.0;
  double value = 0.0;  // response over the amplitude, as exact_response returns it
};

struct SolverRun {
  std::vector<SolverSample> samples;  // after every increment, until it diverged
  bool diverged = false;              // an increment that does not converge, not the syntax
};

// One test of a card. `input.card.written` is the material that the card should be, `as_read` what
// its reader found in it.
struct SolverTask {
  DeckInput input;
  const Material& as_read;
};

struct CubeTest;
struct CubeRow;
enum class VolumeRule;

// How a solver stretches cubes of a law of rubber (law_proof.h): each test by a run of its own, of the card's text; or
// all by one, without `files`, which imports a module.
struct CubeRunner {
  double step;  // largest one of the stretch
  VolumeRule rule;
  bool has_memory = false;  // runs terms of relaxation
  bool has_run = true;      // the solver itself, not a stand-in
  std::vector<DeckFile> (*files)(const std::string& card, const CubeTest& test) = nullptr;
  std::vector<CubeRow> (*rows)(const std::filesystem::path& folder, const CubeTest& test) = nullptr;
};

// What a program needs to run the one-element model of a card.
struct Solver {
  std::string name;                   // as on the command line: "calculix"
  std::string code;                   // "CalculiX"
  std::vector<std::string> programs;  // the first of them in PATH is taken
  std::string install;                // what to do if none is there
  std::vector<std::string> targets;   // cards it reads; none: it runs the numbers of any card
  ElementTestOptions test;
  double resolves = 0.0;  // smallest relative error that its output and its strain show
  // The branches follow backward Euler, so the error of a step can be computed beforehand.
  bool is_backward_euler = false;
  // Of all tests at once if runs_together, else of the only one.
  std::vector<DeckFile> (*model)(const std::vector<SolverTask>& tasks) = nullptr;
  // Run one after the other in the folder of the model.
  std::vector<std::vector<std::string>> (*commands)(const std::string& program) = nullptr;
  // Of the test of this number, in the units of the card; sign and scale are settled by the caller.
  std::vector<SolverSample> (*samples)(const std::filesystem::path& folder, const DeckInput& input,
                                       std::size_t number) = nullptr;
  std::optional<CubeRunner> cubes = std::nullopt;  // none: it runs no laws of rubber
  bool runs_together = false;                      // one start of the program runs all tests
  bool is_scaled = true;        // samples are forces or stresses and strains; false: in SI
  const char* divergence = "";  // in the log of an increment that does not converge
  const char* error = "";       // in the log of a run that failed, with any exit status
  ElementTestKind confined = ElementTestKind::kConfinedCreep;  // its test with held sides
  // Strains are finite: the error that they leave is at most twice the largest strain of a test.
  bool has_finite_strain = false;
  std::vector<std::string> version_words;  // arguments that print the version
  const char* version_pattern = "";        // regular expression; its group is the version
  // For a program that answers with these words and no version: the one beside it that states it.
  const char* answer = "";
  const char* neighbour = "";
  // For a solver whose steps are set by the speed of sound: how many lengths of its ramp a test of
  // this material may last.
  double (*most_ramps)(const Material& material) = nullptr;
  const char* counted = "increments";  // what its samples are
  const char* caution = "";            // what to know before trusting a run of it
};

struct FoundSolver {
  const Solver& solver;
  std::string program;  // path
  std::string version;
};

// Runs the tests in temporary folders, up to the first that diverges. Throws std::runtime_error with
// one line if the program is missing, stops, takes more than ten minutes of processor time, or prints
// nothing.
std::vector<SolverRun> run_solver(const FoundSolver& found, const std::vector<SolverTask>& tasks);

// Runs the solver's commands on these files in a temporary folder, and calls `read` with its path before it is
// removed. False if the solution diverged. Throws as run_solver() does.
bool run_files(const FoundSolver& found, const std::vector<DeckFile>& files,
               const std::function<void(const std::filesystem::path&)>& read);

// What the program prints for these arguments, in at most 30 s of processor time; "" if it cannot be
// run.
std::string printed_by(const std::string& program, const std::vector<std::string>& words);

}  // namespace viscard
