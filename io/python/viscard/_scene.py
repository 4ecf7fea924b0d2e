"""Scenes: simulate, plan, cost."""

from __future__ import annotations

import os
import re
import tempfile
import warnings
from collections.abc import Mapping
from typing import Any, Callable, Dict, List, Optional, Tuple, TypeVar, Union

import numpy as np

from . import _arrays, _check, _core
from ._answer import Answer, Cost, Plan
from ._types import Floats, Numbers, OptionalPath, Progress, Quantity, Scene

_T = TypeVar("_T")
from ._error import DoubtWarning, Error
from ._material import Material


# Keys that name a table, in whose place arrays may stand; "file" is one in [shape].
_TABLES = ("voltages", "positions", "file")


def _new_file(folder: str, ending: str) -> str:
    return os.path.join(folder, f"{len(os.listdir(folder))}.{ending}")


def _history(table: Dict[str, Floats]) -> List[Tuple[float, float]]:
    """Pairs of time and value of a history, {"time_s": t, "pressure_Pa": p}; both in SI, as their names must state."""
    values = [name for name in table if name != "time_s"]
    if "time_s" not in table or len(values) != 1 or not re.search("_(Pa|N|m|V|m_s2)$", values[0]):
        raise Error("a history has the columns time_s and one more in SI, such as pressure_Pa, force_N, displacement_m or "
                    f"voltage_V; this has {', '.join(table)}", "input")
    return list(zip(table["time_s"].tolist(), table[values[0]].tolist()))


def _toml(value: Any, key: str, folder: str) -> str:
    """A value of a scene as TOML. A Material, and arrays in the place of a table, become files in `folder`."""
    if isinstance(value, Material):
        file = _new_file(folder, "json")
        value.save(file)
        return _toml({"file": file}, key, folder)
    if key == "history" and _arrays.is_table(value):
        return _toml(_history(_arrays.table(value, key)), key, folder)
    if key in _TABLES and _arrays.is_table(value):
        file = _new_file(folder, "csv")
        columns = _arrays.table(value, key)
        np.savetxt(file, np.column_stack(list(columns.values())), delimiter=",", header=",".join(columns), comments="",
                   fmt="%.17g")
        return _toml(file, key, folder)
    if isinstance(value, Mapping):
        inside = ", ".join(f"{_key(k)} = {_toml(v, str(k), folder)}" for k, v in value.items() if v is not None)
        return "{ " + inside + " }"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if _check.is_number(value) and not isinstance(value, np.ndarray):
        return repr(_arrays.number(value, key))
    if isinstance(value, (str, os.PathLike)):
        text = os.fspath(value).replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{text}"'
    if hasattr(value, "__array__") and np.asarray(value).dtype.kind != "U":  # of numpy or pandas
        return _toml(_arrays.numbers(value, key).tolist(), key, folder)
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_toml(v, key, folder) for v in value) + "]"
    raise TypeError(f"{key} is a {type(value).__name__}; a scene holds texts, numbers, lists, dicts and Materials")


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a key of the scene is {_check.shown(key)}; keys are texts")
    if re.fullmatch("[A-Za-z0-9_-]+", key):
        return key
    return '"' + key.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _scene_toml(scene: "Mapping[str, Any]", folder: str) -> str:
    plain = [f"{_key(k)} = {_toml(v, str(k), folder)}" for k, v in scene.items()
             if not isinstance(v, Mapping) and v is not None]
    tables = [f"[{_key(k)}]\n" + "\n".join(f"{_key(a)} = {_toml(b, a, folder)}" for a, b in v.items() if b is not None)
              for k, v in scene.items() if isinstance(v, Mapping)]
    return "\n".join(plain + tables) + "\n"


def _with_scene(scene: Scene, folder: OptionalPath, work: Callable[[Optional[str], str], _T]) -> _T:
    """Calls work(text, path) with text None for a file."""
    if not isinstance(scene, Mapping):
        if folder is not None:
            raise Error("folder belongs to a scene that is a dict; a file has one", "usage")
        return work(None, os.fspath(scene))
    with tempfile.TemporaryDirectory(prefix="viscard-") as own:
        name = os.path.join(os.fspath(folder) if folder is not None else "", "scene")
        try:
            return work(_scene_toml(scene, own), name)
        except Error as error:  # lines are those of our text, which nobody has seen
            text, message, where = (re.sub(re.escape(name) + r":\d+", "scene", part)
                                    for part in (str(error), error.message, error.where))
            raise Error(text, error.code, message, where, error.hint) from None


