#pragma once

// Runs the module that a card of rubber for SfePy is, with SfePy's own terms.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace viscard::test {

// The module cube.py: nominal stresses of a cube of one element along a ramp of stretches, with a bulk modulus of
// `factor` times that of the card.
constexpr const char* kSfepyCube = R"python(import numpy as np
from sfepy.base.base import output
output.set_output(quiet=True)
from sfepy.discrete import Equation, Equations, FieldVariable, Integral, Material, Problem
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field
from sfepy.mesh.mesh_generators import gen_block_mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term
import rubber


def stresses(mode, ramp, factor):
    domain = FEDomain("cube", gen_block_mesh([1, 1, 1], [2, 2, 2], [0.5, 0.5, 0.5], verbose=False))
    omega = domain.create_region("Omega", "all")
    face = {
        axis + end: domain.create_region(axis + end, f"vertices in ({axis} {rule})", "facet")
        for axis in "xyz" for end, rule in (("0", "< 0.001"), ("1", "> 0.999"))
    }
    field = Field.from_args("f", np.float64, "vector", omega, approx_order=1)
    u = FieldVariable("u", "unknown", field)
    v = FieldVariable("v", "test", field, primary_var_name="u")
    numbers = rubber.material()
    numbers["K"] *= factor
    values, integral = Material("rubber", values=numbers), Integral("i", order=2)
    balance = None
    for text in rubber.terms():
        term = Term.new(text, integral, omega, rubber=values, v=v, u=u)
        balance = term if balance is None else balance + term
    problem = Problem("p", equations=Equations([Equation("balance", balance)]))
    problem.set_solver(Newton({"i_max": 40, "eps_a": 1e-9, "eps_r": 1.0}, lin_solver=ScipyDirect({})))
    state, out = None, []
    for stretch in ramp:
        held = [("x0", "u.0", 0.0), ("y0", "u.1", 0.0), ("z0", "u.2", 0.0), ("z1", "u.2", stretch - 1)]
        held += [("y1", "u.1", 0.0)] if mode == "planar" else []
        held += [("x1", "u.0", stretch - 1)] if mode == "equibiaxial" else []
        bcs = [EssentialBC(region, face[region], {dof: value}) for region, dof, value in held]
        problem.set_bcs(ebcs=Conditions(bcs))
        options = {"save_results": False, "verbose": False}
        state = problem.solve(**options) if state is None else problem.solve(state0=state, **options)
        problem.remove_bcs()
        force = problem.get_evaluator().eval_residual(state(), is_full=True).reshape(-1, 3)
        out.append(force[problem.domain.get_mesh_coors()[:, 2] > 0.999, 2].sum())
    return np.array(out)
)python";

inline bool has_sfepy() {
  if (std::system("/usr/bin/python3 -c 'import sfepy' >/dev/null 2>&1") == 0) return true;
  WARN("sfepy is not installed for /usr/bin/python3; it is not run");
  return false;
}

// The numbers that a script prints which imports the card as `rubber` and may import `cube`.
inline std::vector<double> numbers_from_sfepy(const std::string& card, const std::string& script) {
  namespace folders = std::filesystem;
  std::string name = (folders::temp_directory_path() / "viscard-sfepy-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const folders::path folder = name;
  std::ofstream(folder / "cube.py") << kSfepyCube;
  std::ofstream(folder / "rubber.py") << card;
  std::ofstream(folder / "script.py") << script;
  const std::string command =
      "cd '" + folder.string() + "' && /usr/bin/python3 -B -W ignore script.py >answer 2>log";
  const bool has_run = std::system(command.c_str()) == 0;
  std::ifstream log(folder / "log");
  INFO(std::string(std::istreambuf_iterator<char>(log), {}));
  REQUIRE(has_run);
  std::ifstream answer(folder / "answer");
  std::vector<double> out;
  for (double value = 0.0; answer >> value;) out.push_back(value);
  folders::remove_all(folder);
  return out;
}

}  // namespace viscard::test
