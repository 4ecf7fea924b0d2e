#!/usr/bin/python3
"""Answers a scene of tests/referee/scenes by FreeFEM and compares viscard's answer with it.

usage: referee.py VISCARD SCENE [TABLE]        (./run test --slow -R referee does all)

Every scene is answered on two meshes; the change from one to the other is what the referee itself may be wrong by. Prints
a row for each number (value, claimed error, true error, the referee's own change), appends the rows to TABLE, and ends with
status 1 where the true error exceeds the claim and the referee's change together, unless that is KNOWN. The referee never
sees the claims.
"""
import cmath
import math
import os
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import section as fem
from scene import Scene, answer_of_viscard, filled, si, um

# Claims that are known to be too small, with the share of the claim that is seen, and why. Whoever mends one removes its line.
KNOWN = {}
LEVELS = {"creep": fem.CHEAP, "relaxation": fem.CHEAP, "harmonic": fem.CHEAP, "transient": fem.CHEAP, "buckling": fem.BLUNT}


def electric(scene, folder, driven=False, **more):
    electrode = scene.geometry["electrode"]
    is_bottom, is_sampled = electrode["face"] == "bottom", electrode["kind"] == "sampled"
    film, values = scene.constants(elements="[P2, P2, P2, P2]", mesh="mesh.msh", **more)
    values["ground"], values["electrode"] = ("20, 21", "10") if is_bottom else ("10, 11", "20")
    if is_sampled:
        values["electrode"] = "99"
    script = fem.HEAD + fem.ELECTRIC + more.get("read", "") + (fem.DRIVEN if driven else "")
    return film, fem.run(filled(script, values), folder, "electric")


def static_press(scene, folder, level):
    R, near = scene.R, scene.L * 1e-7
    scene.section(inner=[0.0, R], smooth=[R / 2]).write(os.path.join(folder, "mesh.msh"), level)
    read = f"""
varf under([u, v, w, f], [uu, vv, ww, ff]) = on(10, w = 1);
on1 = under(0, Vh, tgv = 1);
cout << "= bottom " << -(r'*on1)/({R}^2/2) << endl;  // by the reactions of its nodes
func real at(real X, real Y) {{
  return {{la}}*(dx(u)(X, Y) + u(X, Y)/X + dy(w)(X, Y)) + 2*{{mu}}*dy(w)(X, Y);
}}
cout << "= half " << at({R}/2, {near}) << endl;
"""
    _, values = scene.constants(elements="[P2, P2, P2, P2]", mesh="mesh.msh", pressing=scene.load_MPa("pressure"), k11=1,
                                k33=1, ground="10", electrode="99")
    found = fem.run(filled(fem.HEAD + fem.ELECTRIC + read, values), folder, "press")
    return {"top_displacement": found["moved"] * 1e-6, "base_stress_at_half_radius": found["half"] * 1e6,
            "film_bottom_stress_mean": found["bottom"] * 1e6}


def write_with_electrode(scene, folder, level):
    inner = um(scene.geometry["electrode"]["radius"])
    scene.section(inner=[0.0, inner]).write(os.path.join(folder, "mesh.msh"), level)


def static_voltage(scene, folder, level):
    write_with_electrode(scene, folder, level)
    film, found = electric(scene, folder, driven=True, pressing=scene.load_MPa("pressure"))
    return {"electrode_charge": 2 * math.pi * film.charge_C(found["charge"]),
            "electrode_voltage": -found["charge"] / found["capacitance"] * film.volt}


def static_drive(scene, folder, level):
    write_with_electrode(scene, folder, level)
    film, found = electric(scene, folder, driven=True)
    return {"top_displacement": found["driven"] * 1e-6 * si(scene.analysis["load"]["voltage"]) / film.volt}


def static_quadrants(scene, folder, level):
    write_with_electrode(scene, folder, level)
    film, found = electric(scene, folder, pressing=scene.load_MPa("shear"), m=1)
    return {"quadrant_charge": film.charge_C(found["charge"]), "top_displacement": found["moved"] * 1e-6}


