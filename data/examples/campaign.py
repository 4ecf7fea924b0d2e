#!/usr/bin/env python3
"""A campaign: ten specimens of PDMS into one table and one plot.

usage: campaign.py [FOLDER]      writes specimen_01.csv ..., campaign.csv and campaign.png there (default: campaign)

The relaxation curves are synthetic: specimens whose modulus scatters by 4 %, with noise of 0.2 %. Replace
`make_curves` by your own files; viscard finds the columns by name and unit.
"""
import csv
import pathlib
import sys

import numpy as np

import viscard


def make_curves(folder: pathlib.Path, n_specimens: int = 10) -> list[pathlib.Path]:
    """Files of E(t) of specimens with E0 about 1.88 MPa, as a relaxation test in tension gives them."""
    random = np.random.default_rng(20)
    time_s = np.geomspace(0.01, 300.0, 500)
    paths = []
    for number in range(1, n_specimens + 1):
        pdms = viscard.Material(1.88e6 * random.normal(1.0, 0.04), 0.495, terms=[(0.05, 0.2), (0.08, 2.4), (0.06, 40.0)])
        modulus_Pa = pdms.relaxation(time_s) * random.normal(1.0, 0.002, time_s.size)
        paths.append(folder / f"specimen_{number:02d}.csv")
        np.savetxt(paths[-1], np.column_stack([time_s, modulus_Pa * 1e-6]), delimiter=",",
                   header="Time [s],E relax [MPa]", comments="")
    return paths


def write_table(results: list[viscard.FitResult], path: pathlib.Path) -> None:
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["specimen", "E0_MPa", "low_95", "high_95", "E_inf_MPa", "terms", "flags"])
        for result in results:
            low, high = result.E0_interval
            table.writerow([pathlib.Path(result.file).stem, f"{result.E0_Pa * 1e-6:.4f}", f"{low * 1e-6:.4f}",
                            f"{high * 1e-6:.4f}", f"{result.E_inf_Pa * 1e-6:.4f}", len(result.tau_s),
                            " ".join(sorted({flag.name for flag in result.flags}))])


def plot(results: list[viscard.FitResult], path: pathlib.Path) -> None:
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    figure, (curves, moduli) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    for number, result in enumerate(results):
        result.plot(ax=curves, color=plt.cm.viridis(number / len(results)), label=f"{number + 1}")
        E0_MPa, (low, high) = result.E0_Pa * 1e-6, np.array(result.E0_interval) * 1e-6
        moduli.errorbar(number + 1, E0_MPa, yerr=[[E0_MPa - low], [high - E0_MPa]], fmt=".", capsize=5,
                        color=plt.cm.viridis(number / len(results)))
    mean = np.mean([result.E0_Pa for result in results]) * 1e-6
    moduli.axhline(mean, color="0.6", zorder=0)
    moduli.set(xlabel="specimen", ylabel="E0 (MPa), 95 % interval", title=f"mean {mean:.3f} MPa",
               xticks=range(1, len(results) + 1))
    curves.legend(title="specimen", ncols=2, frameon=False)
    curves.set_title("data and fits")
    figure.savefig(path, dpi=120)


def main(name: str = "campaign") -> None:
    folder = pathlib.Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    results = viscard.fit(make_curves(folder))  # all ten, on all cores
    write_table(results, folder / "campaign.csv")
    plot(results, folder / "campaign.png")
    E0_Pa = np.array([result.E0_Pa for result in results])
    print(f"{len(results)} specimens: E0 {E0_Pa.mean() * 1e-6:.3f} MPa, scatter {E0_Pa.std(ddof=1) / E0_Pa.mean():.1%}")
    print(f"wrote {folder / 'campaign.csv'} and {folder / 'campaign.png'}")


if __name__ == "__main__":
    main(*sys.argv[1:])
