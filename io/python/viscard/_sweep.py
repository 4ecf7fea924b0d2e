"""A scene at many values of its parameters."""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
import tomllib
import warnings
from collections.abc import Mapping
from typing import Any, Collection, Dict, Iterator, List, Optional, Sequence, TypedDict, Union

import numpy as np

from . import _arrays, _check, _core, _show
from ._arrays import path_of
from ._types import Floats, HasValues, Integers, OptionalPath, Path, Progress, Scene
from ._error import DoubtWarning, Error
from ._result import Tabular
from ._scene import _scene_toml, _toml


class Results(TypedDict):
    """A result at all points of a sweep."""

    unit: str
    value: Floats
    error: Floats


class Sweep(Tabular):
    """The answers of a study. ``sweep["electrode_voltage"]`` is a result at all points, SI; NaN where there is none.

    Attributes
    ----------
    parameters : dict of list of str
        By key of the scene ("geometry.diameter"): its value at each point, as a scene states it ("36 um").
    results : dict of {"unit", "value", "error"}
        Arrays of shape (points,): results and, by name, frequencies of modes, with their error estimates.
    point : int array, shape (points,)
        Numbers of the points that are done; in a grid the first parameter varies slowest.
    failures : list of str
        Why a point has no answer; empty: it has one.
    n_points, n_answered, n_merged : int
        Of the study; of these answered, or taken over, by this call.
    n_refused, n_failed : int
        Of this call: points outside the model, and points that failed for memory, disk or an error of the program. Those that
        failed for memory or disk are not kept; the same call answers them again.

    Examples
    --------
    >>> sweep = viscard.sweep(viscard.data_file("studies/pillar.toml"), shard="1/3")
    >>> list(sweep.parameters), sweep["electrode_voltage"].shape, sweep.n_points
    (['geometry.diameter', 'geometry.length'], (3,), 9)
    >>> sweep.results["electrode_voltage"]["unit"]
    'V'
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.parameters: Dict[str, List[str]] = found["parameters"]
        self.results: Dict[str, Results] = found["results"]
        self.point: Integers = found["point"]
        self.failures: List[str] = found["failures"]
        self.n_points: int = found["n_points"]
        self.n_answered: int = found["n_answered"]
        self.n_merged: int = found["n_merged"]
        self.n_refused: int = found["n_refused"]
        self.n_failed: int = found["n_failed"]
        if self.n_failed > 0:
            warnings.warn(f"{self.n_failed} points failed and have no answer: {found['first_failure']}", DoubtWarning, stacklevel=4)

    def __getitem__(self, name: str) -> Floats:
        if name not in self.results:
            raise KeyError(f"the answers have no '{name}'; they have {', '.join(self.results) or 'no results'}")
        return self.results[name]["value"]

    def _table(self) -> _show.Columns:
        """A row for each point: parameters as texts, results, and their errors as NAME_error."""
        values = {name: one["value"] for name, one in self.results.items()}
        errors = {f"{name}_error": one["error"] for name, one in self.results.items()}
        units = {name: one["unit"] for name, one in self.results.items()}
        return _show.Columns(f"sweep: {len(self)} of {self.n_points} points", {**self.parameters, **values, **errors},
                             sorted({one for one in self.failures if one}), units)

    @_check.arguments
    def plot(self, name: Optional[str] = None, ax: Any = None) -> Any:
        """Draw a result over the parameter that has most values, with a line for each value of the others. Needs
        matplotlib. Returns the axes.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> sweep = viscard.sweep(viscard.data_file("scenes/pillar_press.toml"),
        ...                       over={"geometry.diameter": ["36 um", "40 um"]})
        >>> sweep.plot("top_force").get_xlabel()
        'geometry.diameter (um)'
        """
        from ._plot import plot_sweep

        if not self.results:
            raise Error("no point of the sweep has an answer; failures states why", "input")
        return plot_sweep(self, next(iter(self.results)) if name is None else name, ax)

    def __len__(self) -> int:
        return len(self.point)

    def __repr__(self) -> str:
        failed = sum(1 for one in self.failures if one)
        doubt = f", {failed} without an answer" if failed else ""
        return f"<viscard.Sweep over {', '.join(self.parameters)}: {len(self)} of {self.n_points} points{doubt}>"


def _study_toml(over: HasValues, scene_file: str) -> str:
    """The study file of these values of keys of a scene."""
    is_rows = not isinstance(over, dict)
    lines = [f"scene = {_toml(scene_file, 'scene', '')}", f"rows = {'true' if is_rows else 'false'}"]
    for key in over.keys():
        values = over[key]
        if isinstance(values, (list, tuple)) and any(isinstance(one, str) for one in values):
            texts = [one if isinstance(one, str) else repr(_arrays.number(one, key)) for one in values]
        else:
            texts = [repr(_arrays.number(one, key)) for one in _arrays.numbers(values, key).ravel()]
        if not texts:
            raise Error(f"over has no values of {key}", "usage")
        lines += ["[[parameter]]", f"key = {_toml(key, key, '')}", f"values = {_toml(texts, key, '')}"]
    return "\n".join(lines) + "\n"


def _keys_of(scene: Scene) -> Collection[str]:
    """Of a scene or a study; none of a file that is no TOML, which its reader refuses."""
    if isinstance(scene, Mapping):
        return scene
    try:
        with open(scene, "rb") as file:
            return tomllib.load(file)
    except (OSError, ValueError):
        return ()


@contextlib.contextmanager
def _study_file(study: Scene, over: Optional[HasValues]) -> Iterator[str]:
    """The path of a study: the one given, or one that is made of a scene and the values of its keys."""
    if over is None:
        if isinstance(study, Mapping):
            raise Error("a scene that is a dict needs over, such as over={'geometry.diameter': [36e-6, 40e-6]}", "usage")
        yield os.fspath(study)
        return
    if not hasattr(over, "keys"):
        raise TypeError(f"over must be a dict of values by key of the scene, or a DataFrame, not {_check.shown(over)}")
    if "parameter" in _keys_of(study):
        raise Error(f"over is for a scene, and {_check.shown(study)} is a study, which states its own values; omit over, or give "
                    "the scene of the study", "usage")
    with tempfile.TemporaryDirectory(prefix="viscard-") as own:
        scene_file = os.path.abspath(study) if not isinstance(study, Mapping) else "scene.toml"
        if isinstance(study, Mapping):
            text = _scene_toml(study, own).replace(own + os.sep, "")  # the same text in every folder
            with open(os.path.join(own, scene_file), "w", encoding="utf-8") as file:
                file.write(text)
        name = os.path.join(own, "study.toml")
        with open(name, "w", encoding="utf-8") as file:
            file.write(_study_toml(over, scene_file))
        try:
            yield name
        except Error as error:  # of files that nobody has seen
            text, message, where = (re.sub(re.escape(own) + r"/(study|scene)\.toml(:\d+)?", r"\1", part)
                                    for part in (str(error), error.message, error.where))
            raise Error(text, error.code, message, where, error.hint) from None


@_check.arguments
def sweep(study: Scene, out: OptionalPath = None, *, over: Optional[HasValues] = None, shard: Optional[str] = None, merge: Union[Path, Sequence[Path], None] = None,
          plausible: str = "on", accept_unrecorded: bool = False, retry_failed: bool = False,
          progress: Progress = None) -> Sweep:
    """Answer a scene at many values of its parameters, on all cores, as ``viscard sweep`` does.

    The GIL is released. Ctrl-C, or an exception of `progress`, ends it; the points that are being answered end in the background.

    Parameters
    ----------
    study : path or dict
        A study file; `data_file("studies/pillar.toml")` is a commented example. With `over`, the scene: a path or a dict
        as in `simulate`, whose files are named by whole paths.
    over : dict of lists or arrays, or DataFrame
        Values by key of the scene: numbers in SI, or texts with a unit. A dict combines all of them, the first key
        slowest; a DataFrame is a table of points, one a row. Missing values are refused.
    out : path
        SQLite file that keeps each point as it ends, so that the same call continues a sweep that was interrupted. ``viscard
        sweep`` continues it too. Default: nothing is kept.
    shard : str
        Answer one part of the points only, such as "3/64".
    merge : path or list of paths
        Take over the points of other parts; nothing is answered then.
    plausible : "on" or "off"
        "off" accepts values that no scene can have. All values are checked before the first point is answered.
    accept_unrecorded : bool
        Go on with a file of an earlier version, which does not state the materials that its points were answered with.
    retry_failed : bool
        Answer points again that failed by an error of the program.
    progress : function of (fraction, step)

    Examples
    --------
    >>> first = viscard.sweep(viscard.data_file("studies/pillar.toml"), "pillar.sqlite", shard="1/3")
    >>> rest = viscard.sweep(viscard.data_file("studies/pillar.toml"), "pillar.sqlite")
    >>> first.n_answered, rest.n_answered, len(rest)
    (3, 6, 9)
    >>> import numpy as np
    >>> scene = viscard.data_file("scenes/pillar_press.toml")
    >>> viscard.sweep(scene, over={"geometry.diameter": np.array([36e-6, 44e-6])})["top_force"].shape
    (2,)
    """
    if merge is not None and not isinstance(merge, (str, os.PathLike, list, tuple)):
        raise TypeError(f"merge must be a path or a list of paths, not {_check.shown(merge)}")
    parts = [] if merge is None else list(merge) if isinstance(merge, (list, tuple)) else [merge]
    parts = [path_of(one, "merge") for one in parts]
    file = None if out is None else os.fspath(out)
    if file is None and parts:
        raise Error("merge needs out, the file that takes the points over", "usage")
    with _study_file(study, over) as path, tempfile.TemporaryDirectory(prefix="viscard-", ignore_cleanup_errors=True) as own:
        return Sweep(_core.sweep(path, file or os.path.join(own, "points.sqlite"), shard, parts, plausible, accept_unrecorded,
                                 retry_failed, progress))
