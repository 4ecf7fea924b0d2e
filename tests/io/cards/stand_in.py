#!/usr/bin/python3
"""Stands in for febio4, mfront and mtest, or fistr1, by the name it is called: integrates the numbers
of a one-element model in simple tension and prints in the solver's format. Formats: FEBio
DataRecord.cpp, TFEL MTest.cxx, FrontISTR hecmw_result_io_txt.c; rules of FrontISTR's steps:
fstr_AddBC.f90, fstr_ass_load.f90. An independent implementation for tests of viscard."""
import cmath
import math
import os
import re
import sys


class Bar:
    """Branches exact for strain that is linear in the increment (Taylor, Pister & Goudreau 1970)."""

    def __init__(self, young, nu, g, k, tau):
        self.shear, self.bulk = young / (2 * (1 + nu)), young / (3 * (1 - 2 * nu))
        self.g, self.k, self.tau = g, k, tau
        self.d = self.v = 0.0  # axial deviatoric strain, volume change
        self.q = [[0.0, 0.0] for _ in tau]

    def _part(self, which, shares, dt, old):
        gain, known = 1 - sum(shares), 0.0
        for share, tau, q in zip(shares, self.tau, self.q):
            phi = -math.expm1(-dt / tau) / (dt / tau)
            gain += share * phi
            known += math.exp(-dt / tau) * q[which] - share * phi * old
        return gain, known

    def step(self, dt, strain=None, stress=None, confined=False):
        gd, hd = self._part(0, self.g, dt, self.d)
        gv, hv = self._part(1, self.k, dt, self.v)
        if stress is None:  # sides free: bulk (gv v + hv) = shear (gd d + hd)
            lateral = (self.shear * (2 / 3 * gd * strain + hd) - self.bulk * (gv * strain + hv)) / (
                2 * self.bulk * gv + 2 / 3 * self.shear * gd)
            lateral = 0.0 if confined else lateral
            d, v = 2 / 3 * (strain - lateral), strain + 2 * lateral
        elif confined:  # stress = bulk (gv e + hv) + 2 shear (2/3 gd e + hd)
            v = (stress - self.bulk * hv - 2 * self.shear * hd) / (
                self.bulk * gv + 4 / 3 * self.shear * gd)
            d = 2 / 3 * v
        else:
            d = (stress / 3 / self.shear - hd) / gd
            v = (stress / 3 / self.bulk - hv) / gv
        for i, tau in enumerate(self.tau):
            phi, decay = -math.expm1(-dt / tau) / (dt / tau), math.exp(-dt / tau)
            self.q[i] = [decay * self.q[i][0] + self.g[i] * phi * (d - self.d),
                         decay * self.q[i][1] + self.k[i] * phi * (v - self.v)]
        self.d, self.v = d, v
        # strain, stress
        axial = self.bulk * (gv * v + hv) + 2 * self.shear * (gd * d + hd)
        return v / 3 + d, axial if confined else 3 * self.shear * (gd * d + hd)


class Cube:
    """A law of rubber in principal stretches with Simo's terms: W(isochoric stretches) is differentiated by a
    complex step, J U'(J) is given; the branches are pushed forward as they are."""

    def __init__(self, energy, volume, g, tau):
        self.energy, self.volume, self.g, self.tau = energy, volume, g, tau
        self.elastic, self.branches = [0.0] * 3, [[0.0] * 3 for _ in tau]

    def _stress(self, stretches, dt):
        logs = [math.log(s) for s in stretches]
        now = []
        for i in range(3):
            z = [x + (1e-30j if i == k else 0) for k, x in enumerate(logs)]
            now.append(self.energy([cmath.exp(x - sum(z) / 3) for x in z]).imag / 1e-30 / stretches[i] ** 2)
        share, total, kept = 1 - sum(self.g), [], []
        for i in range(3):
            kept.append([math.exp(-dt / t) * h[i] - math.expm1(-dt / t) / (dt / t) * (now[i] - self.elastic[i])
                         for t, h in zip(self.tau, self.branches)])
            total.append((share * now[i] + sum(g * h for g, h in zip(self.g, kept[i]))) * stretches[i] ** 2)
        pressure = self.volume(math.prod(stretches))
        return [t + pressure for t in total], now, [list(h) for h in zip(*kept)]

    def step(self, dt, z, x=None, y=None):
        """Nominal stress along z, and all stretches; x and y are free if not given, and then equal if both are."""
        low, high = 0.2, 5.0
        for _ in range(80):
            free = math.sqrt(low * high)
            at = [free if x is None else x, free if y is None else y, z]
            stress, now, branches = self._stress(at, dt)
            side = stress[0] if x is None else stress[1] if y is None else 0.0
            low, high = (free, high) if side < 0 else (low, free)
        self.elastic, self.branches = now, branches
        return stress[2] / z, at


