#pragma once

#include "io/cards/proof/solver.h"

#include <string>
#include <vector>

namespace viscard {

// The solvers that viscard card --prove can run.
const std::vector<Solver>& solvers();

// By its name, or if that is empty the one that reads cards of the target. Throws
// std::invalid_argument listing the names, or saying that no solver reads these cards.
const Solver& solver_for(const std::string& name, const std::string& target);

// At the given path, or the first of its programs in PATH that states its version. Throws
// std::runtime_error saying how to install it.
FoundSolver find_solver(const Solver& solver, const std::string& path);

// Models and outputs, each defined in the file of its solvers.
std::vector<DeckFile> sfepy_model(const std::vector<SolverTask>& tasks);
std::vector<DeckFile> dolfinx_model(const std::vector<SolverTask>& tasks);
std::vector<SolverSample> calculix_samples(const std::filesystem::path& folder,
                                           const DeckInput& input, std::size_t number);
std::vector<SolverSample> febio_samples(const std::filesystem::path& folder, const DeckInput& input,
                                        std::size_t number);
std::vector<SolverSample> mtest_samples(const std::filesystem::path& folder, const DeckInput& input,
                                        std::size_t number);
std::vector<SolverSample> frontistr_samples(const std::filesystem::path& folder,
                                            const DeckInput& input, std::size_t number);
std::vector<SolverSample> python_samples(const std::filesystem::path& folder,
                                         const DeckInput& input, std::size_t number);
// OpenRadioss (openradioss_model.cpp).
std::vector<DeckFile> openradioss_model(const std::vector<SolverTask>& tasks);
std::vector<SolverSample> openradioss_samples(const std::filesystem::path& folder,
                                              const DeckInput& input, std::size_t number);
double openradioss_most_ramps(const Material& material);
ElementTestOptions openradioss_test();

}  // namespace viscard
