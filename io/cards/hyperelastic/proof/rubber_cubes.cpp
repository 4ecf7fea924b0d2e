// Models of one cube on rollers. CalculiX reads the card's own text. SfePy imports the module and stretches the
// cube with its terms; for the terms of relaxation its answers with K, 2 K and 4 K, extrapolated to an
// incompressible body, give the second Piola-Kirchhoff stress that the module's Memory relaxes.
#include "io/cards/hyperelastic/proof/rubber_cubes.h"

#include "io/basics/atomic_file.h"
#include "io/cards/card_lines.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

std::string material_name(const std::string& card) {
  for (const KeywordBlock& block : keyword_blocks(card_lines(card, "**"), '*')) {
    if (block.keyword == "*MATERIAL" && !block.name().empty()) return block.name();
  }
  throw std::runtime_error("the card has no *MATERIAL, NAME=...");
}

constexpr const char* kSfepyCubes = R"py(
import numpy as np
import sfepy
from sfepy.base.base import output
from sfepy.discrete import Equation, Equations, FieldVariable, Integral, Material, Problem
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field
from sfepy.mesh.mesh_generators import gen_block_mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term

import card

output.set_output(quiet=True)


def stresses(mode, ramp, factor):
    """Nominal stresses of one element with a bulk modulus of `factor` times that of the card, and the
    forces that the iteration left on free sides, relative to that of the stretch."""
    shape = (2, 2, 3 if mode == "confined" else 2)
    domain = FEDomain("cube", gen_block_mesh((1, 1, 1), shape, (0.5, 0.5, 0.5), verbose=False))
    omega = domain.create_region("Omega", "all")
    face = {
        axis + end: domain.create_region(axis + end, f"vertices in ({axis} {rule})", "facet")
        for axis in "xyz" for end, rule in (("0", "< 0.001"), ("1", "> 0.999"))
    }
    field = Field.from_args("f", np.float64, "vector", omega, approx_order=1)
    u = FieldVariable("u", "unknown", field)
    v = FieldVariable("v", "test", field, primary_var_name="u")
    numbers = card.material()
    numbers["K"] *= factor
    values, integral = Material("rubber", values=numbers), Integral("i", order=2)
    balance = None
    for text in card.terms():
        term = Term.new(text, integral, omega, rubber=values, v=v, u=u)
        balance = term if balance is None else balance + term
    problem = Problem("p", equations=Equations([Equation("balance", balance)]))
    newton = {"i_max": 30, "eps_a": 1e-13 * numbers["K"], "eps_r": 1.0}
    problem.set_solver(Newton(newton, lin_solver=ScipyDirect({})))
    top = problem.domain.get_mesh_coors()[:, 2] > 0.999
    state, out, left = None, [], []
    for stretch in ramp:
        held = [("x0", "u.0", 0.0), ("y0", "u.1", 0.0), ("z0", "u.2", 0.0), ("z1", "u.2", stretch - 1)]
        held += [("y1", "u.1", 0.0)] if mode in ("planar", "confined") else []
        held += [("x1", "u.0", 0.0)] if mode == "confined" else []
        held += [("x1", "u.0", stretch - 1)] if mode == "equibiaxial" else []
        bcs = [EssentialBC(region, face[region], {dof: value}) for region, dof, value in held]
        problem.set_bcs(ebcs=Conditions(bcs))
        options = {"save_results": False, "verbose": False}
        state = problem.solve(**options) if state is None else problem.solve(state0=state, **options)
        problem.remove_bcs()
        force = problem.get_evaluator().eval_residual(state(), is_full=True).reshape(-1, 3)
        free = np.ones_like(force, dtype=bool)
        for region, dof, _ in held:
            free[face[region].vertices, int(dof[-1])] = False
        out.append(force[top, 2].sum())
        left.append(np.abs(force[free]).sum() / abs(out[-1]))
    return np.array(out), np.array(left)


def relaxed(elastic, ramp, length, until):
    """Stress of a body with free sides and constant volume, by the memory of the card."""
    memory, time = card.Memory(1), 0.0
    steps = [(length * (i + 1) / len(ramp), s, P) for i, (s, P) in enumerate(zip(ramp, elastic))]
    steps += [(end, ramp[-1], elastic[-1]) for end in until]
    for end, s, P in steps:
        d = P * s  # axial Kirchhoff stress
        memory.advance(end - time, np.diag([-d * s / 3, -d * s / 3, 2 * d / (3 * s**2)])[None])
        time = end
        S = memory.stress()[0]
        yield time, s * S[2, 2] - S[0, 0] / s**2


for number, (mode, last, steps) in enumerate(tests):
    ramp = np.linspace(1.0, last, steps + 1)[1:]
    with open(f"result_{number}.txt", "w") as result:
        for row in zip(ramp, *stresses(mode, ramp, 1.0)):
            print(*(repr(float(number)) for number in row), file=result)
if hold:
    last, length, steps, until = hold
    ramp = np.linspace(1.0, last, steps + 1)[1:]
    one, two, four = (stresses("uniaxial", ramp, factor)[0] for factor in (1.0, 2.0, 4.0))
    coarse, fine = 2 * two - one, (4 * (2 * four - two) - (2 * two - one)) / 3
    with open(f"result_{len(tests)}.txt", "w") as result:
        for (time, a), (_, b) in zip(relaxed(fine, ramp, length, until), relaxed(coarse, ramp, length, until)):
            print(repr(float(time)), repr(float(a)), 0.0, repr(float(b)), file=result)
)py";

}  // namespace

