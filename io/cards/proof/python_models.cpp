// The one-element models of SfePy and dolfinx. Both run the numbers of a card: E0, nu, g, k and tau as
// its reader found them. SfePy assembles the stiffness of a unit bulk and a unit shear modulus, and
// the branches are displacements of the nodes; dolfinx solves the balance of every increment, and
// the branches are strains of the element. Both integrate the branches by backward Euler:
//   s(t + dt) = (s(t) + de)/(1 + dt/tau), of first order, as CalculiX.
#include "io/cards/card_numbers.h"
#include "io/cards/proof/solvers.h"

#include <fmt/format.h>

namespace viscard {
namespace {

constexpr const char* kSfepy = R"py(import sys

import numpy as np
import sfepy
from sfepy.base.base import output
from sfepy.discrete import (FieldVariable, Integral, Material, Equation, Equations, Problem)
from sfepy.discrete.fem import FEDomain, Field
from sfepy.mechanics.matcoefs import stiffness_from_lame
from sfepy.mesh.mesh_generators import gen_block_mesh
from sfepy.terms import Term

output.set_output(quiet=True)
domain = FEDomain("cube", gen_block_mesh((1, 1, 1), (2, 2, 2), (0.5, 0.5, 0.5), verbose=False))
omega = domain.create_region("Omega", "all")
top = domain.create_region("top", "vertices in (z > 0.999)", "facet")
field = Field.from_args("u", np.float64, "vector", omega, approx_order=1)
u = FieldVariable("u", "unknown", field)
v = FieldVariable("v", "test", field, primary_var_name="u")
integral = Integral("i", order=2)


def stiffness(lame, shear):
    """SfePy's matrix of an elastic cube, with all degrees of freedom."""
    m = Material("m", D=stiffness_from_lame(3, lame, shear))
    term = Term.new("dw_lin_elastic(m.D, v, u)", integral, omega, m=m, v=v, u=u)
    problem = Problem("cube", equations=Equations([Equation("balance", term)]))
    problem.time_update()
    problem.update_materials()
    return problem.equations.evaluate(mode="weak", dw_mode="matrix",
                                      asm_obj=problem.mtx_a).toarray()


# Of a unit bulk modulus (lame = 1, no shear) and of a unit shear modulus without bulk modulus.
of_bulk, of_shear = stiffness(1.0, 0.0), stiffness(-2.0 / 3.0, 1.0)
corners = domain.get_mesh_coors()
fixed = [3 * n + axis for n in range(8) for axis in range(3) if corners[n, axis] < 1e-6]
pulled = [3 * n + 2 for n in range(8) if corners[n, 2] > 1.0 - 1e-6]
sides = [3 * n + axis for n in range(8) for axis in range(2) if corners[n, axis] > 1.0 - 1e-6]

shear, bulk = E0 / (2.0 * (1.0 + nu)), E0 / (3.0 * (1.0 - 2.0 * nu))
branches = [g[i] * shear * of_shear + k[i] * bulk * of_bulk for i in range(len(tau))]
lasting = ((1.0 - sum(g)) * shear * of_shear + (1.0 - sum(k)) * bulk * of_bulk)


def run(blocks, creep, confined, result):
    held = fixed + ([] if creep else pulled) + (sides if confined else [])
    free = [dof for dof in range(24) if dof not in held]
    elastic = [np.zeros(24) for _ in tau]  # part of the displacements of each branch
    x = np.zeros(24)
    time = load = 0.0
    for length, increments, load_at_end in blocks:
        dt, load_at_start, start = length / increments, load, time
        weights = [1.0 / (1.0 + dt / tau_i) for tau_i in tau]
        matrix = lasting + sum(w * b for w, b in zip(weights, branches))
        for i in range(1, increments + 1):
            time = start + length * i / increments
            load = load_at_start + (load_at_end - load_at_start) * i / increments
            known = sum((w * (b @ (e - x)) for w, b, e in zip(weights, branches, elastic)),
                        np.zeros(24))
            new, force = np.zeros(24), np.zeros(24)
            if creep:
                force[pulled] = 0.25 * load * stress
            else:
                new[pulled] = load * strain
            rest = (force - known - matrix @ new)[free]
            new[free] = np.linalg.solve(matrix[np.ix_(free, free)], rest)
            elastic = [w * (e + new - x) for w, e in zip(weights, elastic)]
            x = new
            reaction = matrix @ x + known
            value = x[pulled].mean() if creep else reaction[pulled].sum()
            print(repr(float(time)), repr(float(value)), file=result)


for number, (blocks, creep, confined) in enumerate(tests):
    with open(f"result_{number}.txt", "w") as result:
        run(blocks, creep, confined, result)
)py";

constexpr const char* kDolfinx = R"py(import dolfinx
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import LinearProblem
from dolfinx.mesh import CellType, create_unit_cube, locate_entities_boundary, meshtags
from mpi4py import MPI
from petsc4py.PETSc import ScalarType

mesh = create_unit_cube(MPI.COMM_SELF, 1, 1, 1, CellType.hexahedron)
V = fem.VectorFunctionSpace(mesh, ("CG", 1))
T = fem.TensorFunctionSpace(mesh, ("DG", 0))
u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
found = fem.Function(V)
history = fem.Function(T)  # stress that the branches keep from the increment before
shear_now = fem.Constant(mesh, ScalarType(0.0))
bulk_now = fem.Constant(mesh, ScalarType(0.0))
traction = fem.Constant(mesh, ScalarType(0.0))
pulled = fem.Constant(mesh, ScalarType(0.0))


def eps(w):
    return ufl.sym(ufl.grad(w))


def stress_of(e, shear, bulk):
    return 2.0 * shear * ufl.dev(e) + bulk * ufl.tr(e) * ufl.Identity(3)


def is_top(x):
    return np.isclose(x[2], 1.0)


faces = locate_entities_boundary(mesh, 2, is_top)
tags = meshtags(mesh, 2, faces, np.full(len(faces), 1, dtype=np.int32))
top = ufl.Measure("ds", domain=mesh, subdomain_data=tags)(1)
dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2})
bilinear = ufl.inner(stress_of(eps(u), shear_now, bulk_now), eps(v)) * dx
linear = traction * v[2] * top - ufl.inner(history, eps(v)) * dx