@_check.arguments
def simulate(scene: Scene, *, tol: Optional[float] = None, fields: bool = False, uncertainty: bool = False,
             samples: Optional[int] = None, compare: OptionalPath = None, folder: OptionalPath = None, plausible: str = "on",
             progress: Progress = None) -> Answer:
    """Answer a scene; the mesh is refined until the estimated error meets the tolerance.

    The GIL is released. Ctrl-C raises KeyboardInterrupt at once; the mesh that is being solved ends in the background.

    Parameters
    ----------
    scene : path or dict
        A scene file, or its contents: texts with units, numbers in SI, lists, arrays, dicts, and `Material` objects among
        the materials. A history may be an array of shape (rows, 2) or a table, ``{"time_s": t, "pressure_Pa": p}``;
        arrays by header may stand in the place of other tables, ``{"x [um]": x, "y [um]": y}`` of positions. Numbers
        that are missing or infinite are refused, because what acts on a pillar is chosen and not measured.
    tol : float
        Relative error allowed, instead of the scene's.
    fields : bool
        Add the solution on the section (it is solved once more).
    uncertainty : bool
        Add 95 % intervals of the results and the share of each input in their variance: quantities such as
        "40 um +- 1 um" and what material files state.
    samples : int
        With uncertainty: sample with about so many answers, also where the linear answer would do.
    compare : path
        A second scene file, by default that of the scene's own key compare: ``compared`` of the answer holds what both have.
    folder : path
        Of a dict: where files that it names are looked for; default: the working folder.
    plausible : "on" or "off"
        "off" accepts values that no scene can have; the notes say so. A scene may say it, too.
    progress : function of (fraction, point)

    Examples
    --------
    >>> pdms = viscard.Material(1.8e6, 0.33, rho_kg_m3=965)
    >>> answer = viscard.simulate({
    ...     "geometry": {"diameter": "40 um", "length": "120 um",
    ...                  "film": {"thickness": "25 um", "radius": "60 um", "material": "pvdf"},
    ...                  "electrode": {"face": "top", "kind": "equipotential", "radius": "20 um"}},
    ...     "materials": {"pillar": pdms, "pvdf": {"file": viscard.data_file("materials/pvdf_film_manual.json")}},
    ...     "analysis": {"kind": "static", "load": {"displacement": -1e-6, "on": "top"}}})
    >>> f"{answer['electrode_voltage'] * 1e3:.0f} mV"
    '29 mV'
    >>> pillar = {"geometry": {"diameter": "40 um", "length": "120 um"}, "analysis": {"kind": "modal", "modes": 1},
    ...           "materials": {"pillar": {"E": "1.8 MPa +- 2 %", "nu": 0.33, "rho": "965 kg/m3 +- 4 %"}}}
    >>> torsion = viscard.simulate(pillar, uncertainty=True).uncertainty["results"]["torsion 1"]
    >>> {name: round(share, 3) for name, share in torsion["shares"].items()}
    {'materials.pillar.E': 0.2, 'materials.pillar.rho': 0.8}
    """
    if samples is not None and not uncertainty:
        raise Error("samples belongs to uncertainty=True; give both", "usage")
    tolerance = None if tol is None else float(tol)
    answer = Answer(_with_scene(scene, folder, lambda text, path: _core.simulate(
        text, path, tolerance, fields, uncertainty, _arrays.whole(samples, "samples", 1),
        None if compare is None else os.fspath(compare), plausible, progress)))
    if answer.tolerance_doubt:
        name = "the scene" if isinstance(scene, Mapping) else os.fspath(scene)
        warnings.warn(f"{name}: {answer.tolerance_doubt}", DoubtWarning, stacklevel=3)
    return answer


