"""What the solver answers for a scene: Answer, Plan and Cost."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Tuple, TypedDict, cast

import numpy as np

from . import _check, _core, _show
from ._result import Result, Tabular, plain
from ._types import Booleans, Floats, Integers


class Mode(TypedDict):
    """A mode of vibration or of buckling."""

    name: str
    family: str
    harmonic: int
    frequency_Hz: float
    error_estimate: float
    damping_ratio: Optional[float]


class Curve(TypedDict):
    """A history or a response."""

    unit: str
    x_name: str
    x: Floats
    value: Floats
    error: Floats


class MapOfPillars(TypedDict):
    """A result of all pillars of an array, shape (rows, columns)."""

    unit: str
    value: Floats
    error: Floats


class FieldValues(TypedDict):
    """Values of a field, shape (points, components)."""

    unit: str
    value: Floats


class Effect(TypedDict):
    """An effect that a scene has or leaves out, and why."""

    name: str
    on: bool
    estimate: float
    number: str
    value: float
    forced: bool
    counted: bool
    choice: str
    reason: str


class UncertainResult(TypedDict, total=False):
    """A result with its interval."""

    value: float
    unit: str
    interval_95: Optional[Tuple[float, float]]
    no_interval: str
    standard_uncertainty: float
    numerical_error: float
    shares: Dict[str, float]
    share_errors: Dict[str, float]


class Compared(TypedDict):
    """Two answers beside each other: what both have. The keys of the lists are those of ``--json``."""

    scene: str
    values: List[Dict[str, Any]]
    profiles: List[Dict[str, Any]]


class Uncertainty(TypedDict):
    """Intervals of results, and what they come from."""

    method: str
    reason: str
    answers: int
    first_order_answers: int
    failed: int
    failed_share: float
    notes: List[str]
    results: Dict[str, UncertainResult]
    inputs: Dict[str, str]
    derivatives: Dict[str, str]


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
    x_m: Floats
    z_m: Floats
    quads: Integers
    values: Dict[str, FieldValues]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Field) and bool(plain(tuple(self)) == plain(tuple(other)))

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(repr(plain(tuple(self))))


class Answer(Tabular):
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
    compared : dict or None
        With ``simulate(..., compare="other.toml")``: "scene" (the other file), "values", a list of {"name", "unit", "value",
        "error", "other", "other_error", "ratio", "ratio_error"}, and "profiles", voltages along x.
    notes : list of str
    within_tolerance : bool
        Every error estimate meets the tolerance.
    effects_within_tolerance : bool
        No effect that is not computed may change the results by more than the tolerance.
    tolerance_doubt : str
        Why the results are not within the tolerance, of both; "": they are. `simulate` warns of it with DoubtWarning.
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
        self.modes: List[Mode] = found["modes"]
        self.curves: Dict[str, Curve] = found["curves"]
        self.maps: Dict[str, MapOfPillars] = found["maps"]
        self.x_m: Floats = found["x_m"]
        self.y_m: Floats = found["y_m"]
        self.fields = [Field(f["name"], f["harmonic"], f["x_m"], f["z_m"], f["quads"], f["values"])
                       for f in found["fields"]]
        self.effects: List[Effect] = found["effects"]
        self.uncertainty: Optional[Uncertainty] = _uncertainty(found["uncertainty"])
        self.compared: Optional[Compared] = found["compared"]
        self.notes: List[str] = found["notes"]
        self.within_tolerance: bool = found["tolerance"]["within_tolerance"]
        self.effects_within_tolerance: bool = found["tolerance"]["effects_within_tolerance"]
        self.tolerance_doubt: str = found["tolerance"]["tolerance_doubt"]
        self.unknowns: int = found["unknowns"]

    def __getitem__(self, name: str) -> float:
        if name in self.results:
            return self.results[name].value
        frequencies = {mode["name"]: mode["frequency_Hz"] for mode in self.modes}
        if name in frequencies:
            return frequencies[name]
        raise KeyError(f"the answer has no '{name}'; it has {', '.join([*self.results, *frequencies]) or 'no results'}")

    @property
    def frequencies_Hz(self) -> Floats:
        """Of all modes, shape (modes,)."""
        return np.array([mode["frequency_Hz"] for mode in self.modes])

    @_check.arguments
    def plot(self, name: Optional[str] = None, ax: Any = None) -> Any:
        """Draw a map, a curve or a result with its error. Needs matplotlib. Returns the axes.

        Parameters
        ----------
        name : str
            Of maps, curves or results. Default: the first map, or the first curve, or all modes, or all results.
        ax : matplotlib axes
            Default: new ones.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> viscard.simulate(viscard.data_file("scenes/pillar_modal.toml")).plot().get_xlabel()
        'frequency (kHz)'
        """
        from ._plot import plot_answer

        return plot_answer(self, name, ax)

    def _table(self) -> _show.Columns:
        rows: List[Any] = [(name, one.value, one.unit, one.error) for name, one in self.results.items()]
        missing: List[None] = []  # of modes, the intervals
        if self.uncertainty is not None:
            of, missing = self.uncertainty["results"], [None]
            rows = [(*row, of[row[0]].get("interval_95") if row[0] in of else None) for row in rows]
        rows += [(mode["name"], mode["frequency_Hz"], "Hz", mode["error_estimate"], *missing) for mode in self.modes]
        heads = ["name", "value", "unit", "error"] + ["interval_95"] * len(missing)
        curves = [f"curve {name} ({len(curve['x'])} points)" for name, curve in self.curves.items()]
        return _show.of_rows("answer", heads, rows, curves + [f"map {name}" for name in self.maps] + self.notes)

    def __repr__(self) -> str:
        shown = [f"{name} {v.value:.4g} {v.unit}" for name, v in self.results.items()]
        shown += [f"{m['family']} {m['frequency_Hz']:.4g} Hz" for m in self.modes]
        return "<viscard.Answer " + ", ".join(shown[:4]) + (", ...>" if len(shown) > 4 else ">")


def _uncertainty(found: Optional[Dict[str, Any]]) -> Optional[Uncertainty]:
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
    whole = {**{name: found[name] for name in names}, "results": results,
             "inputs": {one["name"]: one["text"] for one in found["inputs"]},
             "derivatives": {one["name"]: one["derivatives"] for one in found["inputs"]}}
    return cast(Uncertainty, whole)


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

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        self.effects: List[Effect] = self.values["effects"]
        self.savings: List[Dict[str, Any]] = self.values["savings"]
        self.tolerance: float = self.values["tolerance"]
        self.mesh_tolerance: float = self.values["mesh_tolerance"]
        self.left_out: float = self.values["left_out"]

    @_check.arguments
    def is_on(self, effect: str) -> bool:
        for one in self.effects:
            if one["name"] == effect:
                return one["on"]
        raise KeyError(f"no effect '{effect}'; there are {', '.join(e['name'] for e in self.effects)}")

    def _table(self) -> _show.Columns:
        return _show.of_dicts(f"plan, tolerance {self.tolerance:g}; estimate: error without the effect",
                              ["name", "on", "estimate", "reason"], self.effects)

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

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        rows, found = self.values["rows"], self.values
        self.discretisation: List[str] = [row["discretisation"] for row in rows]
        self.effects: List[str] = [row["effects"] for row in rows]
        self.unknowns: Integers = np.array([row["unknowns"] for row in rows], dtype=int)
        self.cpu_s: Floats = np.array([row["cpu_s"] for row in rows], dtype=float)
        self.wall_s: Floats = np.array([row["wall_s"] for row in rows], dtype=float)
        self.memory_B: Floats = np.array([row["memory_B"] for row in rows], dtype=float)
        self.error: Floats = np.array([row["error"] for row in rows], dtype=float)
        self.pareto: Booleans = np.array([row["pareto"] for row in rows], dtype=bool)
        self.recommendations = [(one["tolerance"], -1 if one["row"] is None else one["row"], one["text"])
                                for one in found["recommendations"]]
        self.reference: str = found["reference"]
        self.reference_error: float = found["reference_error"]
        self.rows_left_out: int = found["rows_left_out"]
        self.rows_without_answer = [(one["discretisation"], one["effects"], one["reason"])
                                    for one in found["rows_without_answer"]]

    def plot(self, ax: Any = None) -> Any:
        """Draw the error over the processor time. Needs matplotlib. Returns the axes."""
        from ._plot import plot_cost

        return plot_cost(self, ax)

    def _table(self) -> _show.Columns:
        names = ("discretisation", "effects", "unknowns", "cpu_s", "wall_s", "memory_B", "error", "pareto")
        return _show.Columns("cost", {name: getattr(self, name) for name in names}, [one[2] for one in self.recommendations])

    def _repr_html_(self) -> str:
        whole = self._table()
        best = {name: np.asarray(values)[self.pareto] for name, values in whole.columns.items() if name != "pareto"}
        return _show.html_of(whole._replace(title="cost: the best rows", columns=best))

    def __repr__(self) -> str:
        return f"<viscard.Cost: {len(self.error)} rows, {int(self.pareto.sum())} on the Pareto front>"
