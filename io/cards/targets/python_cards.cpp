// Modules for SfePy (terms dw_lin_elastic and dw_lin_prestress, run with 2021.4) and dolfinx (run
// with 0.5.2), and one-element scripts that import them.
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/program_law.h"
#include "io/cards/targets/python_solid.h"

#include <fmt/format.h>

namespace viscard {
namespace {

constexpr const char* kSfepyPart = R"py(

# SfePy: symmetric tensors as vectors 11, 22, 33, 12, 13, 23, shear strains doubled.
_ORDER = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def stiffness(dt):
    """D of dw_lin_elastic for a step."""
    G, K = step_moduli(dt)
    D = np.diag([2.0 * G] * 3 + [G] * 3)
    D[:3, :3] += K - 2.0 * G / 3.0
    return D


def prestress(stress):
    """The argument of dw_lin_prestress from stresses of shape (points, 3, 3)."""
    return np.stack([stress[:, i, j] for i, j in _ORDER], axis=1)[:, :, None]


def tensors(strain):
    """Strains of shape (points, 3, 3) from the values of ev_cauchy_strain."""
    rows = np.reshape(strain, (-1, 6))
    out = np.empty((len(rows), 3, 3))
    for n, (i, j) in enumerate(_ORDER):
        out[:, i, j] = out[:, j, i] = rows[:, n] * (1.0 if i == j else 0.5)
    return out
)py";

constexpr const char* kDolfinxPart = R"py(

# dolfinx: UFL stress of a step. G, K are fem.Constant, set by step_moduli(dt) before each solve;
# known is a fem.Function of a tensor space of degree p - 1, discontinuous, its values set to
# Memory.known_stress(dt).ravel(). After the solve: Memory.advance(dt, strain at those points).
def ufl_stress(strain, G, K, known):
    import ufl

    return 2.0 * G * ufl.dev(strain) + K * ufl.tr(strain) * ufl.Identity(3) + known
)py";

constexpr const char* kSfepyModel = R"py(from sfepy.base.base import output
from sfepy.discrete import (
    Equation, Equations, FieldVariable, Function, Integral, Integrals, Material, Problem)
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term

from card import E0, Memory, np, prestress, stiffness, tensors

output.set_output(quiet=True)
corners = np.array(
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
    dtype=float)
mesh = Mesh.from_data(
    "cube", corners, None, [np.arange(8)[None, :]], [np.zeros(1, dtype=int)], ["3_8"])
domain = FEDomain("cube", mesh)
omega = domain.create_region("Omega", "all")
faces = [
    domain.create_region(axis, "vertices in (%s < 1e-6)" % axis, "facet") for axis in "xyz"]
top = domain.create_region("top", "vertices in (z > 0.999999)", "facet")
field = Field.from_args("u", np.float64, "vector", omega, approx_order=1)
u = FieldVariable("u", "unknown", field)
v = FieldVariable("v", "test", field, primary_var_name="u")
inside, on_top = Integral("i", order=2), Integral("s", order=2)
step = {"dt": 1.0, "known": None, "traction": 0.0}


def solid_values(ts, coors, mode=None, **kwargs):
    if mode != "qp":
        return None
    points = len(coors)
    known = np.zeros((points, 3, 3)) if step["known"] is None else step["known"]
    return {"D": np.tile(stiffness(step["dt"]), (points, 1, 1)), "known": prestress(known)}


def pull_values(ts, coors, mode=None, **kwargs):
    if mode != "qp":
        return None
    values = np.zeros((len(coors), 3, 1))
    values[:, 2, 0] = step["traction"]
    return {"val": values}


solid = Material("solid", function=Function("solid_values", solid_values))
pull = Material("pull", function=Function("pull_values", pull_values))
balance = (
    Term.new("dw_lin_elastic(solid.D, v, u)", inside, omega, solid=solid, v=v, u=u)
    + Term.new("dw_lin_prestress(solid.known, v)", inside, omega, solid=solid, v=v)
    - Term.new("dw_surface_ltr(pull.val, v)", on_top, top, pull=pull, v=v))
problem = Problem("cube", equations=Equations([Equation("balance", balance)]))
problem.set_solver(Newton({}, lin_solver=ScipyDirect({})))
rollers = [EssentialBC("roller" + "xyz"[n], faces[n], {"u.%d" % n: 0.0}) for n in range(3)]


def solve(dt, load, known):
    step.update(dt=dt, known=known, traction=load * E0 if creep else 0.0)
    ends = [] if creep else [EssentialBC("pulled", top, {"u.2": load})]
    problem.set_bcs(ebcs=Conditions(rollers + ends))
    problem.update_materials()
    problem.solve(save_results=False)
    strain = problem.evaluate(
        "ev_cauchy_strain.i.Omega(u)", mode="qp", integrals=Integrals([inside]))
    return tensors(strain)
)py";

constexpr const char* kDolfinxModel = R"py(import ufl
from dolfinx import fem
from dolfinx import mesh as meshes
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI
from petsc4py import PETSc

from card import E0, Memory, np, step_moduli, ufl_stress

cube = meshes.create_unit_cube(MPI.COMM_WORLD, 1, 1, 1)
if hasattr(fem, "functionspace"):  # from 0.7
    V = fem.functionspace(cube, ("Lagrange", 1, (3,)))
    T = fem.functionspace(cube, ("DG", 0, (3, 3)))
