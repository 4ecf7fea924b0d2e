// Laws of rubber with terms of relaxation in solvers: the law without its terms in CalculiX, and SfePy with the
// memory of the card's module.
#include "tests/io/cards/rubber_cube.h"
#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string solid_card(const Rubber& solid, const char* target, double bulk_Pa,
                       const std::string& elastic_only = "") {
  return rubber_card(
      solid.law, solid.terms,
      {.target = target, .units = "mm-t-s", .bulk_Pa = bulk_Pa, .elastic_only = elastic_only});
}

// Stretches a cube of one element step by step with the module "rubber.py", with its bulk modulus and with twice
// of it. Their nominal stresses, extrapolated to an incompressible body, give the second Piola-Kirchhoff stress,
// which the module's Memory relaxes. Prints a row for each step: stress of SfePy, the same relaxed, and
// the module's own elastic_stress relaxed.
constexpr const char* kRelaxation = R"python(import numpy as np
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

ramp = np.linspace(1.0, 1.8, 41)[1:]


def tension(factor):
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
    state, stresses = None, []
    for stretch in ramp:
        held = [("x0", "u.0", 0.0), ("y0", "u.1", 0.0), ("z0", "u.2", 0.0), ("z1", "u.2", stretch - 1)]
        bcs = [EssentialBC(region, face[region], {dof: value}) for region, dof, value in held]
        problem.set_bcs(ebcs=Conditions(bcs))
        options = {"save_results": False, "verbose": False}
        state = problem.solve(**options) if state is None else problem.solve(state0=state, **options)
        problem.remove_bcs()
        force = problem.get_evaluator().eval_residual(state(), is_full=True).reshape(-1, 3)
        stresses.append(force[problem.domain.get_mesh_coors()[:, 2] > 0.999, 2].sum())
    return np.array(stresses)


def nominal(memory, s):
    S = memory.stress()[0]
    return s * S[2, 2] - S[0, 0] / s**2


elastic = 2.0 * tension(2.0) - tension(1.0)
by_sfepy, by_module = rubber.Memory(1), rubber.Memory(1)
steps = [(0.5 / len(ramp), s, P) for s, P in zip(ramp, elastic)]
steps += [(dt, ramp[-1], elastic[-1]) for dt in (0.5, 5.0)]
for dt, s, P in steps:
    d = P * s  # axial Kirchhoff stress of a body with free sides
    by_sfepy.advance(dt, np.diag([-d * s / 3.0, -d * s / 3.0, 2.0 * d / (3.0 * s**2)])[None])
    by_module.advance(dt, rubber.elastic_stress(np.diag([s**-0.5, s**-0.5, s])[None]))
    print(repr(float(P)), repr(float(nominal(by_sfepy, s))), repr(float(nominal(by_module, s))))
)python";

// Rows that the script prints.
std::vector<double> relaxation_in_sfepy(const std::string& card) {
  namespace folders = std::filesystem;
  std::string name = (folders::temp_directory_path() / "viscard-memory-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const folders::path folder = name;
  std::ofstream(folder / "cube.py") << kRelaxation;
  std::ofstream(folder / "rubber.py") << card;
  const std::string command =
      "cd '" + folder.string() + "' && /usr/bin/python3 -B -W ignore cube.py >answer 2>log";
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

}  // namespace

TEST_CASE("rubber cards: CalculiX gives the stress at once and after all relaxation",
          "[io][golden]") {
  const double stretch = 1.8;
  for (const Rubber& solid : rubbers()) {
    const double bulk_Pa = 4e3 * youngs_modulus_Pa(solid.law) / 3.0;
    const StretchHistory jump{{0.0, 0.0, 1e6}, {1.0, stretch, stretch}};
    const auto exact_Pa = nominal_stress_Pa(solid.law, solid.terms, Deformation::kUniaxial, jump);
    for (const bool is_at_once : {true, false}) {
      CAPTURE(name_of(solid.law.form), is_at_once);
      const char* when = is_at_once ? "instantaneous" : "long-term";
      const auto force_N = [&](double factor) {
        return run_in_calculix(cube_deck(solid_card(solid, "calculix", factor * bulk_Pa, when),
                                         Deformation::kUniaxial, stretch));
      };
      // Extrapolated to an incompressible body.
      CHECK(2.0 * force_N(2.0) - force_N(1.0) ==
            Approx(1e-6 * exact_Pa[is_at_once ? 1 : 2]).epsilon(2e-6));
    }
  }
}

TEST_CASE("rubber cards: SfePy with the memory of its module gives the relaxing stress", "[io]") {
  if (std::system("/usr/bin/python3 -c 'import sfepy' >/dev/null 2>&1") != 0) {
    WARN("sfepy is not installed for /usr/bin/python3; it is not run");
    return;
  }
  StretchHistory history{{0.0}, {1.0}};
  constexpr int kSteps = 40;
  for (int i = 1; i <= kSteps; ++i) {
    history.time_s.push_back(0.5 * i / kSteps);
    history.stretch.push_back(1.0 + 0.8 * i / kSteps);
  }
  for (const double time_s : {1.0, 6.0}) {
    history.time_s.push_back(time_s);
    history.stretch.push_back(1.8);
  }
  for (const Rubber& solid : rubbers()) {
    CAPTURE(name_of(solid.law.form));
    const auto rows =
        relaxation_in_sfepy(solid_card(solid, "sfepy", 4e3 * youngs_modulus_Pa(solid.law) / 3.0));
    REQUIRE(rows.size() == 3 * (history.time_s.size() - 1));
    const auto exact_Pa =
        nominal_stress_Pa(solid.law, solid.terms, Deformation::kUniaxial, history);
    for (const std::size_t step :
         {std::size_t{5}, std::size_t{40}, std::size_t{41}, std::size_t{42}}) {
      CAPTURE(step);
      const double at_once_MPa =
          1e-6 * nominal_stress_Pa(solid.law, Deformation::kUniaxial, history.stretch[step]);
      const double* row = &rows[3 * (step - 1)];
      CHECK(row[0] == Approx(at_once_MPa).epsilon(2e-6));
      CHECK(row[1] == Approx(1e-6 * exact_Pa[step]).epsilon(2e-6));
      CHECK(row[2] == Approx(1e-6 * exact_Pa[step]).epsilon(1e-10));
    }
  }
}