std::vector<DeckFile> calculix_cube(const std::string& card, const CubeTest& test) {
  const bool is_confined = test.is_confined;
  std::string text =
      "*NODE,NSET=ALL\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
  if (is_confined) text += "9,0,0,0.5\n10,1,0,0.5\n11,1,1,0.5\n12,0,1,0.5\n";
  text +=
      "*NSET,NSET=TOP\n5,6,7,8\n*NSET,NSET=BASE\n1,2,3,4\n*NSET,NSET=LEFT\n1,4,5,8\n"
      "*NSET,NSET=RIGHT\n2,3,6,7\n*NSET,NSET=FRONT\n1,2,5,6\n*NSET,NSET=BACK\n3,4,7,8\n"
      "*ELEMENT,TYPE=C3D8,ELSET=CUBE\n";
  text += is_confined ? "1,1,2,3,4,9,10,11,12\n2,9,10,11,12,5,6,7,8\n" : "1,1,2,3,4,5,6,7,8\n";
  text += card + "\n*SOLID SECTION,ELSET=CUBE,MATERIAL=" + material_name(card) +
          "\n*BOUNDARY\nBASE,3,3\nLEFT,1,1\nFRONT,2,2\n";
  if (test.deformation == Deformation::kPlanar || is_confined) text += "BACK,2,2\n";
  if (is_confined) text += "RIGHT,1,1\n9,1,2\n10,1,2\n11,1,2\n12,1,2\n";
  text += fmt::format("*STEP,NLGEOM,INC=100000\n*STATIC,DIRECT\n{},1\n*BOUNDARY\nTOP,3,3,{}\n",
                      1.0 / test.steps, test.top - 1.0);
  if (test.deformation == Deformation::kEquibiaxial)
    text += fmt::format("RIGHT,1,1,{}\n", test.top - 1.0);
  return {{"deck.inp", text + "*NODE PRINT,NSET=TOP,FREQUENCY=1\nRF\n*END STEP\n"}};
}

// "forces ... and time  0.1E+00", a blank line, then node and three forces a row. Nodes 6 and 7 carry the force of the
// side x = 1, nodes 7 and 8 that of y = 1, each with the two below them.
std::vector<CubeRow> calculix_rows(const std::filesystem::path& folder, const CubeTest& test) {
  std::vector<CubeRow> rows;
  if (!std::filesystem::exists(folder / "deck.dat")) return rows;
  const bool x_is_free = test.deformation != Deformation::kEquibiaxial && !test.is_confined,
             y_is_free = test.deformation != Deformation::kPlanar && !test.is_confined;
  std::istringstream lines(read_own_file(folder / "deck.dat"));
  for (std::string line; std::getline(lines, line);) {
    if (line.find("and time") != std::string::npos) {
      const double share = static_cast<double>(rows.size() + 1) / test.steps;
      rows.push_back({.at = 1.0 + (test.top - 1.0) * share});
      continue;
    }
    std::vector<double> cells_of_row;
    std::istringstream words(line);
    for (std::string word; words >> word;) cells_of_row.push_back(leading_number(word));
    if (cells_of_row.size() != 4 || rows.empty()) continue;
    const double node = cells_of_row[0];
    rows.back().stress += cells_of_row[3];
    if (x_is_free && (node == 6.0 || node == 7.0))
      rows.back().unbalanced += 2.0 * std::abs(cells_of_row[1]);
    if (y_is_free && (node == 7.0 || node == 8.0))
      rows.back().unbalanced += 2.0 * std::abs(cells_of_row[2]);
  }
  for (CubeRow& row : rows) row.unbalanced /= std::abs(row.stress);
  return rows;
}

std::vector<DeckFile> sfepy_cubes(const std::string& card, const std::vector<CubeTest>& tests,
                                  const CubeHold* hold) {
  std::string text = "tests = [\n";
  for (const CubeTest& test : tests)
    text += fmt::format("    (\"{}\", {}, {}),\n",
                        test.is_confined ? "confined" : name_of(test.deformation), test.top,
                        test.steps);
  text += "]\nhold = ";
  if (hold == nullptr) {
    text += "None\n";
  } else {
    text += fmt::format("({}, {}, {}, [", hold->top, hold->ramp, hold->steps);
    for (const double end : hold->until) text += fmt::format("{}, ", end);
    text += "])\n";
  }
  return {{"deck.py", text + kSfepyCubes}, {"card.py", card}};
}

std::vector<CubeRow> sfepy_rows(const std::filesystem::path& folder, std::size_t number) {
  std::vector<CubeRow> rows;
  const auto path = folder / fmt::format("result_{}.txt", number);
  if (!std::filesystem::exists(path)) return rows;
  std::istringstream lines(read_own_file(path));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    CubeRow row;
    std::string word;
    if (words >> word) row.at = leading_number(word);
    if (words >> word) row.stress = leading_number(word);
    if (words >> word) row.unbalanced = leading_number(word);
    if (words >> word) row.coarser = leading_number(word);  // of a hold
    rows.push_back(row);
  }
  return rows;
}

}  // namespace viscard
