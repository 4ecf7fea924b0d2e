#!/usr/bin/python3
"""Peer of arrays in the plane: one loaded pillar of 3 x 3 by quadratic tetrahedra in dolfinx, factorised by MUMPS.

A quarter by symmetry, with the stubs of the neighbours; displacements and potential together; the mesh is graded toward
the rim of the foot, where the stress is singular. Prints the unknowns and, in mV per kPa, the potential under the axis and
its means under the pillars at (0,0), (1,0), (0,1) and (1,1), as JSON.

usage: tests/benchmarks/touch_dolfinx.py LEVEL     (0.5: coarse, 1: 109 000 unknowns)
"""
import json
import os
import sys

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import dolfinx
import numpy as np
import ufl
from dolfinx import fem
from dolfinx import mesh as meshes
from dolfinx.fem import petsc as assembled
from mpi4py import MPI
from petsc4py import PETSc
from scipy.spatial import Delaunay

RADIUS, THICKNESS, LENGTH, PITCH, WIDTH = 20.0, 25.0, 120.0, 100.0, 240.0  # um; stresses in GPa
CENTRES = [(0, 0), (PITCH, 0), (0, PITCH), (PITCH, PITCH)]
RINGS = [0, .3, .55, .75, .88, .95, 1, 1.05, 1.12, 1.25, 1.45]  # of the loaded pillar, over its radius
FEW_RINGS = [0, .5, .8, 1, 1.2, 1.5]


