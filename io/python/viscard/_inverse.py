"""From the voltages of an array of pillars back to the loads on their tops."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Dict, List, Optional

import numpy as np

from . import _arrays, _check, _core, _show
from ._check import shown
from ._error import Error
from ._plot import plot_pressures
from ._result import Tabular
from ._scene import _with_scene
from ._types import Booleans, Floats, Numbers, OptionalPath, Scene


def _bare(scene: Any) -> Any:
    """The array of a scene alone: its loads and what it asks for do not matter here."""
    if not isinstance(scene, Mapping):
        return scene
    kept = {key: value for key, value in scene.items() if key not in ("shape", "want", "quadrants", "heat", "noise", "readout")}
    return {**kept, "analysis": {"kind": "static", "load": {"pressure": "1 Pa", "on": "top"}}}


def _frames(voltages: Any) -> Floats:
    values = _arrays.numbers(voltages, "voltages")
    if np.isinf(values).any():
        raise Error("voltages hold infinite values; write NaN where an electrode is dead", "input")
    return np.ascontiguousarray(values)


class Pressures(Tabular):
    """Loads of the pillars of an array, each with its 95 % interval.

    Arrays have the shape (frames, rows, columns), or (rows, columns) if one frame was given; NaN where no pillar stands.

    Attributes
    ----------
    pressure_Pa, pressure_half_width_Pa : array
        The load lies within pressure_Pa -+ pressure_half_width_Pa in 95 of 100 cases.
    shear_x_Pa, shear_x_half_width_Pa, shear_y_Pa, shear_y_half_width_Pa : array or None
        Of electrodes in quarters.
    is_resolved : array of bool, shape (rows, columns)
        False where the pressure of a pillar is not seen by itself: without a working electrode, or blurred with its neighbours.
    resolution_m : array, shape (rows, columns)
        How far away another load counts half as much in the estimate; half a pitch for separate electrodes.
    own_share : array, shape (rows, columns)
        Part of the estimate that is the pillar's own pressure.
    condition : float
        Largest over smallest singular value of the voltages per pressure.
    regularisation : dict
        "penalty" ("size": loads are held small, or "slope": differences), "rule" ("discrepancy", "cross-validation" or "stated"),
        "weight", "is_at_limit", "noise_V" and "prior_Pa", the size of loads (or differences) that the weight stands for.
    notes : list of str

    Examples
    --------
    >>> scene = viscard.data_file("scenes/space_sphere.toml")
    >>> made = viscard.simulate(scene)
    >>> found = viscard.pressures_from_voltages(scene, made.maps["mean_voltage"]["value"], noise=1e-4)
    >>> found.regularisation["rule"]
    'discrepancy'
    """

    def __init__(self, loads: Floats, half_widths: Floats, facts: Dict[str, Any], is_single: bool) -> None:
        def one(values: Floats, load: int) -> Floats:
            return values[0, ..., load] if is_single else values[..., load]

        def of(values: Floats, load: int) -> Optional[Floats]:
            return one(values, load) if load < values.shape[-1] else None

        self.pressure_Pa, self.pressure_half_width_Pa = one(loads, 0), one(half_widths, 0)
        self.shear_x_Pa, self.shear_x_half_width_Pa = of(loads, 1), of(half_widths, 1)
        self.shear_y_Pa, self.shear_y_half_width_Pa = of(loads, 2), of(half_widths, 2)
        self.is_resolved: Booleans = facts["is_resolved"][..., 0]
        self.resolution_m: Floats = facts["resolution_m"][..., 0]
        self.own_share: Floats = facts["own_share"][..., 0]
        self.condition: float = facts["condition"]
        self.regularisation: Dict[str, Any] = dict(facts["regularisation"])
        self.notes: List[str] = _notes(facts)

    @property
    def is_below_noise(self) -> Booleans:
        """Whether the interval of a pressure holds 0."""
        below: Booleans = np.abs(self.pressure_Pa) <= self.pressure_half_width_Pa
        return below

    @_check.arguments
    def plot(self, frame: int = 0, ax: Any = None) -> Any:
        """The pressures of a frame as a map, crossed out where none is resolved; returns the axes of matplotlib."""
        last = 0 if self.pressure_Pa.ndim == 2 else len(self.pressure_Pa) - 1
        whole = _arrays.whole(frame, "frame", 0, last)
        values = self.pressure_Pa if self.pressure_Pa.ndim == 2 else self.pressure_Pa[whole]
        return plot_pressures(values, self.is_resolved, ax)

    def _table(self) -> _show.Columns:
        """A row for each pillar of each frame, at its place in the arrays, from 0."""
        shape = (-1, *self.is_resolved.shape)
        frame, row, column = np.nonzero(np.isfinite(self.pressure_Pa.reshape(shape)))
        columns: Dict[str, Any] = {"frame": frame, "row": row, "column": column}
        for name in ("pressure_Pa", "pressure_half_width_Pa", "shear_x_Pa", "shear_x_half_width_Pa", "shear_y_Pa",
                     "shear_y_half_width_Pa"):
            values = getattr(self, name)
            if values is not None:
                columns[name] = values.reshape(shape)[frame, row, column]
        return _show.Columns("pressures", {**columns, "is_resolved": self.is_resolved[row, column]}, self.notes)

    def __repr__(self) -> str:
        return f"Pressures{self.pressure_Pa.shape}"


def _notes(facts: Dict[str, Any]) -> List[str]:
    found, notes = facts["regularisation"], []
    blind = int((~facts["is_resolved"][..., 0] & np.isfinite(facts["own_share"][..., 0])).sum())
    if blind:
        notes.append(f"{blind} pressures are not resolved: no working electrode, or blurred with those around")
    if found["is_at_limit"] and found["rule"] == "discrepancy" and found["weight"] >= 1.0:
        notes.append("the voltages are no larger than the noise that was stated")
    elif found["is_at_limit"] and found["rule"] == "discrepancy" and found["weight"] < 1e-10:
        notes.append("the voltages contradict the loads by more than the noise that was stated; it is larger, or electrodes are "
                     "wrong")
    elif found["is_at_limit"]:
        notes.append("the loads are smoother than the regularisation may ask for; intervals are wider than they could be")
    return notes


class PressureReader:
    """Turns frames of voltages of one array into pressures; prepared once, then at most 1 ms for 100 x 100 pillars.

    The estimate minimises what it leaves of the voltages plus a weight times the loads (or their differences) squared. The weight
    follows from the data: with the noise stated, from what noise leaves of the whole functional (discrepancy); else from generalised
    cross-validation, which needs loads that are smoother than noise. Equations and sources: models/array/inverse/README.md.

    Parameters
    ----------
    scene : path or dict
        An array in the plane on a rigid base, as in `simulate`; its loads, shape and results are left out.
    voltages : array, shape ([frames,] rows, columns), V; of quarters ([frames,] rows, columns, 4)
        Examples that the weight is chosen with: of sampled electrodes the mean over the electrode, row 1 at the lowest y. NaN where
        none stands, and of electrodes that are dead: one that is NaN in any frame is left out.
    noise : float
        V rms of each reading.
    gain_spread : float
        Standard deviation of the gains of the electrodes over their value, such as 0.02.
    shear : float
        Pa rms of shears that one electrode per pillar cannot tell from its neighbours' pressure.
    penalty : "size" or "slope"
        What is held small: "size" where the noise is stated, "slope" where not.
    weight : float
        Instead of the one that the data choose.
    reading : "mean" or "centre"
        Of sampled electrodes.
    folder
        As in `simulate`.

    Examples
    --------
    >>> scene = viscard.data_file("scenes/space_sphere.toml")
    >>> made = viscard.simulate(scene).maps["mean_voltage"]["value"]
    >>> reader = viscard.PressureReader(scene, made, noise=1e-4, gain_spread=0.01)
    >>> reader.read([made, 0.5 * made]).pressure_Pa.shape
    (2, 40, 40)
    """

    @_check.arguments
    def __init__(self, scene: Scene, voltages: Numbers, *, noise: Optional[float] = None, gain_spread: float = 0.0, shear: float = 0.0,
                 penalty: Optional[str] = None, weight: Optional[float] = None, reading: str = "mean",
                 folder: OptionalPath = None) -> None:
        if penalty not in (None, "size", "slope"):
            raise Error(f"penalty is {shown(penalty)}; it must be \"size\" or \"slope\"", "usage")
        if reading not in ("mean", "centre"):
            raise Error(f"reading is {shown(reading)}; it must be \"mean\" or \"centre\"", "usage")
        frames = _frames(voltages)
        numbers = [None if one is None else float(one) for one in (noise, weight)]
        self._reader = _with_scene(_bare(scene), folder, lambda text, path: _core.VoltageReader(
            text, path, frames, numbers[0], float(gain_spread), float(shear), penalty or "", numbers[1], reading == "centre"))
        self._facts = self._reader.facts()
        self.regularisation: Dict[str, Any] = dict(self._facts["regularisation"])
        self.notes: List[str] = _notes(self._facts)

    @_check.arguments
    def read(self, voltages: Numbers) -> Pressures:
        """Pressures of one frame or of several, shaped as the examples.

        Examples
        --------
        >>> scene = viscard.data_file("scenes/space_sphere.toml")
        >>> made = viscard.simulate(scene).maps["mean_voltage"]["value"]
        >>> bool(viscard.PressureReader(scene, made, noise=1e-4).read(2.0 * made).is_resolved.any())
        True
        """
        frames = _frames(voltages)
        loads, half_widths = self._reader.read(frames)
        works = self._facts["works"]
        missing = np.isnan(frames.reshape(-1, *works.shape)).any(axis=0) & works
        if missing.any():
            raise Error(f"voltages hold NaN at {np.argwhere(missing)[0].tolist()}, which works in the examples that the reader was "
                        "made with; make one with these frames", "input")
        return Pressures(loads, half_widths, self._facts, frames.size == works.size and frames.shape[0] == works.shape[0])

    def __repr__(self) -> str:
        return f"PressureReader{self._facts['works'].shape[:2]}"


@_check.arguments
def pressures_from_voltages(scene: Scene, voltages: Numbers, *, noise: Optional[float] = None, gain_spread: float = 0.0, shear: float = 0.0,
                            penalty: Optional[str] = None, weight: Optional[float] = None, reading: str = "mean",
                            folder: OptionalPath = None) -> Pressures:
    """Pressures on the pillars of an array from frames of the voltages of any electrodes, with 95 % intervals.

    Intervals hold the noise, the spread of gains, unknown shears, the error of the computed voltages per pressure, and what the
    regularisation takes away. For many recordings of one array, `PressureReader` is prepared once.

    Parameters
    ----------
    scene, voltages, noise, gain_spread, shear, penalty, weight, reading, folder
        As in `PressureReader`.

    Examples
    --------
    >>> array = {"geometry": {"kind": "array", "model": "space", "rows": 3, "columns": 3, "spacing": "60 um",
    ...                       "diameter": "40 um", "length": "120 um",
    ...                       "film": {"thickness": "25 um", "edge": "150 um", "material": "pvdf"},
    ...                       "electrode": {"face": "bottom", "kind": "sampled"}},
    ...          "materials": {"pillar": {"E": "1.8 MPa", "nu": 0.33, "rho": "965 kg/m3"},
    ...                        "pvdf": {"file": viscard.data_file("materials/pvdf_seed.json")}}}
    >>> voltages = [[0.0, 0.0, 0.0], [0.0, -0.0193, 0.0], [0.0, 0.0, float("nan")]]
    >>> found = viscard.pressures_from_voltages(array, voltages, noise=2e-4)
    >>> f"{found.pressure_Pa[1, 1] / 1e3:.1f} kPa +- {found.pressure_half_width_Pa[1, 1] / 1e3:.1f}"
    '10.0 kPa +- 0.2'
    >>> bool(found.is_resolved[2, 2])
    False
    """
    reader = PressureReader(scene, voltages, noise=noise, gain_spread=gain_spread, shear=shear, penalty=penalty, weight=weight,
                            reading=reading, folder=folder)
    return reader.read(voltages)
