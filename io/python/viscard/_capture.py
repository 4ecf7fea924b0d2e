"""Captures on a rig, or on an emulated one."""

from __future__ import annotations

import os
from typing import Any, Callable, Dict, Optional

from . import _check, _core, _show
from ._arrays import whole
from ._types import OptionalPath, Path, Progress
from ._error import Error
from ._result import Result
from ._table import Capture, read_capture


class CaptureOutcome(Result):
    """How a run ended. ``outcome["key"]`` gives every key of ``viscard capture --json``.

    Attributes
    ----------
    file, status : str
        status: "finished", "interrupted" or "stopped".
    json : dict

    Examples
    --------
    >>> outcome = viscard.capture("run.viscap", emulate=True, speed=500)
    >>> outcome.status
    'finished'
    """

    def __init__(self, core: _core.Result, file: str) -> None:
        super().__init__(core)
        self.file = file
        self.status: str = self.json["status"]

    def read(self) -> Capture:
        """The capture as arrays."""
        return read_capture(self.file)

    def _table(self) -> _show.Columns:
        return _show.of_values(f"capture {self.file}: {self.status}", self.json, self.json["doubts"])

    def __repr__(self) -> str:
        return f"<viscard.CaptureOutcome {self.file}: {self.status}>"


@_check.arguments
def capture(out: Path, *, rig: OptionalPath = None, test: OptionalPath = None, specimen: OptionalPath = None,
            emulate: bool = False, truth: OptionalPath = None, seed: Optional[int] = None, speed: float = 1.0, overwrite: bool = False,
            uncalibrated: bool = False, plausible: str = "on", lift: bool = False,
            sample: Optional[Callable[[float, float, float], object]] = None,
            progress: Progress = None) -> CaptureOutcome:
    """Run one indentation test on a rig and record every byte of it.

    Ctrl-C, an exception of a callback, or a `sample` that returns False brakes the stage, lifts the punch and keeps
    the record, whose status is then "interrupted"; a second Ctrl-C stops the stage at once.

    Parameters
    ----------
    out : path
        The capture file to write (\\*.viscap).
    rig, test, specimen : path
        TOML files; an emulated rig needs none of them.
    emulate : bool
        Use an emulated rig, with `truth` (file), `seed` and `speed` (up to 500; changes no result).
    plausible : "on" or "off"
        "off" accepts values in these files that no bench can have; the record says so.
    sample : function of (time_s, force_N, depth_m)
        Called for every reading of the load cell, in this thread.
    progress : function of (fraction, phase)

    Raises
    ------
    Error
        If the test could not begin, or did not finish; the record is kept.

    Examples
    --------
    >>> readings = []
    >>> outcome = viscard.capture("run.viscap", emulate=True, speed=500, sample=lambda *one: readings.append(one))
    >>> time_s, force_N, depth_m = readings[-1]
    """
    words: Dict[str, Any] = {name: None if path is None else os.fspath(path)
             for name, path in (("rig", rig), ("test", test), ("specimen", specimen), ("truth", truth))}
    words.update(emulate=emulate, seed=whole(seed, "seed", 0, 2**64 - 1), speed=float(speed), overwrite=overwrite,
                 uncalibrated=uncalibrated, lift=lift, plausible=plausible, command="viscard.capture()")
    file = os.fspath(out)
    was_enough = []

    def watched(time_s: float, force_N: float, depth_m: float) -> object:
        answer = sample and sample(time_s, force_N, depth_m)
        if answer is False:
            was_enough.append(True)
        return answer

    outcome = CaptureOutcome(_core.capture(file, words, watched if sample else None, progress), file)
    found = outcome.json
    if found["status"] != "finished" and not was_enough:
        error = found.get("error") or {}
        raise Error(found.get("reason") or "the run did not finish", error.get("code", "failed"),
                    error.get("message"), error.get("where", ""), error.get("hint", ""))
    return outcome