def points_and_triangles(level, around):
    def rounder(n):  # a polygon with the area of the circle
        return np.sqrt(2 * np.pi / n / np.sin(2 * np.pi / n))

    points = []
    for (x, y), n, rings in zip(CENTRES, around, [RINGS] + 3 * [FEW_RINGS]):
        for r in rings:
            angles = 2 * np.pi * np.arange(1 if r == 0 else n // 2 if r < .4 else n) / (n // 2 if r < .4 else n)
            points += [(x + r * RADIUS * rounder(n) * np.cos(a), y + r * RADIUS * rounder(n) * np.sin(a)) for a in angles]
    step = 13 / level
    grid = np.linspace(0, WIDTH, int(WIDTH / step) + 1)
    points += [(x, y) for x in grid for y in grid
               if all(np.hypot(x - cx, y - cy) > 1.5 * RADIUS + .5 * step for cx, cy in CENTRES)]
    points = np.round(np.array(points), 9)
    points = points[np.all((points > -1e-9) & (points < WIDTH + 1e-9), axis=1)]
    points[np.abs(points) < 1e-6] = 0
    points = np.unique(points, axis=0)
    triangles = Delaunay(points).simplices
    corners = points[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    triangles = triangles[area > 1e-6]
    middle = points[triangles].mean(1)
    inside = [np.hypot(middle[:, 0] - x, middle[:, 1] - y) < RADIUS * np.cos(np.pi / n) * rounder(n)
              for (x, y), n in zip(CENTRES, around)]
    return points, triangles, inside


def tetrahedra(points, triangles, inside):
    nodes, coordinates, cells = {}, [], []

    def node(i, z):
        key = (i, round(z, 6))
        if key not in nodes:
            nodes[key] = len(coordinates)
            coordinates.append((points[i, 0], points[i, 1], z))
        return nodes[key]

    def prisms(some, heights):
        for low, high in zip(heights[:-1], heights[1:]):
            for triangle in some:
                a = [node(i, low) for i in sorted(triangle)]
                b = [node(i, high) for i in sorted(triangle)]
                cells.extend([[a[0], a[1], a[2], b[2]], [a[0], a[1], b[2], b[1]], [a[0], b[1], b[2], b[0]]])

    prisms(triangles, THICKNESS * np.array([0, .25, .5, .72, .88, .96, 1]))
    for k, some in enumerate(inside):
        above = [0, .7, 2, 4.5, 9, 16, 27, 45, 75, 120] if k == 0 else [0, 3, 10, 25]
        prisms(triangles[some], THICKNESS + np.array(above, dtype=float))
    return np.array(coordinates), np.array(cells, dtype=np.int64)


def forms(mesh, space):
    discontinuous = fem.FunctionSpace(mesh, ("DG", 0))
    is_film = discontinuous.tabulate_dof_coordinates()[:, 2] < THICKNESS

    def by_part(film, pillar):
        function = fem.Function(discontinuous)
        function.x.array[:] = np.where(is_film, film, pillar)
        return function

    def lame(E, nu):
        return E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)

    (film_l, film_m), (pillar_l, pillar_m) = lame(2.0, .29), lame(1.8e-3, .33)
    lam, mu, film = by_part(film_l, pillar_l), by_part(film_m, pillar_m), by_part(1.0, 0.0)
    d = np.array([22e-12, 3e-12, -30e-12])  # C/N; PVDF of the thesis
    stiffness = (film_l * np.ones((3, 3)) + 2 * film_m * np.eye(3)) * 1e9
    e, free = d @ stiffness, 12 * 8.8541878128e-12
    scale = np.sqrt(1e9 / free)  # of the potential
    e_scaled, k33 = e * scale / 1e9, (free - d @ stiffness @ d) / free
    (u, f), (v, g) = ufl.TrialFunctions(space), ufl.TestFunctions(space)

    def strain(w):
        return ufl.sym(ufl.grad(w))

    def charge(w):
        return sum(e_scaled[i] * strain(w)[i, i] for i in range(3))

    work = (lam * ufl.div(u) * ufl.div(v) + 2 * mu * ufl.inner(strain(u), strain(v))) * ufl.dx + film * (
        charge(v) * f.dx(2) + charge(u) * g.dx(2) - k33 * f.dx(2) * g.dx(2) - f.dx(0) * g.dx(0) - f.dx(1) * g.dx(1)) * ufl.dx
    facets = meshes.locate_entities_boundary(mesh, 2, lambda x: np.isclose(x[2], THICKNESS + LENGTH))
    tags = meshes.meshtags(mesh, 2, np.sort(facets), np.full(len(facets), 1, np.int32))
    return work, -1e-6 * v[2] * ufl.Measure("ds", domain=mesh, subdomain_data=tags)(1), scale * 1e-3


def held(space, part, where):
    sub = space
    for index in part:
        sub = sub.sub(index)
    collapsed, _ = sub.collapse()
    zero = fem.Function(collapsed)
    zero.x.array[:] = 0
    return fem.dirichletbc(zero, fem.locate_dofs_geometrical((sub, collapsed), where), sub)


def solution(space, work, load):
    conditions = [held(space, [0], lambda x: np.isclose(x[2], 0)), held(space, [1], lambda x: x[2] > THICKNESS - 1e-9),
                  held(space, [0, 0], lambda x: np.isclose(x[0], 0)), held(space, [0, 1], lambda x: np.isclose(x[1], 0))]
    matrix = assembled.assemble_matrix(fem.form(work), bcs=conditions)
    matrix.assemble()
    right = assembled.assemble_vector(fem.form(load))
    assembled.apply_lifting(right, [fem.form(work)], [conditions])
    assembled.set_bc(right, conditions)
    solver = PETSc.KSP().create()
    solver.setOperators(matrix)
    solver.setType("preonly")
    factor = solver.getPC()
    factor.setType("lu")
    factor.setFactorSolverType("mumps")
    factor.setFactorSetUpSolverType()
    factor.getFactorMatrix().setMumpsIcntl(7, 5)
    factor.getFactorMatrix().setMumpsIcntl(14, 60)
    found = fem.Function(space)
    solver.solve(right, found.vector)
    found.x.scatter_forward()
    return found


def main():
    level = float(sys.argv[1])
    around = [int(round(40 * level / 8)) * 8] + 3 * [24]
    points, triangles, inside = points_and_triangles(level, around)
    coordinates, cells = tetrahedra(points, triangles, inside)
    cell = ufl.Cell("tetrahedron", geometric_dimension=3)
    mesh = meshes.create_mesh(MPI.COMM_SELF, cells, coordinates, ufl.Mesh(ufl.VectorElement("Lagrange", cell, 1)))
    space = fem.FunctionSpace(mesh, ufl.MixedElement(ufl.VectorElement("P", mesh.ufl_cell(), 2),
                                                     ufl.FiniteElement("P", mesh.ufl_cell(), 2)))
    work, load, to_mV = forms(mesh, space)
    potential = solution(space, work, load).sub(1).collapse()
    places = potential.function_space.tabulate_dof_coordinates()
    below = np.flatnonzero(np.isclose(places[:, 2], 0))
    axis = below[np.argmin(np.hypot(places[below, 0], places[below, 1]))]
    facets = np.sort(meshes.locate_entities_boundary(mesh, 2, lambda x: np.isclose(x[2], 0)))
    middle = meshes.compute_midpoints(mesh, 2, facets)
    tags = np.zeros(len(facets), np.int32)
    for k, ((x, y), n) in enumerate(zip(CENTRES, around)):
        tags[np.hypot(middle[:, 0] - x, middle[:, 1] - y) < RADIUS * np.cos(np.pi / n)] = k + 1
    ds = ufl.Measure("ds", domain=mesh, subdomain_data=meshes.meshtags(mesh, 2, facets, tags))
    one = fem.Constant(mesh, 1.0)
    means = [fem.assemble_scalar(fem.form(potential * ds(k + 1))) / fem.assemble_scalar(fem.form(one * ds(k + 1)))
             for k in range(4)]
    print(json.dumps({"unknowns": int(space.dofmap.index_map.size_global * space.dofmap.index_map_bs),
                      "centre_mV": float(potential.x.array[axis] * to_mV), "mean_mV": [float(m * to_mV) for m in means]}))


if __name__ == "__main__":
    main()
