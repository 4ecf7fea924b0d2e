// Models of one cube on rollers. CalculiX, FEBio and MTest read the card's own text (Rz: FEBioMechModule.cpp; MTest
// keywords: TFEL's mtest/doc). SfePy imports the module and stretches the
// cube with its terms; for the terms of relaxation its answers with K, 2 K and 4 K, extrapolated to an
// incompressible body, give the second Piola-Kirchhoff stress that the module's Memory relaxes.
#include "io/cards/proof/solver_cubes.h"

#include "io/basics/atomic_file.h"
#include "io/basics/patterns.h"
#include "io/cards/card_lines.h"
#include "io/cards/keyword_lines.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

// Of row n, counted from 1; of the holds the last.
double stretch_at(const CubeTest& test, std::size_t n) {
  const double share = static_cast<double>(n) / test.steps;
  return 1.0 + (test.top - 1.0) * std::min(share, 1.0);
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

std::vector<DeckFile> febio_cube(const std::string& card, const CubeTest& test) {
  const auto name = first_match(card, "<material[^>]*\\sname=\"([^\"]*)\"");
  if (!name) throw std::runtime_error("the card has no <material name=\"...\">");
  std::vector<std::array<double, 3>> points;
  for (const auto& [x, y, z] : kCubeCorners) points.push_back({double(x), double(y), double(z)});
  if (test.is_confined) {
    for (int i = 0; i < 4; ++i) points.push_back({points[i][0], points[i][1], 0.5});
  }
  std::string mesh = "<Mesh>\n<Nodes name=\"nodes\">\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh += fmt::format("<node id=\"{}\">{},{},{}</node>\n", i + 1, points[i][0], points[i][1],
                        points[i][2]);
  mesh += "</Nodes>\n<Elements type=\"hex8\" name=\"cube\">";
  mesh += test.is_confined ? "<elem id=\"1\">1,2,3,4,9,10,11,12</elem>"
                             "<elem id=\"2\">9,10,11,12,5,6,7,8</elem>"
                           : "<elem id=\"1\">1,2,3,4,5,6,7,8</elem>";
  mesh += "</Elements>\n";
  for (const char* face : {"x0", "y0", "z0", "x1", "y1", "z1"}) {
    std::string nodes;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i][static_cast<std::size_t>(face[0] - 'x')] == double(face[1] - '0'))
        nodes += (nodes.empty() ? "" : ",") + std::to_string(i + 1);
    }
    mesh += fmt::format("<NodeSet name=\"{}\">{}</NodeSet>\n", face, nodes);
  }
  mesh += "</Mesh>\n<MeshDomains><SolidDomain name=\"cube\" mat=\"" + name->group[1] +
          "\"/></MeshDomains>\n<Boundary>\n";
  std::vector<std::string> fixed{"x0", "y0", "z0"}, pulled{"z1"};
  if (test.is_confined) fixed.insert(fixed.end(), {"x1", "y1"});
  if (!test.is_confined && test.deformation == Deformation::kPlanar) fixed.emplace_back("y1");
  if (test.deformation == Deformation::kEquibiaxial) pulled.emplace_back("x1");
  for (const std::string& face : fixed) {
    mesh += fmt::format(
        "<bc name=\"fix {0}\" node_set=\"{0}\" type=\"zero displacement\">"
        "<x_dof>{1}</x_dof><y_dof>{2}</y_dof><z_dof>{3}</z_dof></bc>\n",
        face, face[0] == 'x' ? 1 : 0, face[0] == 'y' ? 1 : 0, face[0] == 'z' ? 1 : 0);
  }
  for (const std::string& face : pulled) {
    mesh += fmt::format(
        "<bc name=\"pull {0}\" node_set=\"{0}\" type=\"prescribed displacement\"><dof>{1}</dof>"
        "<value lc=\"1\">{2}</value><relative>0</relative></bc>\n",
        face, face[0], test.top - 1.0);
  }
  std::string steps;
  const auto add_step = [&](int count, double size) {
    steps += fmt::format(
        "<step><Control><analysis>STATIC</analysis><time_steps>{}</time_steps>"
        "<step_size>{}</step_size><solver type=\"solid\"><dtol>1e-10</dtol><etol>1e-14</etol>"
        "<rtol>0</rtol></solver></Control></step>\n",
        count, size);
  };
  add_step(test.steps, test.ramp / test.steps);
  double before = test.ramp;
  for (const double end : test.until) {
    add_step(1, end - before);
    before = end;
  }
  return {{"deck.feb",
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
           "<Module type=\"solid\"/>\n<Material>\n" +
               card + "</Material>\n" + mesh + "</Boundary>\n" +
               fmt::format("<LoadData><load_controller id=\"1\" type=\"loadcurve\">"
                           "<interpolate>LINEAR</interpolate><extend>CONSTANT</extend><points>"
                           "<pt>0,0</pt><pt>{},1</pt><pt>{},1</pt></points></load_controller>"
                           "</LoadData>\n<Step>\n{}</Step>\n",
                           test.ramp, 2.0 * test.end(), steps) +
               "<Output><logfile><node_data data=\"Rz\" file=\"rz.txt\">5,6,7,8</node_data>"
               "</logfile></Output>\n</febio_spec>\n"}};
}

