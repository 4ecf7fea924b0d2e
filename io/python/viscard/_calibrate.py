"""Calibrations of the load cell and the frame, from readings."""

from __future__ import annotations

import os
from typing import Any, Dict, Optional

from . import _arrays, _check, _core, _show
from ._result import Result
from ._types import OptionalPath, Path, Quantity, TableLike


class Calibration(Result):
    """Gain of a load cell, or stiffness of a frame, with its uncertainty. ``calibration["gain_V_N"]`` gives every key of
    ``viscard calibrate --json``.

    Attributes
    ----------
    record : str
        The text that a rig file names: [calibration] file = "cell.toml", [frame] file = "frame.toml".
    rows_left_out : int
        Rows without a number in one of the columns that were used.
    json : dict

    Examples
    --------
    >>> readings = {"mass_kg": [0, 0.05, 0.1, 0.2, 0.1, 0.05, 0], "volts_V": [0.01, 0.36, 0.72, 1.43, 0.72, 0.36, 0.01]}
    >>> cell = viscard.calibrate(readings, capacity="250 gf")
    >>> low, high = cell["gain_interval_95"]
    >>> low < cell["gain_V_N"] < high
    True
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        super().__init__(found["result"])
        self.record: str = found["record"]
        self.rows_left_out: int = found["rows_left_out"]

    @_check.arguments
    def save(self, path: Path, overwrite: bool = False) -> None:
        """Write the record; an existing file is kept unless `overwrite` is True."""
        _core.write_file(os.fspath(path), self.record, overwrite)

    def _table(self) -> _show.Columns:
        n = self.rows_left_out
        notes = [f"{n} row{'' if n == 1 else 's'} without a number left out"] if n else []
        return _show.of_values("calibration", self.json, notes)

    def __repr__(self) -> str:
        if "stiffness_N_m" in self.json:
            return f"Calibration(frame of {self['stiffness_N_m']:.4g} N/m)"
        return f"Calibration(load cell of {self['gain_V_N']:.6g} V/N)"


@_check.arguments
def calibrate(data: TableLike, *, compliance: bool = False, rig: OptionalPath = None, capacity: Quantity = None,
              gravity: Quantity = None, mass_u: float = 1e-4, nonlinearity: Optional[float] = None, span: Quantity = None,
              id: str = "", valid_until: str = "", plausible: str = "on") -> Calibration:
    """Calibrate a load cell from readings under weights, or a frame from readings on a rigid block.

    Parameters
    ----------
    data : path or table
        mass_kg (or force_N) with volts_V in the order in which they were taken, up and down again; for a frame position_m
        with force_N. A row in which one of these is missing is left out.
    compliance : bool
        Of the frame.
    rig : path
        Rig file of the cell: its capacity, its converter, and the sign of compression.
    capacity : str or float
        Rated load of the cell in N, such as "250 gf"; needed without `rig`.
    gravity : str or float
        At this place, in m/s2. Default: that of any place on Earth, which the uncertainty contains.
    mass_u : float
        Relative standard uncertainty of the masses.
    nonlinearity : float
        Of the cell by its data sheet, as a share of the capacity.
    span : str or float
        Largest voltage of the converter.
    id, valid_until : str
        Name of the record, and its last day (default: a year from today).
    plausible : "on" or "off"

    Examples
    --------
    >>> readings = {"mass_kg": [0, 0.05, 0.1, 0.2, 0.1, 0.05, 0], "volts_V": [0.01, 0.36, 0.72, 1.43, 0.72, 0.36, 0.01]}
    >>> viscard.calibrate(readings, capacity="250 gf").save("cell.toml")
    >>> block = {"position_m": [0, 1e-5, 2e-5, 3e-5], "force_N": [0, 0.1, 0.2, 0.3]}
    >>> round(viscard.calibrate(block, compliance=True)["stiffness_N_m"])
    10000
    """
    if not _arrays.is_table(data):
        _arrays.path_of(data, "data", _arrays.OR_TABLE)
    given = _arrays.given(data, "data")
    keywords: Dict[str, Any] = {"rig": None if rig is None else os.fspath(rig), "capacity": capacity, "gravity": gravity,
                                "mass_u": float(mass_u), "nonlinearity": nonlinearity, "span": span, "id": id,
                                "valid_until": valid_until, "plausible": plausible}
    return Calibration(_core.calibrate(given.words[0], given.tables, compliance, keywords))