def row(scene, folder, level):
    g, R = scene.geometry, scene.R
    pitch, edge = 2 * R + um(g["spacing"]), um(g["film"]["edge"])
    places = [i * pitch for i in range(g["count"])]
    fem.Section(R, scene.L, scene.t, places[-1] + R + edge, first=-R - edge,
                pillars=[(x - R, x + R) for x in places]).write(os.path.join(folder, "mesh.msh"), level)
    read = "".join(f"""cout << "= centre{i} " << f({x}, -{scene.t}) << endl;
cout << "= mean{i} " << int1d(Th, 10, 11)(f*(abs(x - {x}) < {R}))/(2*{R}) << endl;
""" for i, x in enumerate(places))
    film, found = electric(scene, folder, pressing=scene.load_MPa("pressure"), axis=0, read=read)
    return {f"{name}_voltage_{i + 1}": found[f"{name}{i}"] * film.volt for name in ("centre", "mean") for i in range(len(places))}


def space(scene, folder, level):
    """The neighbour is left out: it is a thousandth as stiff as the film, and so is its effect on its own voltage."""
    g, R = scene.geometry, scene.R
    pitch = 2 * R + um(g["spacing"])
    fem.Section(R, scene.L, scene.t, um(g["film"]["edge"]), smooth=[pitch - R, pitch + R]).write(
        os.path.join(folder, "mesh.msh"), level)
    read = f"""
cout << "= centre1 " << f(0, -{scene.t}) << endl << "= centre2 " << f({pitch}, -{scene.t}) << endl;
cout << "= mean1 " << int1d(Th, 10, 11)(f*(x < {R})*2*x)/{R}^2 << endl;
func angle = acos(max(-1., min(1., (x^2 + {pitch}^2 - {R}^2)/(2*{pitch}*max(x, 1e-9)))));
cout << "= mean2 " << int1d(Th, 10, 11, qfe = qf5pE)(f*(abs(x - {pitch}) < {R})*2*x*angle)/(pi*{R}^2) << endl;
"""
    film, found = electric(scene, folder, pressing=scene.load_MPa("pressure"), read=read)
    return {f"{name}_voltage_1_{i}": found[f"{name}{i}"] * film.volt for name in ("centre", "mean") for i in (1, 2)}


def at_s(scene, folder, points, load, moved=False, with_mass=False, **more):
    """Answers at complex frequencies s: the modulus of a term is g s tau/(1 + s tau)."""
    film, values = scene.constants(mesh="mesh.msh", load=load, moved=int(moved), **more)
    script = filled(fem.HEAD + fem.OF_S, values)
    E, nu = scene.pillar["E"] / 1e6, scene.pillar["nu"]
    G0, K0 = E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))
    text = lambda z: f"{complex(z).real:.16g} + 1i*({complex(z).imag:.16g})"
    for i, s in enumerate(points):
        left = lambda key: 1 - sum(term[key] / (1 + s * term["tau_s"]) for term in scene.pillar["terms"])
        G, K = G0 * left("g"), K0 * left("k")
        script += f"answer({i}, {text(K - 2 * G / 3)}, {text(G)}, {film.la}, {film.mu}, {text(s * s if with_mass else 0)});\n"
    found = fem.run(script, folder, "of_s")
    return [found[f"s{i}"] for i in range(len(points))]


def talbot(t, terms=12):
    """Points s and weights of f(t) = Re sum weight F(s): Abate and Valko, Int. J. Numer. Meth. Engng 60 (2004) 979."""
    r = 2 * terms / (5 * t)
    points, weights = [complex(r)], [r / terms * 0.5 * math.exp(r * t)]
    for k in range(1, terms):
        a = k * math.pi / terms
        cot = 1 / math.tan(a)
        s = r * a * (cot + 1j)
        points.append(s)
        weights.append(r / terms * cmath.exp(t * s) * (1 + 1j * (a + (a * cot - 1) * cot)))
    return points, weights


def in_time(times, answers_at, transform):
    out = []
    for t in times:
        points, weights = talbot(t)
        out.append(sum((w * F * transform(s)).real for w, F, s in zip(weights, answers_at(points), points)))
    return out


def creep(scene, folder, level):
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    end, load = scene.analysis["history"][-1]
    u, = in_time([si(end)], lambda points: at_s(scene, folder, points, "press"), lambda s: 1 / s)
    return {"top_displacement_end": u * si(load) / 1e6 * 1e-6}


