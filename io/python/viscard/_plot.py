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


_NAMES = {"relaxation": "relaxation modulus", "creep": "creep compliance", "storage": "storage modulus",
          "loss": "loss modulus", "tan_delta": "loss factor"}


def _curve(ax, at, values, low, high, name, unit):
    """A curve with its band, where there is one."""
    import numpy as np

    factor, unit = _scale(unit, float(np.nanmax(np.abs(values))))
    (line,) = ax.plot(at, values * factor, "-", label=name)
    if low is not None and not np.all(np.isnan(low)):
        ax.fill_between(at, low * factor, high * factor, color=line.get_color(), alpha=0.2, linewidth=0)
    return f"{name} ({unit})" if unit else name


def plot_material(material, kind, at, ax):
    if kind not in _NAMES:
        raise Error(f"kind is {kind!r}; use one of {', '.join(_NAMES)}", "usage")
    argument = "time_s" if kind in ("relaxation", "creep") else "frequency_Hz"
    at = material._window(at, argument)
    ax = _axes(ax)
    if kind == "tan_delta":
        values, low, high = material.tan_delta(at), None, None
    else:
        values, low, high = getattr(material, kind)(at, band=True)
    unit = {"creep": "1/Pa", "tan_delta": ""}.get(kind, "Pa")
    ax.set_ylabel(_curve(ax, at, values, low, high, _NAMES[kind], unit))
    ax.set_xlabel("time (s)" if argument == "time_s" else "frequency (Hz)")
    ax.set_xscale("log")
    ax.grid(True, which="major", alpha=0.3)
    return ax


def plot_prediction(found, ax):
    def unit_of(name):
        return "1/Pa" if name.endswith("_1_Pa") else "Pa" if name.endswith("_Pa") else ""

    ax = _axes(ax)
    # Over time the answer comes behind its cause, which may have another unit; moduli come before their ratio.
    unit = unit_of(list(found.curves)[0 if found.argument == "frequency_Hz" else -1])
    drawn = [name for name in found.curves if unit_of(name) == unit]
    for name in drawn:
        title = name.removesuffix("_1_Pa").removesuffix("_Pa").replace("_", " ")
        label = _curve(ax, found.at, found.curves[name], found.low.get(name), found.high.get(name), title, unit)
        if len(drawn) == 1:
            ax.set_ylabel(label)
    ax.set_xlabel("time (s)" if found.argument == "time_s" else "frequency (Hz)")
    if found.argument != "time_s":
        ax.set_xscale("log")
        ax.set_yscale("log")
    ax.grid(True, which="major", alpha=0.3)
    if len(drawn) > 1:
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


def plot_pressures(values, is_resolved, ax):
    import numpy as np

    ax = _axes(ax)
    largest = float(np.nanmax(np.abs(values), initial=0.0))
    factor, unit = _scale("Pa", largest)
    is_signed = bool(np.nanmin(values, initial=0.0) < -0.05 * largest)
    image = ax.imshow(values * factor, origin="lower", cmap="RdBu_r" if is_signed else "viridis", interpolation="nearest",
                      vmin=-largest * factor if is_signed else 0.0, vmax=largest * factor or None)
    rows, columns = np.nonzero(~is_resolved & np.isfinite(values))
    ax.plot(columns, rows, "x", color="0.5", markersize=4)
    ax.figure.colorbar(image, ax=ax, label=f"pressure ({unit})")
    ax.set_xlabel("column")
    ax.set_ylabel("row")
    return ax
