"""What the solver answers for a scene: Answer, Plan and Cost."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np

from ._result import Result


class Value(NamedTuple):
    """A result with its unit (SI) and error estimate (absolute, in the unit); ``float(value)`` is the number.

    Examples
    --------
    >>> float(viscard.Value(1.5, "V", 1e-3))
    1.5
    """

    value: float
    unit: str
    error: float

    def __float__(self) -> float:
        return self.value


class Field(NamedTuple):
    """Solution on the section of a pillar.

    name : "static", or the family of a mode; harmonic: fields vary as cos(harmonic theta).
    x_m, z_m : arrays, shape (points,); quads : int array, shape (quads, 4), indices of points.
    values : dict of {"unit", "value"}; value has the shape (points, 3) for a displacement (r, theta, z),
    (points, 1) for a scalar.

    Examples
    --------
    >>> answer = viscard.simulate(viscard.data_file("scenes/pillar_press.toml"), fields=True)
    >>> field = answer.fields[0]
    >>> field.values["displacement_m"]["value"].shape == (field.x_m.size, 3)
    True
    """

    name: str
    harmonic: int
    x_m: np.ndarray
    z_m: np.ndarray
    quads: np.ndarray
    values: Dict[str, Dict[str, Any]]


class Answer:
    """The answer of a scene. ``answer["name"]`` is a result in SI as a float, or the frequency of a mode ("torsion 1") in Hz.

    Attributes
    ----------
    results : dict of Value
    modes : list of dict
        name ("torsion 1"), family, harmonic, frequency_Hz, error_estimate, damping_ratio (or None).
    curves : dict of {"unit", "x_name", "x", "value", "error"}
        Histories and responses; arrays of shape (points,).
    maps : dict of {"unit", "value", "error"}
        Of an array in the plane; arrays of shape (rows, columns), NaN where no pillar stands.
    x_m, y_m : arrays, shape (pillars,)
        Places of the pillars of maps, by row, then column.
    fields : list of Field
        With ``simulate(..., fields=True)``, of static and modal scenes of one pillar.
    effects : list of dict
        What the plan left out, and why.
    uncertainty : dict or None
        With ``simulate(..., uncertainty=True)``: "method" ("linear", "quadratic" or "sobol") and its "reason", "inputs"
        {name: text}, "derivatives" {name: "solver" (one solution, reused) or "differences" (of whole answers)},
        "results" {name: {"value", "unit", "interval_95", "standard_uncertainty", "numerical_error",
        "shares" {input: share of the variance}, "share_errors"}}, "answers", "first_order_answers", "failed",
        "failed_share" (of the samples of the intervals), "notes". Samples without an answer count as beyond either
        end; if they are more than 2.5 %, "interval_95" is None and "no_interval" says why.
    notes : list of str
    within_tolerance : bool
    unknowns : int

    Examples
    --------
    >>> answer = viscard.simulate(viscard.data_file("scenes/pillar_press.toml"))
    >>> sorted(answer.results)
    ['electrode_capacitance', 'electrode_charge', 'electrode_voltage', 'top_force', 'top_stiffness']
    >>> f"{answer['electrode_voltage'] * 1e3:.0f} mV"
    '29 mV'
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.results = {name: Value(*row) for name, row in found["results"].items()}
        self.modes: List[Dict[str, Any]] = found["modes"]
        self.curves: Dict[str, Dict[str, Any]] = found["curves"]
        self.maps: Dict[str, Dict[str, Any]] = found["maps"]
        self.x_m: np.ndarray = found["x_m"]
        self.y_m: np.ndarray = found["y_m"]
        self.fields = [Field(f["name"], f["harmonic"], f["x_m"], f["z_m"], f["quads"], f["values"])
                       for f in found["fields"]]
        self.effects: List[Dict[str, Any]] = found["effects"]
        self.uncertainty = _uncertainty(found["uncertainty"])
        self.notes: List[str] = found["notes"]
        self.within_tolerance: bool = found["within_tolerance"]
        self.unknowns: int = found["unknowns"]

    def __getitem__(self, name: str) -> float:
        if name in self.results:
            return self.results[name].value
        frequencies = {mode["name"]: mode["frequency_Hz"] for mode in self.modes}
        if name in frequencies:
            return frequencies[name]
        raise KeyError(f"the answer has no '{name}'; it has {', '.join([*self.results, *frequencies]) or 'no results'}")

    @property
    def frequencies_Hz(self) -> np.ndarray:
        """Of all modes, shape (modes,)."""
        return np.array([mode["frequency_Hz"] for mode in self.modes])

    def __repr__(self) -> str:
        shown = [f"{name} {v.value:.4g} {v.unit}" for name, v in self.results.items()]
        shown += [f"{m['family']} {m['frequency_Hz']:.4g} Hz" for m in self.modes]
        return "<viscard.Answer " + ", ".join(shown[:4]) + (", ...>" if len(shown) > 4 else ">")