def roller(axis, end):
    face = locate_entities_boundary(mesh, 2, lambda x: np.isclose(x[axis], end))
    dofs = fem.locate_dofs_topological(V.sub(axis), 2, face)
    return fem.dirichletbc(ScalarType(0.0), dofs, V.sub(axis))


rollers = [roller(axis, 0.0) for axis in range(3)]
sides = [roller(axis, 1.0) for axis in range(2)]
pull = fem.dirichletbc(pulled, fem.locate_dofs_topological(V.sub(2), 2, faces), V.sub(2))
strain_of = fem.Expression(eps(found), T.element.interpolation_points())
strain_now = fem.Function(T)
top_height = fem.form(found[2] * top)


def split(e):
    trace = np.trace(e, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    return e - trace / 3.0, trace


shear, bulk = E0 / (2.0 * (1.0 + nu)), E0 / (3.0 * (1.0 - 2.0 * nu))
cells = mesh.topology.index_map(3).size_local


def run(blocks, creep, confined, result):
    held = rollers + ([] if creep else [pull]) + (sides if confined else [])
    problem = LinearProblem(bilinear, linear, bcs=held, u=found,
                            petsc_options={"ksp_type": "preonly", "pc_type": "lu"})
    old = np.zeros((cells, 3, 3))
    elastic = [np.zeros((cells, 3, 3)) for _ in tau]  # strain of the springs
    time = load = 0.0
    for length, increments, load_at_end in blocks:
        dt, load_at_start, start = length / increments, load, time
        weights = [1.0 / (1.0 + dt / tau_i) for tau_i in tau]
        shear_now.value = shear * (1.0 - sum(g) + sum(a * w for a, w in zip(g, weights)))
        bulk_now.value = bulk * (1.0 - sum(k) + sum(a * w for a, w in zip(k, weights)))
        for i in range(1, increments + 1):
            time = start + length * i / increments
            load = load_at_start + (load_at_end - load_at_start) * i / increments
            kept = np.zeros((cells, 3, 3))
            for a, b, w, e in zip(g, k, weights, elastic):
                deviator, trace = split(e - old)
                kept += w * (2.0 * a * shear * deviator + b * bulk * trace)
            history.x.array[:] = kept.reshape(-1)
            traction.value = load * stress if creep else 0.0
            pulled.value = load * strain
            problem.solve()
            strain_now.interpolate(strain_of)
            new = strain_now.x.array.reshape(cells, 3, 3).copy()
            elastic = [w * (e + new - old) for w, e in zip(weights, elastic)]
            old = new
            deviator, trace = split(new)
            total = 2.0 * shear_now.value * deviator + bulk_now.value * trace + kept
            value = fem.assemble_scalar(top_height) if creep else total[:, 2, 2].mean()
            print(repr(float(time)), repr(float(np.real(value))), file=result)


for number, (blocks, creep, confined) in enumerate(tests):
    with open(f"result_{number}.txt", "w") as result:
        run(blocks, creep, confined, result)
)py";

std::string python_list(const std::vector<MaterialTerm>& terms, double MaterialTerm::*member) {
  std::string out;
  for (const MaterialTerm& term : terms) out += fmt::format("{}, ", term.*member);
  return "[" + out + "]";
}

// (length, increments, load at the end) of each block, whether it is creep, and whether sides are held.
std::string python_test(const ElementTest& test) {
  std::string blocks;
  double from_s = 0.0;
  for (const TimeBlock& block : test.blocks) {
    blocks += fmt::format("({}, {}, {}), ", block.end_s - from_s, block.increments, block.load);
    from_s = block.end_s;
  }
  return fmt::format("    ([{}], {}, {}),\n", blocks, test.is_creep() ? "True" : "False",
                     test.is_confined() ? "True" : "False");
}

// The numbers, in SI, above the program, which runs all tests.
std::vector<DeckFile> python_model(const std::vector<SolverTask>& tasks, const char* program) {
  const Material& material = tasks.front().as_read;
  const DeckInput& input = tasks.front().input;
  std::string tests;
  for (const SolverTask& task : tasks) tests += python_test(task.input.test);
  return {{"deck.py",
           fmt::format("E0, nu = {}, {}\ng = {}\nk = {}\ntau = {}\n"
                       "strain, stress = {}, {}\ntests = [\n{}]\n\n",
                       material.E0_Pa, material.nu, python_list(material.terms, &MaterialTerm::g),
                       python_list(material.terms, &MaterialTerm::k),
                       python_list(material.terms, &MaterialTerm::tau_s), input.test.amplitude,
                       input.test.amplitude * input.card.written.E0_Pa, tests) +
               program}};
}

}  // namespace

std::vector<DeckFile> sfepy_model(const std::vector<SolverTask>& tasks) {
  return python_model(tasks, kSfepy);
}
std::vector<DeckFile> dolfinx_model(const std::vector<SolverTask>& tasks) {
  return python_model(tasks, kDolfinx);
}

}  // namespace viscard