@_check.arguments
def forces_from_voltages(scene: Scene, voltages: Numbers, *, noise: Optional[float] = None, tol: Optional[float] = None, folder: OptionalPath = None,
                         progress: Progress = None) -> Answer:
    """Forces in three directions on the pillars of an array, from the voltages of the quarters of their electrodes.

    The maps "sensed_normal_force", "sensed_shear_x_force" and "sensed_shear_y_force" (N) of all pillars are found together, so that
    no pillar takes its neighbour's shear for a pressure; their errors are those of the computation. "unexplained_voltage" shows
    quarters that do not work.

    Parameters
    ----------
    scene : dict
        An array in the plane with electrodes in quarters, as in `simulate`; its load and shape are left out.
    voltages : array, shape (rows, columns, 4), V
        Of the quarters (+,+), (-,+), (-,-), (+,-) of each pillar, row 1 at the lowest y; NaN where none stands.
    noise : float
        V rms of each quarter, for the results "resolution_normal_force", "resolution_shear_x_force", ... (N).
    tol, folder, progress
        As in `simulate`.

    Examples
    --------
    >>> import numpy as np
    >>> array = {"geometry": {"kind": "array", "model": "space", "rows": 3, "columns": 3, "spacing": "60 um",
    ...                       "diameter": "40 um", "length": "120 um",
    ...                       "film": {"thickness": "25 um", "edge": "150 um", "material": "pvdf"},
    ...                       "electrode": {"face": "bottom", "kind": "sampled", "quadrants": True}},
    ...          "materials": {"pillar": {"E": "1.8 MPa", "nu": 0.33, "rho": "965 kg/m3"},
    ...                        "pvdf": {"file": viscard.data_file("materials/pvdf_seed.json")}},
    ...          "analysis": {"kind": "static"}}
    >>> voltages = np.zeros((3, 3, 4))
    >>> voltages[1, 1] = [-9.71e-3, 5.86e-3, 5.86e-3, -9.71e-3]
    >>> found = viscard.forces_from_voltages(array, voltages)
    >>> f"{found.maps['sensed_shear_x_force']['value'][1, 1] * 1e6:.2f} uN"
    '1.26 uN'
    """
    if not isinstance(scene, Mapping):
        raise Error("forces_from_voltages needs the scene as a dict; a file names its voltages itself ([quadrants])", "usage")
    values = _arrays.numbers(voltages, "voltages")
    if values.ndim != 3 or values.shape[2] != 4:
        raise Error(f"voltages have the shape {values.shape}; it must be (rows, columns, 4)", "input")
    for row, column in np.argwhere(~np.isfinite(values).all(axis=2)):
        if not np.isnan(values[row, column]).all():
            raise Error(f"voltages[{row}, {column}] is {values[row, column].tolist()}; it must hold four numbers, or four NaN where "
                        "no pillar stands", "input")
    for key in ("analysis", "quadrants"):
        if not isinstance(scene.get(key, {}), Mapping):
            raise TypeError(f"{key} must be a dict, not {_check.shown(scene[key])}")
    parts: Mapping[str, Any] = scene
    analysis = {key: value for key, value in dict(parts.get("analysis", {})).items() if key != "load"}
    with tempfile.TemporaryDirectory(prefix="viscard-") as own:
        table = os.path.join(own, "voltages.csv")
        with open(table, "w", encoding="utf-8") as file:
            file.write("row,column," + ",".join(f"quadrant_{q}_voltage_V" for q in range(1, 5)) + "\n")
            for row, column in np.ndindex(values.shape[:2]):
                if np.isfinite(values[row, column]).all():
                    file.write(f"{row + 1},{column + 1}," + ",".join(repr(float(v)) for v in values[row, column]) + "\n")
        quadrants: Dict[str, Any] = {**parts.get("quadrants", {}), "voltages": table}
        if noise is not None:
            quadrants["noise"] = float(noise)
        whole = {key: value for key, value in scene.items() if key not in ("shape", "want")}
        whole.update(analysis=analysis, quadrants=quadrants)
        try:
            return simulate(whole, tol=tol, folder=folder, progress=progress)
        except Error as error:  # of a file that nobody has seen
            text, message, where = (part.replace(table, "voltages") for part in (str(error), error.message, error.where))
            raise Error(text, error.code, message, where, error.hint) from None


@_check.arguments
def check_scene(scene: Scene, *, svg: OptionalPath = None, folder: OptionalPath = None, plausible: str = "on",
                overwrite: bool = False) -> str:
    """Check a scene without solving it, as ``viscard scene check`` does. Returns what it is of:
    "pillar", "row", "array" or "layer".

    Parameters
    ----------
    scene, folder, plausible
        As in `simulate`.
    svg : path
        Where to draw the geometry, a name that ends with .svg; an existing file is kept unless `overwrite` is True.

    Raises
    ------
    Error
        With the line of the file, for what is missing or contradicts itself.

    Examples
    --------
    >>> viscard.check_scene(viscard.data_file("scenes/pillar_sensor.toml"), svg="sensor.svg")
    'pillar'
    """
    if svg is not None and not os.fspath(svg).lower().endswith(".svg"):
        raise Error(f"svg is {_check.shown(os.fspath(svg))}; the drawing is an SVG file, so end its name with .svg", "usage")
    name = "scene" if isinstance(scene, Mapping) else os.path.basename(os.fspath(scene))
    found = _with_scene(scene, folder, lambda text, path: _core.check_scene(text, path, name, plausible))
    if svg is not None:
        _core.write_file(os.fspath(svg), found["svg"], overwrite)
    return str(found["kind"])


@_check.arguments
def plan(scene: Scene, *, tol: Optional[float] = None, folder: OptionalPath = None, plausible: str = "on") -> Plan:
    """Which effects a scene needs at its tolerance, the error of leaving each out, and what that saves.

    Parameters
    ----------
    scene, tol, folder, plausible
        As in `simulate`.

    Examples
    --------
    >>> viscard.plan(viscard.data_file("scenes/pillar_press.toml")).tolerance
    0.001
    """
    tolerance = None if tol is None else float(tol)
    return Plan(_with_scene(scene, folder, lambda text, path: _core.plan(text, path, tolerance, plausible)))


@_check.arguments
def cost(scene: Scene, *, budget: Union[str, float] = 60.0, cpu_budget: Quantity = None, folder: OptionalPath = None,
         plausible: str = "on", progress: Progress = None) -> Cost:
    """What accuracy costs: error against processor time, memory and unknowns.

    Parameters
    ----------
    scene, folder, plausible, progress
        As in `simulate`.
    budget : str or float
        Wall time to spend, such as "20 s" or 20.
    cpu_budget : str or float
        Processor time to spend at most, such as "30 s" or 30.

    Examples
    --------
    >>> bool(viscard.cost(viscard.data_file("scenes/pillar_press.toml"), budget=0.2).pareto.any())
    True
    """
    return Cost(_with_scene(scene, folder, lambda text, path: _core.cost(text, path, budget, cpu_budget, plausible, progress)))