def squares(l):
    return sum(x * x for x in l) - 3


def numbers(pattern, text):
    return [float(x) for x in re.findall(pattern, text)]


def ramp(points, t):
    for (t0, y0), (t1, y1) in zip(points, points[1:]):
        if t <= t1:
            return y0 + (y1 - y0) * (t - t0) / (t1 - t0)
    return points[-1][1]


def febio():
    if sys.argv[1:] == ["-info"]:
        return print("compiled on Jan  1 2026\nFEBio version  = 4.9.0 (stand-in)")
    text = open(sys.argv[sys.argv.index("-i") + 1]).read()
    if "rz.txt" in text:
        return febio_rubber(text)
    g, tau = numbers(r"<g[1-6]>([^<]*)", text), numbers(r"<t[1-6]>([^<]*)", text)
    if "uncoupled" in text.split("<elastic")[0].split("<material")[1]:
        shear, bulk = 2 * numbers(r"<c1>([^<]*)", text)[0], numbers(r"<k>([^<]*)", text)[0]
        nu = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
        bar = Bar(2 * shear * (1 + nu), nu, g, [0.0] * len(g), tau)
    else:
        bar = Bar(numbers(r"<E>([^<]*)", text)[0], numbers(r"<v>([^<]*)", text)[0], g, g, tau)
    points = [tuple(map(float, p.split(","))) for p in re.findall(r"<pt>([^<]*)", text)]
    creep, confined = "nodal_load" in text, 'node_set="x1"' in text
    top = numbers(r'lc="1">([^<]*)', text)[0] * (4 if creep else 1)
    with open("uz.txt" if creep else "sz.txt", "w") as out:
        time, n = 0.0, 0
        print("*Step  = 0\n*Time  = 0\n*Data  = x\n7 0", file=out)
        for count, size in re.findall(r"<time_steps>(\d+)</time_steps><step_size>([^<]*)", text):
            for _ in range(int(count)):
                time, n = time + float(size), n + 1
                load = top * ramp(points, time)
                strain, stress = bar.step(float(size), confined=confined,
                                          **{"stress" if creep else "strain": load})
                print(f"*Step  = {n}\n*Time  = {time:.9g}\n*Data  = x\n"
                      f"7 {strain if creep else stress:.12g}", file=out)


