"""A scene at many values of its parameters."""

from __future__ import annotations

import os
import tempfile
import warnings
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _check, _core
from ._arrays import path_of
from ._check import OptionalPath, Path, Progress
from ._error import DoubtWarning, Error


class Sweep:
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
        self.results: Dict[str, Dict[str, Any]] = found["results"]
        self.point: np.ndarray = found["point"]
        self.failures: List[str] = found["failures"]
        self.n_points: int = found["n_points"]
        self.n_answered: int = found["n_answered"]
        self.n_merged: int = found["n_merged"]
        self.n_refused: int = found["n_refused"]
        self.n_failed: int = found["n_failed"]
        if self.n_failed > 0:
            warnings.warn(f"{self.n_failed} points failed and have no answer: {found['first_failure']}", DoubtWarning, stacklevel=4)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.results:
            raise KeyError(f"the answers have no '{name}'; they have {', '.join(self.results) or 'no results'}")
        return self.results[name]["value"]

    def __len__(self) -> int:
        return len(self.point)

    def __repr__(self) -> str:
        failed = sum(1 for one in self.failures if one)
        doubt = f", {failed} without an answer" if failed else ""
        return f"<viscard.Sweep over {', '.join(self.parameters)}: {len(self)} of {self.n_points} points{doubt}>"


@_check.arguments
def sweep(study: Path, out: OptionalPath = None, *, shard: Optional[str] = None, merge: Union[Path, Sequence[Path], None] = None,
          plausible: str = "on", accept_unrecorded: bool = False, retry_failed: bool = False,
          progress: Progress = None) -> Sweep:
    """Answer a scene at many values of its parameters, on all cores, as ``viscard sweep`` does.

    The GIL is released. Ctrl-C, or an exception of `progress`, ends it; the points that are being answered end in the background.

    Parameters
    ----------
    study : path
        A study file; `data_file("studies/pillar.toml")` is a commented example.
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
    """
    path = os.fspath(study)
    if merge is not None and not isinstance(merge, (str, os.PathLike, list, tuple)):
        raise TypeError(f"merge must be a path or a list of paths, not {_check.shown(merge)}")
    parts = [] if merge is None else list(merge) if isinstance(merge, (list, tuple)) else [merge]
    parts = [path_of(one, "merge") for one in parts]
    file = None if out is None else os.fspath(out)
    if file is None and parts:
        raise Error("merge needs out, the file that takes the points over", "usage")
    if file is not None:
        return Sweep(_core.sweep(path, file, shard, parts, plausible, accept_unrecorded, retry_failed, progress))
    with tempfile.TemporaryDirectory(prefix="viscard-", ignore_cleanup_errors=True) as own:
        return Sweep(_core.sweep(path, os.path.join(own, "points.sqlite"), shard, parts, plausible, accept_unrecorded,
                                 retry_failed, progress))
