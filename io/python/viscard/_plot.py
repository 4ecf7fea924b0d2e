"""Plots. Matplotlib is imported only here."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

from ._check import shown
from ._error import Error


def _matplotlib() -> Any:
    try:
        import matplotlib.pyplot
    except ImportError as missing:
        raise Error("plot() needs matplotlib; install python3-matplotlib", "missing") from missing
    return matplotlib


def _axes(ax: Any) -> Any:
    plt = _matplotlib().pyplot
    if ax is None:
        return plt.subplots(figsize=(7.0, 4.5), layout="constrained")[1]
    if not isinstance(ax, plt.Axes):
        raise TypeError(f"ax must be axes of matplotlib, such as plt.subplots()[1], not {shown(ax)}")
    return ax


def _check_style(style: Dict[str, Any]) -> None:
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


def _scale(unit: str, largest: float) -> Tuple[float, str]:
    """Factor and unit in which values are easy to read."""
    if unit not in ("Pa", "N", "V", "m", "C", "F"):
        return 1.0, unit
    steps = [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")]
    for size, prefix in steps:
        if largest >= size:
            return 1.0 / size, prefix + unit
    return 1.0, unit


def _relative_band(result: Any, at: Any, loss: bool) -> Any:
    """Half of the 95 % band of the fitted curve, relative; None where the fit gives no material, or no curve of it."""
    kind = {"relaxation": "relaxation", "creep": "creep", "dma": "loss" if loss else "storage"}.get(result["kind"])
    if kind is None or result._material is None:
        return None
    value, low, high = getattr(result._material, kind)(at, band=True)
    return 0.5 * (high - low) / value


def _hold_of(curves: Any) -> Any:
    """Rows from the largest value to where it falls suddenly, because the punch is lifted: the hold of an indentation,
    whose relaxation may be too small to be seen beside the ramp. A relaxation falls ever more slowly."""
    import numpy as np

    first = int(np.argmax(curves["fitted"]))
    values, times = curves["fitted"][first:], curves["at"][first:]
    fall = -np.diff(values)
    rate = fall / np.maximum(np.diff(times), 1e-300)
    is_lift = (fall[1:] > 0.01 * values[0]) & (rate[1:] > 3.0 * rate[:-1])
    lift = np.flatnonzero(is_lift)
    return slice(first, first + int(lift[0]) + 2 if lift.size else None)


def _draw_hold(ax: Any, curves: Any, factor: float, color: Any) -> None:
    rows = _hold_of(curves)
    if len(curves["at"][rows]) < 5:
        return
    inset = ax.inset_axes([0.42, 0.1, 0.55, 0.45])
    inset.plot(curves["at"][rows], curves["measured"][rows] * factor, ".", color=color, alpha=0.35, markersize=3)
    inset.plot(curves["at"][rows], curves["fitted"][rows] * factor, "-", color=color)
    inset.set_title("hold", fontsize="small")
    inset.tick_params(labelsize="small")


def plot_fit(result: Any, ax: Any, style: Dict[str, Any]) -> Any:
    """Data, fit and band; on axes of its own also the residuals, and the hold of an indentation."""
    _check_style(style)
    is_own = ax is None
    curves = result.curves
    below = None
    if is_own:
        figure = _matplotlib().pyplot.figure(figsize=(7.0, 5.5), layout="constrained")
        ax, below = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    ax = _axes(ax)
    is_sweep = result["kind"] == "dma"
    at = curves["at"]
    shown = at > 0.0
    factor, unit = _scale(curves["unit"], float(abs(curves["measured"]).max()))
    color = style.pop("color", None) or ax._get_lines.get_next_color()
    label = style.pop("label", "fit")
    name = {"relaxation": "modulus", "creep": "compliance", "indentation": "force",
            "dma": "storage modulus"}.get(result["kind"], "value")

    def draw(measured: Any, fitted: Any, marker: str, line: str, words: str, is_loss: bool) -> None:
        ax.plot(at[shown], measured[shown] * factor, marker, color=color, alpha=0.35, markersize=5, markeredgewidth=0 if marker == "." else 1)
        ax.plot(at[shown], fitted[shown] * factor, line, color=color, label=words, **style)
        half = _relative_band(result, at[shown], is_loss)
        if half is not None:
            ax.fill_between(at[shown], fitted[shown] * factor * (1 - half), fitted[shown] * factor * (1 + half), color=color,
                            alpha=0.2, linewidth=0)

    draw(curves["measured"], curves["fitted"], ".", "-", label, False)
    if "loss_measured" in curves:
        draw(curves["loss_measured"], curves["loss_fitted"], "x", "--", f"{label}, loss", True)
        ax.set_yscale("log")
    if result["kind"] != "indentation":  # which has several motions, each with its own beginning
        ax.set_xscale("log")
    elif is_own:
        _draw_hold(ax, curves, factor, color)
    if below is not None:
        below.plot(at[shown], (result.residuals / curves["sigma"])[shown], ".", color=color, markersize=3)
        below.axhline(0.0, color="0.6", zorder=0)
        below.set_ylabel("residual (sigma)")
    (ax if below is None else below).set_xlabel("frequency (Hz)" if is_sweep else "time (s)")
    if result["kind"] == "dma":
        name = "storage and loss modulus"
    ax.set_ylabel(f"{name} ({unit})" if unit else name)
    ax.grid(True, which="major", alpha=0.3)
    if ax.get_legend_handles_labels()[1]:
        ax.legend(frameon=False)
    return ax


_NAMES = {"relaxation": "relaxation modulus", "creep": "creep compliance", "storage": "storage modulus",
          "loss": "loss modulus", "tan_delta": "loss factor"}


def _curve(ax: Any, at: Any, values: Any, low: Any, high: Any, name: str, unit: str) -> str:
    """A curve with its band, where there is one."""
    import numpy as np

    factor, unit = _scale(unit, float(np.nanmax(np.abs(values))))
    (line,) = ax.plot(at, values * factor, "-", label=name)
    if low is not None and not np.all(np.isnan(low)):
        ax.fill_between(at, low * factor, high * factor, color=line.get_color(), alpha=0.2, linewidth=0)
    return f"{name} ({unit})" if unit else name


def plot_material(material: Any, kind: str, at: Any, ax: Any) -> Any:
    if kind not in _NAMES:
        raise Error(f"kind is {shown(kind)}; use one of {', '.join(_NAMES)}", "usage")
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


def plot_prediction(found: Any, ax: Any) -> Any:
    def unit_of(name: str) -> str:
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


def plot_rubber(rubber: Any, ax: Any) -> Any:
    import numpy as np

    ax = _axes(ax)
    for i, test in enumerate(rubber["tests"]):
        color = ax._get_lines.get_next_color()
        low, high = test["stretch"]
        at = np.linspace(low, high, 200)
        stress = rubber.stress(at, test["deformation"])
        if (rubber.terms or rubber.damage) and rubber.fitted:  # along the test, with its relaxation or damage
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


def plot_joint(joint: Any, ax: Any) -> Any:
    """Specimens, measured ratios with their intervals, and the law between them."""
    import numpy as np

    ax = _axes(ax)
    low, high = float(joint.ratios.min()), float(joint.ratios.max())
    between = np.linspace(low, high, 60)[1:-1]
    try:
        ax.plot(between, [1e-6 * joint.material(float(ratio)).E0_Pa for ratio in between], "-", label="law")
    except Error:  # with own terms of each ratio there is no material between them
        pass
    specimens = joint.json["specimens"]
    ax.plot([one["mixing_ratio"] for one in specimens], [1e-6 * one["E0_Pa"] for one in specimens], ".", label="specimens")
    found = [(one["mixing_ratio"], one["E0_Pa"], one["uncertainty"].get("E0_interval_95")) for one in joint.json["materials"]]
    ratios, E0 = np.array([one[0] for one in found]), np.array([one[1] for one in found])
    ends = np.array([one[1:2] * 2 if one[2] is None else one[2] for one in found], dtype=float).T
    ax.errorbar(ratios, 1e-6 * E0, yerr=1e-6 * np.abs(ends - E0), fmt="o", markerfacecolor="none", capsize=3, label="95 %")
    ax.set_xlabel("mixing ratio")
    ax.set_ylabel("instantaneous modulus (MPa)")
    ax.grid(True, which="major", alpha=0.3)
    ax.legend(frameon=False)
    return ax


def _words(name: str) -> str:
    return name.replace("_", " ")


def plot_answer(answer: Any, name: Optional[str], ax: Any) -> Any:
    """A map, a curve, the modes or the results of a scene; by name, or the first that there is."""
    known = [*answer.maps, *answer.curves, *answer.results]
    if name is not None and name not in known:
        raise Error(f"the answer has no '{name}' to draw; it has {', '.join(known) or 'modes only'}", "usage")
    ax = _axes(ax)
    drawn: str = name or ([*answer.maps, *answer.curves] or [""])[0]
    if drawn in answer.maps:
        _draw_map(ax, answer, drawn)
    elif drawn in answer.curves:
        _draw_curve_of_scene(ax, answer.curves[drawn], drawn)
    elif answer.modes and name is None:
        _draw_modes(ax, answer.modes)
    else:
        _draw_results(ax, answer.results if name is None else {name: answer.results[name]})
    return ax


def _draw_map(ax: Any, answer: Any, name: str) -> None:
    """Pillars at their places, one colour scale about zero where values have both signs."""
    import numpy as np

    values = answer.maps[name]["value"]
    seen = values[np.isfinite(values)]
    factor, unit = _scale(answer.maps[name]["unit"], float(np.abs(seen).max(initial=0.0)))
    most = float(np.abs(seen).max(initial=0.0)) * factor
    limits = {"cmap": "RdBu_r", "vmin": -most, "vmax": most} if seen.size and seen.min() < 0.0 < seen.max() else {}
    finite = np.isfinite(values).ravel()
    places = finite if values.size == answer.x_m.size else np.ones(answer.x_m.size, dtype=bool)
    if places.sum() == seen.size:  # a pillar for each value
        drawn = ax.scatter(1e6 * answer.x_m[places], 1e6 * answer.y_m[places], c=seen * factor, s=200, **limits)
        ax.set(xlabel="x (µm)", ylabel="y (µm)")
    else:
        drawn = ax.imshow(values * factor, origin="lower", **limits)
        ax.set(xlabel="column", ylabel="row")
    ax.figure.colorbar(drawn, ax=ax, label=f"{_words(name)} ({unit})")
    ax.set_aspect("equal")


def _draw_curve_of_scene(ax: Any, curve: Any, name: str) -> None:
    low, high = curve["value"] - curve["error"], curve["value"] + curve["error"]
    ax.set_ylabel(_curve(ax, curve["x"], curve["value"], low, high, _words(name), curve["unit"]))
    ax.set_xlabel({"time_s": "time (s)", "frequency_Hz": "frequency (Hz)"}.get(curve["x_name"], _words(curve["x_name"])))
    if curve["x_name"] == "frequency_Hz":
        ax.set_xscale("log")
        ax.set_yscale("log")
    ax.grid(True, which="major", alpha=0.3)


def _draw_modes(ax: Any, modes: Any) -> None:
    import numpy as np

    names = [mode["name"] for mode in modes]
    values = [mode["frequency_Hz"] for mode in modes]
    factor, prefix = (1e-3, "k") if max(values) >= 1e3 else (1.0, "")
    ax.errorbar(factor * np.array(values), np.arange(len(modes)),
                xerr=factor * np.array([mode["error_estimate"] for mode in modes]), fmt="o", capsize=3)
    ax.set_yticks(range(len(modes)), names)
    ax.invert_yaxis()
    ax.set_xlabel(f"frequency ({prefix}Hz)")
    ax.grid(True, axis="x", alpha=0.3)


def _draw_results(ax: Any, results: Any) -> None:
    """Errors of results of many units, relative: on what the tolerance acts."""
    names = list(results)
    shares = [one.error / abs(one.value) if one.value else 0.0 for one in results.values()]
    ax.barh(range(len(names)), shares)
    ax.set_yticks(range(len(names)), [f"{_words(name)} {one.value:.4g} {one.unit}" for name, one in results.items()])
    ax.invert_yaxis()
    ax.set_xlabel("error estimate, relative")


def plot_sweep(sweep: Any, name: str, ax: Any) -> Any:
    """A result over the parameter with most values, a line for each combination of the others."""
    import numpy as np

    values = sweep[name]
    ax = _axes(ax)
    key = max(sweep.parameters, key=lambda one: len(set(sweep.parameters[one])))
    others = [one for one in sweep.parameters if one != key]
    numbers = [_number_of(text) for text in sweep.parameters[key]]
    is_number = all(one is not None for one in numbers)
    at = np.array(numbers if is_number else [list(dict.fromkeys(sweep.parameters[key])).index(t) for t in sweep.parameters[key]])
    factor, unit = _scale(sweep.results[name]["unit"], float(np.nanmax(np.abs(values))))
    groups: Dict[Tuple[str, ...], Any] = {}
    for i in range(len(values)):
        groups.setdefault(tuple(sweep.parameters[one][i] for one in others), []).append(i)
    for group, rows in groups.items():
        rows = sorted(rows, key=lambda i: float(at[i]))
        label = ", ".join(f"{one.rsplit('.', 1)[-1]} {text}" for one, text in zip(others, group))
        ax.errorbar(at[rows], values[rows] * factor, yerr=np.abs(sweep.results[name]["error"][rows]) * factor, fmt="o-",
                    markersize=3, capsize=2, label=label or None)
    if not is_number:
        ax.set_xticks(range(len(set(sweep.parameters[key]))), list(dict.fromkeys(sweep.parameters[key])))
    units = {text.partition(" ")[2] for text in sweep.parameters[key]} if is_number else set()
    ax.set_xlabel(_words(key) + (f" ({units.pop()})" if len(units) == 1 and "" not in units else ""))
    ax.set_ylabel(f"{_words(name)} ({unit})")
    ax.grid(True, which="major", alpha=0.3)
    if others:
        ax.legend(frameon=False)
    return ax


def _number_of(text: str) -> Optional[float]:
    """40.0 of "40 um"."""
    try:
        return float(text.split()[0])
    except (ValueError, IndexError):
        return None


def plot_cost(cost: Any, ax: Any) -> Any:
    """Error over processor time, and the front that no other row is below."""
    import numpy as np

    ax = _axes(ax)
    ax.plot(cost.cpu_s, cost.error, ".", color="0.6", label="all")
    order = np.argsort(cost.cpu_s[cost.pareto])
    ax.plot(cost.cpu_s[cost.pareto][order], cost.error[cost.pareto][order], "o-", label="best")
    ax.set(xscale="log", yscale="log", xlabel="processor time (s)", ylabel="error, relative")
    ax.grid(True, which="major", alpha=0.3)
    ax.legend(frameon=False)
    return ax


def plot_pressures(values: Any, is_resolved: Any, ax: Any) -> Any:
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
