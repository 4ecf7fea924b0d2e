"""Plots of fits. Matplotlib is imported only here."""

from __future__ import annotations

from ._check import shown
from ._error import Error


def _matplotlib():
    try:
        import matplotlib.pyplot
    except ImportError as missing:
        raise Error("plot() needs matplotlib; install python3-matplotlib", "missing") from missing
    return matplotlib


def _axes(ax):
    plt = _matplotlib().pyplot
    if ax is None:
        return plt.subplots(figsize=(7.0, 4.5), layout="constrained")[1]
    if not isinstance(ax, plt.Axes):
        raise TypeError(f"ax must be axes of matplotlib, such as plt.subplots()[1], not {shown(ax)}")
    return ax


def _check_style(style):
    """Every style is tried on a line that nobody sees, before anything is drawn."""
    Line2D = _matplotlib().lines.Line2D
    for name, value in style.items():
        if value is None:  # matplotlib's default
            continue
        try:
            Line2D([], []).set(**{name: value})
        except (AttributeError, TypeError, ValueError) as failure:
            if not hasattr(Line2D, f"set_{name}"):
                raise TypeError(f"plot() has no keyword '{name}'; it takes those of matplotlib's lines, such as color, "
                                "linewidth and label") from None
            raise Error(f"{name} is {shown(value)}, which matplotlib does not take: {failure}", "usage") from None


def _scale(unit: str, largest: float):
    """Factor and unit in which values are easy to read."""
    if unit not in ("Pa", "N"):
        return 1.0, unit
    steps = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ")]
    for size, prefix in steps:
        if largest >= size:
            return 1.0 / size, prefix + unit
    return 1.0, unit


def plot_fit(result, ax, style):
    _check_style(style)
    ax = _axes(ax)
    curves = result.curves
    is_sweep = result["kind"] == "dma"
    at = curves["at"]
    shown = at > 0.0
    factor, unit = _scale(curves["unit"], float(abs(curves["measured"]).max()))
    color = style.pop("color", None) or ax._get_lines.get_next_color()
    label = style.pop("label", "fit")
    name = {"relaxation": "modulus", "creep": "compliance", "indentation": "force",
            "dma": "storage modulus"}.get(result["kind"], "value")
    ax.plot(at[shown], curves["measured"][shown] * factor, ".", color=color, alpha=0.35, markersize=5,
            markeredgewidth=0)
    ax.plot(at[shown], curves["fitted"][shown] * factor, "-", color=color, label=label, **style)
    if "loss_measured" in curves:
        ax.plot(at, curves["loss_measured"] * factor, "x", color=color, alpha=0.35, markersize=4)
        ax.plot(at, curves["loss_fitted"] * factor, "--", color=color, label=f"{label}, loss", **style)
        ax.set_yscale("log")
    if result["kind"] != "indentation":  # which has several motions, each with its own beginning
        ax.set_xscale("log")
    ax.set_xlabel("frequency (Hz)" if is_sweep else "time (s)")
    if result["kind"] == "dma":
        name = "storage and loss modulus"
    ax.set_ylabel(f"{name} ({unit})" if unit else name)
    ax.grid(True, which="major", alpha=0.3)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(frameon=False)
    return ax


def plot_rubber(rubber, ax):
    import numpy as np

    ax = _axes(ax)
    for i, test in enumerate(rubber["tests"]):
        color = ax._get_lines.get_next_color()
        at = np.linspace(*test["stretch"], 200)
        stress = rubber.stress(at, test["deformation"])
        if rubber.terms and rubber.fitted:  # along the test, with its relaxation
            at, stress = rubber.tests[i][0], rubber.fitted[i]
        if i == 0:
            factor, unit = _scale("Pa", float(np.nanmax(np.abs(stress))))
        ax.plot(at, stress * factor, "-", color=color, label=f"{rubber.law}, {test['name']}")
        if rubber.tests:
            stretch, measured = rubber.tests[i]
            ax.plot(stretch, measured * factor, ".", color=color, alpha=0.5, markeredgewidth=0)
    ax.set_xlabel("stretch")
    ax.set_ylabel(f"nominal stress ({unit})")
    ax.grid(True, which="major", alpha=0.3)
    ax.legend(frameon=False)
    return ax
