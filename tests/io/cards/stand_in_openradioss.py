#!/usr/bin/python3
"""Stands in for OpenRadioss' starter and engine and its converter th_to_csv, by the name it is called:
integrates the equations of motion of the brick of a deck explicitly, with masses, damping and the law
of /MAT/LAW40, and writes the time history as th_to_csv does. Sources in github.com/OpenRadioss:
execargcheck.F (-version), unit_code.F and hm_read_unit.F (units), hm_read_mat40.F and sigeps40.F (the
law), damping.F, hist2.F (when a row is written) and wrtdes.F (in single precision), th_to_csv.c
(csvFileWrite). An independent implementation for tests of viscard: its own integration, not theirs."""
import json
import math
import os
import re
import struct
import sys

PREFIX = {"": 1.0, "u": 1e-6, "mu": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6}


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def unit(word, base):
    try:
        return float(word)
    except ValueError:
        return PREFIX[word[:-1]] * (1e-3 if base == "g" else 1.0)


def fields(line, width=20):
    line = line.rstrip("\n")
    return [line[i:i + width].strip() for i in range(0, len(line), width)]


class Deck:
    """Blocks of a deck: their lines without comments, by keyword."""

    def __init__(self, path):
        self.blocks, block = {}, []
        for line in open(path):
            if line.startswith("/"):
                block = self.blocks.setdefault(line.strip(), [])
            elif not line.startswith("#"):
                block.append(line)

    def block(self, start):
        found = [rows for key, rows in self.blocks.items() if key.startswith(start)]
        return found[0] if found else None


def factors(row):
    return [unit(word, base) for word, base in zip(fields(row), "gms")]


class Law40:
    """Deviatoric stress of branches exact for a constant rate in the step; the bulk is elastic."""

    def __init__(self, deck):
        key = [k for k in deck.blocks if k.startswith("/MAT/LAW40/")][0]
        own, work = factors(deck.block("/UNIT/" + key.split("/")[4])[1]), factors(
            deck.block("/BEGIN")[2])
        mass, length, time = (a / b for a, b in zip(own, work))
        stress = mass / length / time**2
        rows = deck.blocks[key]
        self.rho = float(fields(rows[1])[0]) * mass / length**3
        self.bulk, self.lasting = (float(x) * stress for x in fields(rows[2])[:2])
        shear, decay = ([float(x) for x in fields(row)] for row in rows[3:5])
        self.branches = [(g * stress, b / time) for g, b in zip(shear, decay) if g > 0.0]
        total = self.lasting + sum(g for g, _ in self.branches)
        assert 3 * self.bulk > 2 * total, "ERROR TERMINATION: nu below 0"
        self.sound = math.sqrt((self.bulk + 8 / 3 * total) / self.rho)

    def weights(self, dt):
        return [(math.exp(-b * dt), -2 * g * math.expm1(-b * dt) / (b * dt))
                for g, b in self.branches]


def curve(rows):
    points = [tuple(map(float, fields(row))) for row in rows[1:]]
    at = 0

    def value(t):
        nonlocal at
        while at < len(points) - 2 and t > points[at + 1][0]:
            at += 1
        (t0, y0), (t1, y1) = points[at], points[at + 1]
        return y0 + (y1 - y0) * (t - t0) / (t1 - t0)
    return value


def engine(path):
    run, deck = Deck(path), Deck("deck_0000.rad")
    law = Law40(deck)
    edge = float(deck.block("/NODE")[6][50:70])
    creep, alpha = deck.block("/CLOAD") is not None, float(fields(deck.block("/DAMP")[1])[0])
    load = curve(deck.block("/FUNCT"))
    confined = deck.block("/BCS/4") is not None
    end, output = float(run.block("/RUN")[0]), float(run.block("/TFILE")[0])
    dt = float(fields(run.block("/DT")[0])[0]) * edge / law.sound
    weights, lasting, bulk = law.weights(dt), 2 * law.lasting, law.bulk
    q = [0.0] * len(weights)
    inertia, area = law.rho * edge * edge / 2, edge * edge  # of a face, over its area and edge
    keep, gain = (1 - alpha * dt / 2) / (1 + alpha * dt / 2), dt / (1 + alpha * dt / 2)
    t = ez = ex = vz = vx = sz = sx = dev = 0.0
    rows, due, most = [], 0.0, int(os.environ.get("PYTHON_STAND_IN_STOPS_AFTER", "-1"))
    while True:
        if t >= due:
            rows.append([single(x) for x in (t, dt, ez * edge, sz)])
            due = max(t, due + output)
            if len(rows) == most:
                print(os.environ.get("PYTHON_STAND_IN_SAYS", ""))
                break
        if t >= end:
            print("     NORMAL TERMINATION")
            break
        vx = 0.0 if confined else keep * vx + gain * (-sx / inertia)
        if creep:  # a quarter of the load on each of four nodes
            vz = keep * vz + gain * ((4 * load(t) / area - sz) / inertia)
            ez += vz * dt
        else:
            ez = load(t + dt) / edge
        ex += vx * dt
        t += dt
        now = 2 / 3 * (ez - ex)
        rise, dev = now - dev, now
        s = lasting * dev
        for i, (decay, phi) in enumerate(weights):
            q[i] = decay * q[i] + phi * rise
            s += q[i]
        p = bulk * (ez + 2 * ex)
        sz, sx = p + s, p - s / 2
    json.dump(rows, open("deckT01", "w"))
    if run.block("/TH/TITLE") is not None:
        open("deckT01_TITLES", "w").write("         0 DZ        \n         1 SZ        \n")


GLOBAL = ["INTERNAL ENERGY", "KINETIC ENERGY", "X-MOMENTUM", "Y-MOMENTUM", "Z-MOMENTUM", "MASS",
          "TIME STEP", "ROTATION ENERGY", "EXTERNAL WORK", "SPRING ENERGY", "CONTACT ENERGY",
          "HOURGLASS ENERGY", "ELASTIC CONTACT ENERGY", "FRICTIONAL CONTACT ENERGY",
          "DAMPING CONTACT ENERGY "]


def th_to_csv(path):
    groups = [f"{name:<100} {item} {'':<100} " for name, item in (("length", 7), ("stress", 1))]
    titled = os.path.exists(path + "_TITLES")
    ends = [" DZ         ", " SZ         "] if titled else ["var 16", "var 17"]
    with open(path + ".csv", "w") as out:
        out.write("".join(f'"{name}",' for name in ["time"] + GLOBAL))
        out.write(",".join(f'"{g}{e}"' for g, e in zip(groups, ends)) + "\n")
        for t, dt, dz, sz in json.load(open(path)):
            values = [t] + [0.0] * 6 + [dt] + [0.0] * 8 + [dz, sz]
            out.write(",".join(f"{x:f}" for x in values) + "\n")
    print(" ** CONVERSION COMPLETED")


name = os.path.basename(sys.argv[0])
if name.startswith("starter") and sys.argv[1:] == ["-version"]:
    print(" \nOpenRadioss Starter \n \nPlatform release : linux64_gf\nPlatform info : Linux 64 bits\n \n"
          "Time of build : 12:00:00\nDate of build : Jan  1 2026\n ")
elif name.startswith("starter"):
    assert sys.argv[1:] == ["-i", "deck_0000.rad", "-np", "1"]
    Law40(Deck(sys.argv[2]))
    print("     NORMAL TERMINATION")
elif name.startswith("engine"):
    engine(sys.argv[sys.argv.index("-i") + 1])
else:
    th_to_csv(sys.argv[1])