def relaxation(scene, folder, level):
    """A ramp is the difference of two integrated steps."""
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    (_, _), (ramp, moved), (end, _) = scene.analysis["history"]
    force = lambda points: [2 * F for F in at_s(scene, folder, points, "press", moved=True)]  # over R^2: a pressure
    late, early, full = in_time([si(end), si(end) - si(ramp), si(ramp)], force, lambda s: 1 / (s * s))
    per = um(moved) / si(ramp) / scene.R ** 2 * 1e6
    return {"top_pressure_end": (late - early) * per, "top_pressure_peak": full * per}


def harmonic(scene, folder, level):
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    f = scene.analysis["frequencies"]
    low, high, n = si(f["from"]), si(f["to"]), f["count"]
    points = [2j * math.pi * low * (high / low) ** (i / (n - 1)) for i in range(n)]
    found = at_s(scene, folder, points, "shake", with_mass=True, m=1)
    out = {}
    for i, motion in enumerate(found):
        out[f"transmissibility_real[{i}]"], out[f"transmissibility_imaginary[{i}]"] = 1 + motion.real, motion.imag
    return out


def transient(scene, folder, level):
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    a = scene.analysis
    _, values = scene.constants(mesh="mesh.msh", steps=1200 if level == fem.CHEAP[0] else 2400, end=si(a["end_time"]),
                                height=si(a["pulse"]["height"]) / 1e6, duration=si(a["pulse"]["duration"]))
    found = fem.run(filled(fem.HEAD + fem.STEPS, values), folder, "steps")
    return {"top_displacement_peak": found["peak"] * 1e-6, "top_displacement_end": found["end"] * 1e-6}


def modal(scene, folder, level):
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    out = {}
    for m in range(3):
        _, values = scene.constants(mesh="mesh.msh", m=m)
        found = fem.run(filled(fem.HEAD + fem.MODES, values), folder, f"modes{m}")
        names = {0: "longitudinal", 1: "lateral", 2: "ovalling"}
        torsions = sorted(v for k, v in found.items() if k.startswith("torsion"))
        others = sorted(v for k, v in found.items() if k.startswith("mode"))
        for name, values in ((names[m], others), ("torsion", torsions)):
            out.update({f"{name} {i + 1}": v for i, v in enumerate(values)})
    return out


def buckling(scene, folder, level):
    scene.section().write(os.path.join(folder, "mesh.msh"), level)
    _, values = scene.constants(mesh="mesh.msh")
    return {"buckling_pressure": fem.run(filled(fem.HEAD + fem.BUCKLE, values), folder, "buckle")["buckling"] * 1e6}


HEAD = (f"{'scene':<18}{'result':<30}{'viscard':>16}{'claim':>11}{'true error':>11}{'referee':>11}{'of claim':>9}  "
        "errors relative to the referee's value")


def main():
    if sys.argv[1:] == ["--head"]:
        print(HEAD)
        return 0
    viscard, name = sys.argv[1:3]
    if shutil.which("FreeFem++") is None:
        print("FreeFem++ is not installed (apt-get install freefem++)")
        return 77
    scene = Scene(name)
    with tempfile.TemporaryDirectory() as folder:
        ours = answer_of_viscard(viscard, name, folder)
        coarse, fine = (globals()[name](scene, folder, level) for level in LEVELS.get(name, fem.LEVELS))
    rows, failed = [], False
    for key, value in fine.items():
        if key not in ours:
            continue
        mine, claim = ours[key]
        error, own = abs(mine - value), abs(value - coarse[key])
        is_honest, known = error <= claim + own, KNOWN.get((name, key))
        failed = failed or (is_honest if known else not is_honest) or error > (known or math.inf) * claim + own
        note = "" if is_honest and not known else "  CLAIMS TOO LITTLE" if not is_honest else "  honest: take it from KNOWN"
        rows.append(f"{name:<18}{key:<30}{mine:>16.8g}{claim / abs(value):>11.1e}{error / abs(value):>11.1e}"
                    f"{own / abs(value):>11.1e}{error / claim:>9.2f}{note}\n")
    text = "".join(rows)
    print(HEAD + "\n" + text)
    if len(sys.argv) > 3:
        with open(sys.argv[3], "a", encoding="utf-8") as table:
            table.write(text)
    return 1 if failed or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
