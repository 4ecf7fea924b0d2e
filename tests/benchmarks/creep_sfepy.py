#!/usr/bin/python3
"""Peer of the creep row of bench_pillar: the pillar on a fixed base, triquadratic hexahedra and exponential kernels
(dw_lin_elastic_eth), as a user of sfepy would write it. Prints unknowns, the top's displacement just after the load
and at the end in m, and processor seconds a step after the first (which builds the matrix).

usage: creep_sfepy.py STEPS BLOCKS      (equal steps to 10 s; BLOCKS elements across the core of the disc)
"""
import math
import sys
import time

import numpy as np
from sfepy.base.base import output
from sfepy.discrete import (Equation, Equations, FieldVariable, Function, Integral, Material,
                            Problem)
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.mechanics.matcoefs import stiffness_from_youngpoisson
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.solvers.ts_solvers import SimpleTimeSteppingSolver
from sfepy.terms import Term

output.set_output(quiet=True)
RADIUS, LENGTH = 20.0, 120.0  # um; stresses in MPa
TERMS = ((0.008206, 0.1945), (0.01386, 2.403))
END_S = 10.0


def disc(n):
    """Straight-sided quadrilaterals of a disc: a square core and four blocks around it."""
    # A polygon of 4 n sides with the area of the circle, so that its stiffness is not too small.
    polygon = 0.5 * 4 * n * math.sin(2 * math.pi / (4 * n))
    R = RADIUS * math.sqrt(math.pi / polygon)
    line = np.linspace(0.0, 1.0, n + 1)
    blocks = [[[(0.5 * R * (2 * a - 1), 0.5 * R * (2 * b - 1)) for a in line] for b in line]]
    for k in range(4):
        c, s = round(math.cos(k * math.pi / 2)), round(math.sin(k * math.pi / 2))
        grid = []
        for b in line:
            u = 2 * b - 1
            inner, outer = (0.5 * R, 0.5 * R * u), (R * math.cos(math.pi / 4 * u),
                                                    R * math.sin(math.pi / 4 * u))
            row = []
            for a in line:
                w = 1 - (1 - a) ** 2  # dense at the rim
                x, y = ((1 - w) * p + w * q for p, q in zip(inner, outer))
                row.append((c * x - s * y, s * x + c * y))
            grid.append(row)
        blocks.append(grid)
    return blocks


def mesh_of(n):
    heights = LENGTH * np.linspace(0.0, 1.0, 3 * n + 1) ** 1.8  # dense at the foot
    ids, nodes, elements = {}, [], []

    def node(x, y, z):
        key = (round(x, 6), round(y, 6), round(z, 6))
        if key not in ids:
            ids[key] = len(nodes)
            nodes.append(key)
        return ids[key]

    for block in disc(n):
        for j in range(n):
            for i in range(n):
                ring = (block[j][i], block[j][i + 1], block[j + 1][i + 1], block[j + 1][i])
                for low, high in zip(heights[:-1], heights[1:]):
                    elements.append([node(*p, low) for p in ring] + [node(*p, high) for p in ring])
    return Mesh.from_data("pillar", np.array(nodes), None, [np.array(elements)],
                          [np.zeros(len(elements), dtype=int)], ["3_8"])


class Clock:
    """Processor time at the end of each step, and the displacement of the top."""

    def __init__(self, variable, region):
        self.spent_s, self.top_um, self.variable, self.region = [], [], variable, region

    def __call__(self, *_):
        self.spent_s.append(time.process_time())
        nodes = self.variable.field.get_dofs_in_region(self.region)
        values = np.asarray(self.variable()).reshape(-1, 3)
        self.top_um.append(values[nodes, 2].mean())


def main():
    steps, n = int(sys.argv[1]), int(sys.argv[2])
    dt_s = END_S / steps
    domain = FEDomain("domain", mesh_of(n))
    body = domain.create_region("Body", "all")
    foot = domain.create_region("Foot", "vertices in z < 1e-6", "facet")
    top = domain.create_region("Top", f"vertices in z > {LENGTH - 1e-6}", "facet")
    field = Field.from_args("displacement", np.float64, "vector", body, approx_order=2)
    u = FieldVariable("u", "unknown", field, history=1)
    v = FieldVariable("v", "test", field, primary_var_name="u")
    whole = stiffness_from_youngpoisson(3, 1.8, 0.33)
    left = 1.0 - sum(g for g, _ in TERMS)
    solid = Material("solid", values={"D": left * whole})
    kernels = [Material(f"memory{i}", values={"H": g * whole,
                                              "decay": np.array([[math.exp(-dt_s / tau)]])})
               for i, (g, tau) in enumerate(TERMS)]
    # These terms need an unloaded start: the load, a pressure of 10 kPa, jumps with the first step.
    load = Material("load", function=Function("pull", lambda ts, coors, mode=None, **_: (
        {"val": np.full((coors.shape[0], 1, 1), 0.01 * (ts.step > 0))} if mode == "qp" else None)))
    integral = Integral("i", order=4)
    newton = Newton({"i_max": 1, "eps_a": 1e-12}, lin_solver=ScipyDirect({"use_presolve": True}))
    stepper = SimpleTimeSteppingSolver({"t0": 0.0, "t1": END_S + dt_s, "n_step": steps + 2,
                                        "quasistatic": True}, nls=newton)
    total = Term.new("dw_lin_elastic(solid.D, v, u)", integral, body, solid=solid, v=v, u=u)
    for kernel in kernels:
        name = kernel.name
        total = total + Term.new(f"dw_lin_elastic_eth(ts, {name}.H, {name}.decay, v, du/dt)",
                                 integral, body, **{name: kernel}, ts=stepper.ts, v=v, u=u)
    total = total + Term.new("dw_surface_ltr(load.val, v)", integral, top, load=load, v=v)
    problem = Problem("creep", equations=Equations([Equation("balance", total)]))
    problem.set_bcs(ebcs=Conditions([EssentialBC("held", foot, {"u.all": 0.0})]))
    clock = Clock(u, top)
    problem.set_solver(stepper)
    problem.solve(save_results=False, step_hook=clock)
    print("unknowns", problem.equations.variables.adi.ptr[-1])
    print("first_um", abs(clock.top_um[1]))
    print("last_um", abs(clock.top_um[-1]))
    print("step_s", (clock.spent_s[-1] - clock.spent_s[1]) / (len(clock.spent_s) - 2))


if __name__ == "__main__":
    main()