else:
    V = fem.VectorFunctionSpace(cube, ("Lagrange", 1))
    T = fem.TensorFunctionSpace(cube, ("DG", 0))
u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
G, K, traction, top = (fem.Constant(cube, PETSc.ScalarType(0.0)) for _ in range(4))
known_stress, point_strain, solution = fem.Function(T), fem.Function(T), fem.Function(V)


def strain_of(displacement):
    return ufl.sym(ufl.grad(displacement))


def face(axis, place):
    return meshes.locate_entities_boundary(cube, 2, lambda x: np.isclose(x[axis], place))


def held(axis, place, value):
    dofs = fem.locate_dofs_topological(V.sub(axis), 2, face(axis, place))
    return fem.dirichletbc(value, dofs, V.sub(axis))


pulled = np.sort(face(2, 1.0))
tags = meshes.meshtags(cube, 2, pulled, np.full(len(pulled), 1, dtype=np.int32))
ds = ufl.Measure("ds", domain=cube, subdomain_data=tags)
stress = ufl_stress(strain_of(u), G, K, known_stress)
balance = ufl.inner(stress, strain_of(v)) * ufl.dx - traction * v[2] * ds(1)
points = T.element.interpolation_points
strain_at_points = fem.Expression(strain_of(solution), points() if callable(points) else points)


def solve(dt, load, known):
    G.value, K.value = step_moduli(dt)
    if known is not None:
        known_stress.x.array[:] = known.ravel()
    conditions = [held(axis, 0.0, PETSc.ScalarType(0.0)) for axis in range(3)]
    if creep:
        traction.value = load * E0
    else:
        top.value = load
        conditions.append(held(2, 1.0, top))
    options = {"ksp_type": "preonly", "pc_type": "lu"}
    LinearProblem(
        ufl.lhs(balance), ufl.rhs(balance), bcs=conditions, u=solution,
        petsc_options=options).solve()
    point_strain.interpolate(strain_at_points)
    return point_strain.x.array.reshape(-1, 3, 3).copy()
)py";

std::string write_sfepy(const CardBody& body) {
  return python_solid(body) + kSfepyPart;
}

std::string write_dolfinx(const CardBody& body) {
  return python_solid(body) + kDolfinxPart;
}

std::vector<DeckFile> sfepy_deck(const DeckInput& input, const std::string& name) {
  return {{name + ".py", kSfepyModel + python_test_loop(input)}, {"card.py", input.card.text}};
}

std::vector<DeckFile> dolfinx_deck(const DeckInput& input, const std::string& name) {
  return {{name + ".py", kDolfinxModel + python_test_loop(input)}, {"card.py", input.card.text}};
}

}  // namespace

CardTarget sfepy_target() {
  return {
      .name = "sfepy",
      .code = "SfePy (Python module)",
      .extension = ".py",
      .comment = "#",
      .write = write_sfepy,
      .read = read_python_solid,
      .deck = DeckWriter{sfepy_deck, "python3 {0}.py > {0}_result.csv"},
      .laws =
          LawColumn{.write = write_sfepy_law,
                    .read = read_sfepy_law,
                    .keywords = {"dw_tl_he_neohook: mu = 2 C10",
                                 "dw_tl_he_neohook: mu = 2 C10, dw_tl_he_mooney_rivlin: kappa = "
                                 "2 C01",
                                 "dw_tl_he_genyeoh: (C_p0, p)",
                                 "dw_tl_he_ogden: Ogden's own 2 mu_i/alpha_i, alpha_i", "", ""},
                    .volume = "dw_tl_bulk_penalty: K/2 (J - 1)^2",
                    .takes_terms = true,
                    .terms = "the law at once, g_i of its deviator, tau_i; SfePy has no memory: "
                             "class Memory integrates Simo's rule in numpy",
                    .evidence = "run by viscard's tests in SfePy 2021.4"},
      .evidence = Evidence::kRun,
      .evidence_note = "one element in SfePy 2021.4, relaxation and creep, exact to 1e-12",
      .advice =
          "Import it; step after step: stiffness(dt) for dw_lin_elastic, "
          "prestress(memory.known_stress(dt)) for dw_lin_prestress, then memory.advance.",
      .cannot_represent =
          "large strains, a shift with temperature; strain is taken as linear "
          "in each step",
      .is_indented = true};
}

CardTarget dolfinx_target() {
  return {.name = "dolfinx",
          .code = "FEniCS dolfinx (Python module)",
          .extension = ".py",
          .comment = "#",
          .write = write_dolfinx,
          .read = read_python_solid,
          .deck = DeckWriter{dolfinx_deck, "python3 {0}.py > {0}_result.csv"},
          .evidence = Evidence::kRun,
          .evidence_note = "one cube in dolfinx 0.5.2, relaxation and creep, exact to 1e-12",
          .advice =
              "Import it; see ufl_stress for the form of a step, and the one-element model "
              "(--deck) for the loop.",
          .cannot_represent =
              "large strains, a shift with temperature; strain is taken as linear "
              "in each step",
          .is_indented = true};
}

}  // namespace viscard
