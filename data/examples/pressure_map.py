#!/usr/bin/env python3
"""A touch in motion read back: voltages of 40 x 40 electrodes to pressures with their intervals.

usage: pressure_map.py [FOLDER]      writes pressure_map.png there (default: pressure_map)

A sphere is pressed on an array at several depths; its voltages get noise, gains that spread by 1 % and dead electrodes.
Replace `recorded` by your own frames: an array (frames, rows, columns) of V, NaN where an electrode is dead.
"""
import pathlib
import sys
import time
from typing import Any, Dict, Optional, Tuple

import numpy as np

import viscard

NOISE_V, GAIN_SPREAD = 2e-4, 0.01
DEPTHS = ("0.5 um", "1 um", "1.5 um")


def array_of(depth: Optional[str] = None) -> Dict[str, Any]:
    scene: Dict[str, Any] = {
        "tolerance": 2e-3,
        "geometry": {"kind": "array", "model": "space", "rows": 40, "columns": 40, "lattice": "square", "spacing": "60 um",
                     "diameter": "40 um", "length": "120 um",
                     "film": {"thickness": "25 um", "edge": "150 um", "material": "pvdf"},
                     "electrode": {"face": "bottom", "kind": "sampled", "radius": "20 um"}},
        "materials": {"pillar": {"E": "1.8 MPa", "nu": 0.33, "rho": "965 kg/m3"},
                      "pvdf": {"file": viscard.data_file("materials/pvdf_seed.json")}},
        "analysis": {"kind": "static"}}
    if depth:
        scene["shape"] = {"kind": "sphere", "radius": "100 mm", "depth": depth, "at": ["300 um", "-200 um"]}
        scene["want"] = {"quantities": ["mean_voltage", "pillar_force"]}
    return scene


def recorded() -> Tuple["np.ndarray[Any, Any]", "np.ndarray[Any, Any]"]:
    """Frames of voltages, and the pressures that made them."""
    random = np.random.default_rng(3)
    gains = random.normal(1.0, GAIN_SPREAD, (40, 40))
    frames, pressures = [], []
    for depth in DEPTHS:
        answer = viscard.simulate(array_of(depth))
        clean_V = answer.maps["mean_voltage"]["value"]
        frames.append(gains * clean_V + random.normal(0.0, NOISE_V, clean_V.shape))
        pressures.append(answer.maps["pillar_force"]["value"] / (np.pi * 20e-6**2))
    voltages = np.array(frames)
    for row, column in random.integers(0, 40, (8, 2)):
        voltages[:, row, column] = np.nan
    return voltages, np.array(pressures)


def main() -> None:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "pressure_map")
    folder.mkdir(parents=True, exist_ok=True)
    voltages, made_Pa = recorded()
    reader = viscard.PressureReader(array_of(), voltages, noise=NOISE_V, gain_spread=GAIN_SPREAD)
    started = time.process_time()
    found = reader.read(voltages)
    spent_ms = 1e3 * (time.process_time() - started) / len(voltages)
    inside = np.abs(found.pressure_Pa - made_Pa) <= found.pressure_half_width_Pa
    print(f"{len(voltages)} frames, {spent_ms:.2f} ms of processor time each; {100.0 * inside.mean():.1f} % of the pressures lie "
          "within their intervals")
    print(f"weight {found.regularisation['weight']:.1e} by {found.regularisation['rule']}; resolution "
          f"{np.nanmedian(found.resolution_m) * 1e6:.0f} um; {', '.join(found.notes)}")
    ax = found.plot(frame=len(voltages) - 1)
    ax.figure.savefig(folder / "pressure_map.png", dpi=120)


if __name__ == "__main__":
    main()