def febio_rubber(text):
    one = lambda name: numbers(f"<{name}>([^<]*)", text)[0]
    k = one("k")
    if 'type="Ogden"' in text:
        pairs = list(zip(numbers(r"<c\d>([^<]*)", text), numbers(r"<m\d>([^<]*)", text)))
        energy = lambda l: sum(c / m**2 * (sum(x**m for x in l) - 3) for c, m in pairs)
    elif 'type="Gent"' in text:
        energy = lambda l: -one("G") * one("Jm") / 2 * cmath.log(1 - squares(l) / one("Jm"))
    else:  # W of I1
        formula = re.search("<W>([^<]*)", text).group(1).replace("^", "**")
        energy = lambda l: eval(formula, {"I1": squares(l) + 3})
    cube = Cube(energy, lambda J: k * math.log(J), numbers(r"<g[1-6]>([^<]*)", text), numbers(r"<t[1-6]>([^<]*)", text))
    fixed = lambda face: f'node_set="{face}" type="zero' in text
    top = numbers(r'lc="1">([^<]*)', text)[0]
    points = [tuple(map(float, p.split(","))) for p in re.findall(r"<pt>([^<]*)", text)]
    with open("rz.txt", "w") as out:
        time = 0.0
        print("*Step  = 0\n*Time  = 0\n*Data  = Rz\n5 0\n6 0\n7 0\n8 0", file=out)
        for count, size in re.findall(r"<time_steps>(\d+)</time_steps>\s*<step_size>([^<]*)", text):
            for _ in range(int(count)):
                time += float(size)
                z = 1 + top * ramp(points, time)
                x = 1.0 if fixed("x1") else z if 'node_set="x1" type="prescribed' in text else None
                force, _ = cube.step(float(size), z, x, 1.0 if fixed("y1") else None)
                rows = "\n".join(f"{node} {-force / 4:.12g}" for node in (5, 6, 7, 8))
                print(f"*Step  = 1\n*Time  = {time:.12g}\n*Data  = Rz\n{rows}", file=out)


def mtest_rubber(value, text):
    K = value["K"][0]
    if "alpha" in value:
        pairs = list(zip(value["mu"], value["alpha"]))
        energy = lambda l: sum(2 * m / a**2 * (sum(x**a for x in l) - 3) for m, a in pairs)
    else:  # C10, C20 ... of I1 - 3
        energy = lambda l: sum(value.get(f"C{i}0", [0.0])[0] * squares(l) ** i for i in (1, 2, 3))
    cube = Cube(energy, lambda J: K * J * (J - 1), value.get("g", []), value.get("tau", []))
    way = {name: [tuple(map(float, p.split(":"))) for p in points.split(",")] for name, points in
           re.findall(r"'(F..)' {([^}]*)}", text)}
    held = set(re.findall(r"'(F..)' 1.;", text))
    time = 0.0
    with open("deck.res", "w") as out:
        print("# first column: time\n0" + " 0" * 15, file=out)
        for end, count in re.findall(r", (\S+) in (\d+)", text):
            start = time
            for i in range(1, int(count) + 1):
                now = start + (float(end) - start) * i / int(count)
                z = ramp(way["FZZ"], now)
                x = 1.0 if "FXX" in held else z if "FXX" in way else None
                force, at = cube.step(now - time, z, x, 1.0 if "FYY" in held else None)
                time = now
                print(repr(now), *map(repr, at), *[0] * 6, 0, 0, repr(force / at[0] / at[1]), 0, 0, 0, file=out)


def mfront():
    if sys.argv[1:] == ["--version"]:
        print("tfel\nVersion : 5.2.0-stand-in")


def mtest():
    if sys.argv[1:] == ["--version"]:
        return print("mtest is an behaviour testing utility")
    card = re.sub("//.*", "", open("card.mfront").read())
    value = {name: [float(x) for x in re.sub("[{}]", "", text).split(",")] for name, text in
             re.findall(r"@Parameter real (\w+)(?:\[N[tv]\])? = ([^;]*);", card)}
    if "@ImposedDeformationGradient" in open(sys.argv[1]).read():
        return mtest_rubber(value, open(sys.argv[1]).read())
    bar = Bar(value["E0"][0], value["nu0"][0], value["g"], value["k"], value["tau"])
    text = open(sys.argv[1]).read()
    creep, confined = "@ImposedStress" in text, "'EXX'" in text
    points = [tuple(map(float, p.split(":"))) for p in
              re.search(r"@Imposed\w+<evolution> '\w+' {([^}]*)}", text).group(1).split(",")]
    time = 0.0
    with open(sys.argv[1].replace(".mtest", ".res"), "w") as out:
        print("# first column: time\n0" + " 0" * 12, file=out)
        for end, count in re.findall(r", (\S+) in (\d+)", text):
            start = time
            for i in range(1, int(count) + 1):
                now = start + (float(end) - start) * i / int(count)
                load = ramp(points, now)
                strain, stress = bar.step(now - time, confined=confined,
                                          **{"stress" if creep else "strain": load})
                time = now
                print(repr(time), 0, 0, repr(strain), 0, 0, 0, 0, 0, repr(stress), 0, 0, 0, file=out)


