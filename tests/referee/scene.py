"""A scene file of tests/referee/scenes in the units of section.py, and viscard's answer to it."""
import csv
import json
import os
import re
import subprocess
import tomllib

import section as fem

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes")
UNITS = {"um": 1e-6, "mm": 1e-3, "Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "kg/m3": 1.0, "s": 1.0, "us": 1e-6, "V": 1.0,
         "Hz": 1.0, "kHz": 1e3, "m/s2": 1.0}


def si(text):
    number, unit = text.split()
    return float(number) * UNITS[unit]


def um(text):
    return si(text) * 1e6


class Scene:
    """A scene file in the units of the sections."""
    def __init__(self, name):
        with open(os.path.join(SCENES, name + ".toml"), "rb") as file:
            self.toml = tomllib.load(file)
        g, self.analysis = self.toml["geometry"], self.toml["analysis"]
        self.R, self.L = um(g["diameter"]) / 2, um(g["length"])
        self.geometry, self.pillar = g, self.read("pillar")
        self.t = um(g["film"]["thickness"]) if "film" in g else 0.0
        self.film = self.read("film") if "film" in g else {"E": 1e6, "nu": 0.3, "rho": 0.0}

    def read(self, name):
        raw = self.toml["materials"][name]
        if "file" not in raw:
            return {"E": si(raw["E"]), "nu": raw["nu"], "rho": si(raw["rho"]), "terms": []}
        with open(os.path.join(SCENES, raw["file"]), encoding="utf-8") as file:
            data = json.load(file)
        if data["schema"].startswith("viscard-material"):
            return {"E": data["E0_Pa"], "nu": data["nu"], "rho": data["rho_kg_m3"], "terms": data["terms"]}
        return {"E": data["elastic"]["E_Pa"], "nu": data["elastic"]["nu"], "rho": data["rho_kg_m3"],
                "d": data["charge_C_N"], "permittivity": data["relative_permittivity"]}

    def constants(self, **more):
        film = fem.Film(self.film["E"], self.film["nu"], self.film.get("d"), self.film.get("permittivity"))
        pillar = fem.Film(self.pillar["E"], self.pillar["nu"])
        out = {"la": pillar.la, "mu": pillar.mu, "rho": self.pillar["rho"] * 1e-18, "la_film": film.la, "mu_film": film.mu,
               "rho_film": self.film["rho"] * 1e-18, "axis": 1, "m": 0, "pressing": 0.0, "elements": "[P2, P2, P2]"}
        for key in ("e31", "e33", "e15", "k11", "k33"):
            out[key] = getattr(film, key, 0.0)
        return film, {**out, **more}

    def section(self, **more):
        Rf = um(self.geometry["film"]["radius"]) if self.t else 0.0
        return fem.Section(self.R, self.L, self.t, Rf, **more)

    def load_MPa(self, key):
        return si(self.analysis["load"].get(key, "0 Pa")) / 1e6


def filled(text, values):
    """Braces in FreeFEM's own blocks stay."""
    return re.sub(r"\{(\w+)\}", lambda found: str(values[found.group(1)]), text)


def answer_of_viscard(viscard, name, folder):
    """Every number of the answer with the error it claims."""
    out = os.path.join(folder, "out")
    done = subprocess.run([viscard, "simulate", os.path.join(SCENES, name + ".toml"), "--json", "--out", out],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"viscard refuses {name}: {done.stderr}")
    answer = json.loads(done.stdout)
    found = {key: (one["value"], one["error_estimate"]) for key, one in answer["results"].items()}
    count = {}
    for mode in answer["modes"]:
        count[mode["family"]] = count.get(mode["family"], 0) + 1
        found[f"{mode['family']} {count[mode['family']]}"] = mode["frequency_Hz"], mode["error_estimate"]
    for file in os.listdir(out):
        if not file.endswith(".csv") or file == "results.csv":
            continue
        with open(os.path.join(out, file), encoding="utf-8") as table:
            rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
        for i, line in enumerate(rows):
            for key in line:
                error = line.get(f"error_{key}")
                if error is not None:
                    found[f"{re.sub('_(m|Pa|V|C|1)$', '', key)}[{i}]"] = float(line[key]), float(error)
    return found
