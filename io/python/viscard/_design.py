"""A scene against what is required of it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Dict, List, Optional, Union, overload

from . import _arrays, _check, _core, _show
from ._arrays import path_of
from ._types import Numbers, OptionalPath, Progress, Quantity, Scene
from ._error import Error
from ._result import Result
from ._scene import _scene_toml, _with_scene


class Judgement(Result):
    """Requirements against the computed quantities of a scene. ``judgement["crosstalk"]`` is one line.

    Attributes
    ----------
    name : str
        Of the requirements.
    passes : bool
        Every requirement passes.
    lines : list of dict
        requirement, quantity, unit, is_upper, limit, value and error_estimate (None: not answered), margin (below 1 it
        fails), verdict ("pass", "fail", "undecided" or "not answered"), reason, and remedies: single dimensions that
        would pass, {"key", "from_m", "to_m", "value", "error_estimate"}, the smallest change first; search_is_complete
        is False where the time for them was not enough.

    Examples
    --------
    >>> judgement = viscard.design(viscard.data_file("scenes/pillar_modal.toml"), {"bandwidth": "1 kHz"})
    >>> judgement["bandwidth"]["verdict"]
    'pass'
    """

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        self.name: str = self.json["name"]
        self.passes: bool = self.json["passes"]
        self.lines: List[Dict[str, Any]] = self.json["lines"]

    def __getitem__(self, requirement: str) -> Dict[str, Any]:
        for line in self.lines:
            if line["requirement"] == requirement:
                return line
        raise KeyError(f"'{requirement}' is not required; there are {', '.join(one['requirement'] for one in self.lines)}")

    def summary(self) -> str:
        """The table that viscard design prints."""
        return str(self._core.text())

    def _table(self) -> _show.Columns:
        heads = ("requirement", "verdict", "value", "error_estimate", "limit", "unit", "margin", "reason")
        return _show.of_dicts(f"requirements: {self.name}", heads, self.lines)

    def __repr__(self) -> str:
        return "<viscard.Judgement " + ", ".join(f"{one['requirement']}: {one['verdict']}" for one in self.lines) + ">"


class Designs(Result):
    """Designs of a specification, the best in its first objective first.

    Attributes
    ----------
    feasible : bool
        Whether there is one; if not, `designs` holds the nearest.
    designs : list of dict
        feasible, values {key: text}, objectives [{quantity, value, error_estimate, unit}], active (limits that hold it or
        stop every design), lines (as in `Judgement`, with probability), scene (the text of its file).

    Examples
    --------
    >>> designs = viscard.design(viscard.data_file("designs/longest_pillar.toml"))
    >>> designs.feasible, designs.designs[0]["active"]
    (True, ['bandwidth'])
    """

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        self.feasible: bool = self.json["feasible"]
        self.designs: List[Dict[str, Any]] = self.json["designs"]

    def summary(self) -> str:
        """The text that viscard design prints."""
        return str(self._core.text())

    def _table(self) -> _show.Columns:
        """A design a row: its values as texts, objectives that are no values, and what holds it."""
        rows = [{"feasible": one["feasible"], **{of["quantity"]: of["value"] for of in one["objectives"]}, **one["values"],
                 "held by": ", ".join(one["active"])} for one in self.designs]
        units = {of["quantity"]: of["unit"] for one in self.designs for of in one["objectives"] if of["quantity"] not in one["values"]}
        return _show.of_dicts("designs", list(dict.fromkeys(key for row in rows for key in row)), rows)._replace(units=units)

    def __repr__(self) -> str:
        return f"<viscard.Designs: {len(self.designs)}, {'feasible' if self.feasible else 'not feasible'}>"


class DesignLimits(Result):
    """Closed-form limits of a pillar sensor. ``limits["buckling"]`` is one of them.

    Attributes
    ----------
    admissible : bool
        Every limit is met.
    limits : list of dict
        name, value, limit, unit, is_upper, met, margin (below 1 it is not met).
    longest_m : float
        The longest admissible pillar, 0 if there is none, and `limited_by`, the limit that determines it.
    json : dict
        The object of ``viscard design --json``, also sensitivity_V_Pa, relative_sensitivity, pitch_m, pull_off_force_N.

    Examples
    --------
    >>> limits = viscard.design(diameter="40 um", spacing="60 um", length="120 um")
    >>> limits.admissible, limits["matting"]["met"], limits.limited_by
    (True, True, 'buckling')
    """

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        self.admissible: bool = self.json["admissible"]
        self.limits: List[Dict[str, Any]] = self.json["limits"]
        self.longest_m: float = self.json["longest_m"]
        self.limited_by: str = self.json["limited_by"]

    def __getitem__(self, name: str) -> Dict[str, Any]:
        for one in self.limits:
            if one["name"] == name:
                return one
        raise KeyError(f"there is no limit '{name}'; there are {', '.join(one['name'] for one in self.limits)}")

    def summary(self) -> str:
        """The text that viscard design prints."""
        return str(self._core.text())

    def _table(self) -> _show.Columns:
        return _show.of_dicts("limits of a pillar sensor", ("name", "met", "value", "limit", "unit", "margin"), self.limits)

    def __repr__(self) -> str:
        failed = [one["name"] for one in self.limits if not one["met"]]
        return f"<viscard.DesignLimits: {'not met: ' + ', '.join(failed) if failed else 'admissible'}>"


_OF_LIMITS = ("diameter", "spacing", "length", "pressure", "modulus", "poisson", "surface_energy", "work_of_adhesion", "strength",
              "end_factor", "film_thickness", "charge_constant", "permittivity", "smallest_feature", "aspect_ratio", "pitch",
              "sensitivity", "lattice")


def _refuse_idle(belong_to: str, **keywords: Any) -> None:
    for name, value in keywords.items():
        if value is not None:
            raise Error(f"{name} belongs to {belong_to}", "usage")


def _limits(values: Dict[str, Quantity]) -> DesignLimits:
    return DesignLimits(_core.design_limits({name: value for name, value in values.items() if value is not None}))


def _points(values: Dict[str, Any]) -> Optional[List[Dict[str, Quantity]]]:
    """The values one by one, if some are arrays; of one length."""
    arrays = {name: value for name, value in values.items()
              if name != "lattice" and (isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) > 0)}
    if not arrays:
        return None
    columns = {name: list(value) if isinstance(value, (list, tuple)) and any(isinstance(one, str) for one in value)
               else _arrays.numbers(value, name).ravel().tolist() for name, value in arrays.items()}
    first, n = next((name, len(column)) for name, column in columns.items())
    for name, column in columns.items():
        if len(column) != n:
            raise Error(f"{name} has {len(column)} values and {first} has {n}; arrays belong together one by one", "usage")
    return [{**values, **{name: column[i] for name, column in columns.items()}} for i in range(n)]


@overload
def design(scene: None = ..., require: None = ..., **values: Quantity) -> DesignLimits: ...  # type: ignore[misc]
@overload
def design(scene: None = ..., require: None = ..., **values: Union[Quantity, Numbers]) -> List[DesignLimits]: ...
@overload
def design(scene: Scene, require: None = ..., *, progress: Progress = ...) -> Designs: ...
@overload
def design(scene: Scene, require: Scene, *, tol: Optional[float] = ..., search_time: Quantity = ...,
           folder: OptionalPath = ..., progress: Progress = ...) -> Judgement: ...
@_check.arguments  # type: ignore[misc]
def design(scene: Optional[Scene] = None, require: Optional[Scene] = None, *,
           tol: Optional[float] = None, search_time: Quantity = None,
           folder: OptionalPath = None, progress: Progress = None, **values: Any) -> Union[Judgement, Designs, DesignLimits, List[DesignLimits]]:
    """Judge a scene by requirements, each against a computed quantity with its error; design one; or state closed-form limits.

    Parameters
    ----------
    scene, tol, folder, progress
        As in `simulate`; without `require` the file of a specification, as in `data_file("designs")`, for `Designs`.
    search_time : str or float
        Processor time for the dimensions that would pass; a number counts seconds, 0 seeks none. Default: 60 s.
    require : path or dict
        A file with a table [require], or the contents of that table: `data_file("requirements/human_hand.toml")` is an example.

    **values
        Without `scene`, for `DesignLimits`: diameter, spacing, length, pressure, modulus, poisson, surface_energy,
        work_of_adhesion, strength, end_factor, film_thickness, charge_constant, permittivity, smallest_feature, aspect_ratio,
        pitch, sensitivity and lattice, as in ``viscard design --help``; texts with a unit or numbers in SI. Arrays of one
        length give a list, one `DesignLimits` for each place.

    Examples
    --------
    >>> viscard.design(viscard.data_file("scenes/array_voltages.toml"), {"crosstalk": "0.1 %"})["crosstalk"]["verdict"]
    'pass'
    >>> round(viscard.design(diameter=40e-6, spacing="60 um").longest_m * 1e6)
    149
    """
    unknown = [name for name in values if name not in _OF_LIMITS]
    if unknown:
        raise TypeError(f"design() has no keyword '{unknown[0]}'; there are {', '.join(_OF_LIMITS)}")
    if scene is None:
        points = _points(values)
        for point in [values] if points is None else points:
            for name, one in point.items():
                _check.value(name, one, Quantity)
        if require is not None:
            raise Error("--require judges a scene; name its file, such as SCENE.toml", "usage")
        _refuse_idle("a scene; give one, or omit it", tol=tol, folder=folder, search_time=search_time)
        return _limits(values) if points is None else [_limits(point) for point in points]
    if values:
        raise Error(f"{next(iter(values))} belongs to the closed-form limits; a scene has its own values", "usage")
    if require is None:
        _refuse_idle("a scene that is judged by require; omit it", tol=tol, folder=folder, search_time=search_time)
        return Designs(_core.design_of_spec(path_of(scene, "scene"), progress))
    tolerance = None if tol is None else float(tol)
    table = _scene_toml({"require": dict(require)}, "") if isinstance(require, Mapping) else None
    name = "require" if isinstance(require, Mapping) else os.fspath(require)
    return Judgement(_with_scene(scene, folder, lambda scene_text, path: _core.design(
        scene_text, path, table, name, tolerance, search_time, progress)))