std::vector<DeckFile> mtest_cube(const std::string& card, const CubeTest& test) {
  const auto name = first_match(card, "@Behaviour\\s+(\\w+)");
  if (!name) throw std::runtime_error("the card has no @Behaviour");
  // Newton's iteration ends where strain and stress both change by less.
  constexpr double kSmall = 1e-11;
  std::string text = fmt::format(
      "@ModellingHypothesis 'Tridimensional';\n@Behaviour<generic> 'src/libBehaviour.so' '{}';\n"
      "@ExternalStateVariable 'Temperature' 293.15;\n@OutputFilePrecision 15;\n"
      "@DeformationGradientEpsilon {};\n@StressEpsilon {};\n",
      name->group[1], kSmall, kSmall * std::abs(test.stress));
  const std::string pulled =
      fmt::format("{{0.: 1., {}: {}, {}: {}}}", test.ramp, test.top, 2.0 * test.end(), test.top);
  const auto impose = [&](const std::string& component, const std::string& value) {
    text += fmt::format("@ImposedDeformationGradient<evolution> '{}' {};\n", component, value);
  };
  impose("FZZ", pulled);
  if (test.is_confined || test.deformation == Deformation::kPlanar) impose("FYY", "1.");
  if (test.is_confined) impose("FXX", "1.");
  if (test.deformation == Deformation::kEquibiaxial) impose("FXX", pulled);
  for (const char* shear : {"FXY", "FYX", "FXZ", "FZX", "FYZ", "FZY"}) impose(shear, "0.");
  text += fmt::format("@Times {{0., {} in {}", test.ramp, test.steps);
  for (const double end : test.until) text += fmt::format(", {} in 1", end);
  return {{"deck.mtest", text + "};\n"}, {"card.mfront", card}};
}

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
      rows.push_back({.at = stretch_at(test, rows.size() + 1)});
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

// FECore/DataRecord.cpp: "*Time  = 0.1" above the rows of nodes.
std::vector<CubeRow> febio_rows(const std::filesystem::path& folder, const CubeTest& test) {
  std::vector<CubeRow> rows;
  if (!std::filesystem::exists(folder / "rz.txt")) return rows;
  std::istringstream lines(read_own_file(folder / "rz.txt"));
  bool is_at_rest = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("*Time", 0) == 0) {
      is_at_rest = leading_number(line.substr(line.find('=') + 1)) == 0.0;
      if (!is_at_rest) rows.push_back({.at = stretch_at(test, rows.size() + 1)});
    } else if (!line.empty() && line[0] != '*' && !is_at_rest) {
      const std::size_t value = line.find_first_not_of(' ', line.find(' '));
      if (value != std::string::npos) rows.back().stress += leading_number(line.substr(value));
    }
  }
  for (CubeRow& row : rows) row.stress = std::copysign(row.stress, test.top - 1.0);
  return rows;
}

// MTest.cxx: time, nine components of F (XX YY ZZ first), six of the Cauchy stress.
std::vector<CubeRow> mtest_rows(const std::filesystem::path& folder, const CubeTest&) {
  std::vector<CubeRow> rows;
  if (!std::filesystem::exists(folder / "deck.res")) return rows;
  std::istringstream lines(read_own_file(folder / "deck.res"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<double> row;
    std::istringstream words(line);
    for (std::string word; words >> word;) row.push_back(leading_number(word));
    constexpr std::size_t kLeast = 16;
    if (row.size() < kLeast || row[0] == 0.0) continue;
    rows.push_back({.at = row[3], .stress = row[12] * row[1] * row[2]});
  }
  return rows;
}

std::vector<DeckFile> sfepy_cubes(const std::string& card, const std::vector<CubeTest>& tests,
                                  const CubeTest* hold) {
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
