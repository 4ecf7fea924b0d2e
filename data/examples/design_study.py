#!/usr/bin/env python3
"""A design study: voltage and first bending mode of a pillar sensor against its diameter and length.

usage: design_study.py [FOLDER]      writes study.csv and study.png there (default: study)

Each point is one scene: a dict that Python changes and viscard answers, with error estimates.
"""
import csv
import pathlib
import sys

import numpy as np

import viscard

DATA = pathlib.Path(__file__).parents[1]
DIAMETERS_UM = (30, 40, 50, 60)
LENGTHS_UM = (80, 120, 160)


def pillar(diameter_um: int, length_um: int, analysis: dict[str, object]) -> dict[str, object]:
    """A pillar of PDMS on a film of PVDF with an electrode under its foot."""
    return {
        "tolerance": 1e-2,
        "geometry": {"diameter": f"{diameter_um} um", "length": f"{length_um} um",
                     "film": {"thickness": "25 um", "radius": f"{1.5 * diameter_um} um", "material": "pvdf"},
                     "electrode": {"face": "top", "kind": "equipotential", "radius": f"{diameter_um / 2} um"}},
        "materials": {"pillar": viscard.Material(1.88e6, 0.33, rho_kg_m3=965),
                      "pvdf": {"file": DATA / "materials/pvdf_film_manual.json"}},
        "analysis": analysis}


def study() -> list[dict[str, float]]:
    press: dict[str, object] = {"kind": "static", "load": {"force": "-10 uN", "on": "top"}}
    rows = []
    for diameter_um in DIAMETERS_UM:
        for length_um in LENGTHS_UM:
            try:
                answer = viscard.simulate(pillar(diameter_um, length_um, press))
            except viscard.Error as error:  # too slender: it buckles under this force
                print(f"{diameter_um} um x {length_um} um: {error.message}")
                continue
            modes = viscard.simulate(pillar(diameter_um, length_um, {"kind": "modal", "modes": 1}))
            bending = next(m for m in modes.modes if m["family"] == "lateral")
            voltage = answer.results["electrode_voltage"]
            rows.append({"diameter_um": diameter_um, "length_um": length_um, "voltage_mV": 1e3 * voltage.value,
                         "error_mV": 1e3 * voltage.error, "bending_kHz": 1e-3 * bending["frequency_Hz"]})
    return rows


def plot(rows: list[dict[str, float]], path: pathlib.Path) -> None:
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    for length_um, size in zip(LENGTHS_UM, (13, 9, 5)):  # the voltages of all lengths coincide
        of_length = [row for row in rows if row["length_um"] == length_um]
        x = [row["diameter_um"] for row in of_length]
        axes[0].errorbar(x, np.abs([row["voltage_mV"] for row in of_length]),
                         yerr=[row["error_mV"] for row in of_length], fmt="o-", markersize=size, fillstyle="none", label=f"length {length_um} µm")
        axes[1].plot(x, [row["bending_kHz"] for row in of_length], "o-", label=f"length {length_um} µm")
    axes[0].set(xlabel="diameter (µm)", ylabel="voltage under 10 µN (mV)")
    axes[1].set(xlabel="diameter (µm)", ylabel="first bending mode (kHz)")
    for ax in axes:
        ax.set_xticks(DIAMETERS_UM)
        ax.set_ylim(bottom=0.0)
        ax.grid(alpha=0.3)
        ax.legend(frameon=False)
    figure.savefig(path, dpi=120)


def main(name: str = "study") -> None:
    folder = pathlib.Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    rows = study()
    with open(folder / "study.csv", "w", newline="") as file:
        table = csv.DictWriter(file, rows[0])
        table.writeheader()
        table.writerows(rows)
    plot(rows, folder / "study.png")
    best = max((row for row in rows if row["bending_kHz"] > 5.0), key=lambda row: abs(row["voltage_mV"]))
    print(f"{len(rows)} designs; most voltage with a bending mode above 5 kHz: {best['diameter_um']} um x "
          f"{best['length_um']} um, {abs(best['voltage_mV']):.1f} mV")
    print(f"wrote {folder / 'study.csv'} and {folder / 'study.png'}")


if __name__ == "__main__":
    main(*sys.argv[1:])