def write_frontistr(step, time, strain, stress):
    with open(f"deck.res.0.{step}", "w") as out:
        print("*fstrresult 2.0\n*comment\nstatic_result\n*global\n1\n1\nTOTALTIME\n"
              f"{time:.16E}\n*data\n8 1\n2 0\n3 6\nDISPLACEMENT\nNodalSTRESS", file=out)
        for node in range(1, 9):
            row = [0, 0, strain if node > 4 else 0, 0, 0, stress, 0, 0, 0]
            words = [f"{x:.16E}" for x in row]
            print(f"{node} \n" + " ".join(words[:5]) + "\n" + " ".join(words[5:]), file=out)


def fistr1():
    if sys.argv[1:] == ["-v"]:
        return print("FrontISTR 5.6.0 (stand-in)")
    rows, keyword, group, law = {}, "", "1", ""
    steps = []
    for line in open("deck.cnt"):
        if line.startswith("#"):
            continue
        if line.startswith("!"):
            keyword = line.strip().split(",")[0]
            group = (re.findall(r"GRPID=(\d)", line) or ["1"])[0]
            law = (re.findall(r"!TRS, *DEFINITION=(\w+)", line) or [law])[0]
            if keyword == "!STEP":
                steps.append({"loads": []})
        elif keyword == "!STEP":
            cells = line.split(",")
            if cells[0].strip() in ("BOUNDARY", "LOAD"):
                steps[-1]["loads"].append((cells[0].strip(), cells[1].strip()))
            else:
                steps[-1].update(dt=float(cells[0]), length=float(cells[1]))
        else:
            rows.setdefault((keyword, group), []).append([c.strip() for c in line.split(",")])
    young, nu = map(float, rows["!ELASTIC", "1"][0])
    prony = [tuple(map(float, r)) for r in rows["!VISCOELASTIC", "1"]]
    slower = 1.0  # the shift factor a_T at the temperature of the model
    if law:
        t_ref, a, b = map(float, rows["!TRS", "1"][0])
        now = float(rows["!TEMPERATURE", "2"][0][1])
        slower = 10 ** (-a * (now - t_ref) / (b + now - t_ref)) if law == "WLF" else math.exp(
            a * (1 / (now - b) - 1 / (t_ref - b)))
    bar = Bar(young, nu, [g for g, _ in prony], [0.0] * len(prony), [slower * t for _, t in prony])
    creep = ("!CLOAD", "1") in rows
    confined = any(r[0] == "X1" for r in rows["!BOUNDARY", "1"])
    pulled = {grp: float(r[3]) for (key, grp), rs in rows.items() if key == "!BOUNDARY"
              for r in rs if r[0] == "Z1"}
    time, n, strain, was_loaded = 0.0, 0, 0.0, False
    for step in steps:
        count = round(step["length"] / step["dt"])
        for i in range(1, count + 1):
            time, n = time + step["dt"], n + 1
            if creep:
                force = 4 * float(rows["!CLOAD", "1"][0][2]) * (1 if was_loaded else i / count)
                strain, stress = bar.step(step["dt"], stress=force, confined=confined)
            else:
                boundary = [grp for kind, grp in step["loads"] if kind == "BOUNDARY"][0]
                strain += pulled[boundary] if i == 1 else 0.0
                _, stress = bar.step(step["dt"], strain=strain, confined=confined)
            write_frontistr(n, time, strain, stress)
            if n == int(os.environ.get("PYTHON_STAND_IN_STOPS_AFTER", "-1")):
                return print(os.environ.get("PYTHON_STAND_IN_SAYS", ""))
        was_loaded = True


name = os.path.basename(sys.argv[0])
{"febio4": febio, "mtest": mtest, "fistr1": fistr1, "mfront": mfront}[name]()