def _uncertainty(found: Optional[Dict[str, Any]]) -> Optional[Dict[str, Any]]:
    """By the names of inputs and results; a result without an interval has None."""
    if found is None:
        return None
    results = {}
    for one in found["results"]:
        of = {key: one[key] for key in ("value", "unit", "interval_95", "standard_uncertainty", "numerical_error")}
        if "no_interval" in one:
            of.update(interval_95=None, no_interval=one["no_interval"])
        of["shares"] = {cause["input"]: cause["share"] for cause in one["causes"]}
        of["share_errors"] = {cause["input"]: cause["share_standard_error"] for cause in one["causes"]}
        results[one["name"]] = of
    names = ("method", "reason", "answers", "first_order_answers", "failed", "failed_share", "notes")
    return {**{name: found[name] for name in names}, "results": results,
            "inputs": {one["name"]: one["text"] for one in found["inputs"]},
            "derivatives": {one["name"]: one["derivatives"] for one in found["inputs"]}}


class Plan(Result):
    """The effects that a scene needs at its tolerance.

    Attributes
    ----------
    effects : list of dict
        name, on, estimate (relative error of leaving it out), number, value, forced, counted, choice, reason.
    savings : list of dict
        What leaving an effect out saves: effect, cpu_s, cpu_s_without, unknowns, unknowns_without.
    tolerance, mesh_tolerance, left_out : float

    Examples
    --------
    >>> plan = viscard.plan(viscard.data_file("scenes/pillar_press.toml"))
    >>> plan.is_on("piezo_coupling") in (True, False)
    True
    """

    def __init__(self, core) -> None:
        super().__init__(core)
        self.effects: List[Dict[str, Any]] = self.values["effects"]
        self.savings: List[Dict[str, Any]] = self.values["savings"]
        self.tolerance: float = self.values["tolerance"]
        self.mesh_tolerance: float = self.values["mesh_tolerance"]
        self.left_out: float = self.values["left_out"]

    def is_on(self, effect: str) -> bool:
        for one in self.effects:
            if one["name"] == effect:
                return one["on"]
        raise KeyError(f"no effect '{effect}'; there are {', '.join(e['name'] for e in self.effects)}")

    def __repr__(self) -> str:
        return "<viscard.Plan on: " + ", ".join(e["name"] for e in self.effects if e["on"]) + ">"


class Cost(Result):
    """Error of a scene against processor time, over discretisations and effects.

    Attributes
    ----------
    discretisation, effects : list of str
    unknowns, cpu_s, wall_s, memory_B, error : arrays, shape (rows,)
    pareto : array of bool
        No other row takes less processor time and is as accurate.
    recommendations : list of (tolerance, row or -1, text)
    reference, reference_error, rows_left_out
    rows_without_answer : list of (discretisation, effects, reason)

    Examples
    --------
    >>> cost = viscard.cost(viscard.data_file("scenes/pillar_press.toml"), budget="0.2 s")
    >>> cost.error.shape == cost.cpu_s.shape
    True
    """

    def __init__(self, core) -> None:
        super().__init__(core)
        rows, found = self.values["rows"], self.values
        self.discretisation: List[str] = [row["discretisation"] for row in rows]
        self.effects: List[str] = [row["effects"] for row in rows]
        for name, kind in (("unknowns", int), ("cpu_s", float), ("wall_s", float), ("memory_B", float),
                           ("error", float), ("pareto", bool)):
            setattr(self, name, np.array([row[name] for row in rows], dtype=kind))
        self.recommendations = [(one["tolerance"], -1 if one["row"] is None else one["row"], one["text"])
                                for one in found["recommendations"]]
        self.reference: str = found["reference"]
        self.reference_error: float = found["reference_error"]
        self.rows_left_out: int = found["rows_left_out"]
        self.rows_without_answer = [(one["discretisation"], one["effects"], one["reason"])
                                    for one in found["rows_without_answer"]]

    def __repr__(self) -> str:
        return f"<viscard.Cost: {len(self.error)} rows, {int(self.pareto.sum())} on the Pareto front>"
