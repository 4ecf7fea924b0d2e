"""Tables and captures as arrays."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterator, List, Literal, Mapping, Optional, Tuple, TypedDict, Union, overload

import numpy as np

from . import _check, _core, _show
from ._result import Tabular
from ._types import Booleans, Floats, Integers, Path, Texts


class TableColumn(TypedDict):
    """A column as its file writes it."""

    header: str
    name: str
    unit: str
    values: Floats
    text: Optional[List[str]]


class Load(TypedDict):
    """Readings of the load cell."""

    index: Integers
    time_s: Floats
    device_time_s: Floats
    counts: Floats
    volts_V: Floats
    force_N: Floats
    is_saturated: Booleans
    is_glitch: Booleans


class StageRecord(TypedDict):
    """Positions that the stage reported."""

    time_s: Floats
    position_m: Floats
    state: List[str]


class Moves(TypedDict):
    """Moves that were commanded."""

    time_s: Floats
    from_m: Floats
    to_m: Floats
    speed_m_s: Floats
    acceleration_m_s2: Floats
    purpose: List[str]


class Temperatures(TypedDict):
    """Readings of the thermometer."""

    time_s: Floats
    temperature_C: Floats


class Table(Tabular, Mapping[str, Union[Floats, List[str]]]):
    """A table of a file. ``table["force_N"]`` is a quantity in SI; the file may have other headers and units.

    It is a mapping of quantity to array of shape (rows,), float64; a cell that is no number is NaN.
    "segment" and "specimen" are lists of texts.

    Attributes
    ----------
    file : str
    maker : str
        Whose file it is ("JPK force curve"), if it was recognised; else empty.
    columns : list of dict
        All columns as the file writes them: header, name, unit, values (array), text (list or None).
    preamble : list of str
        Lines before the header.

    Examples
    --------
    >>> table = viscard.read_table(viscard.data_file("demo/example_relaxation.csv"))
    >>> sorted(table)
    ['modulus_Pa', 'time_s']
    >>> table["modulus_Pa"].shape == table["time_s"].shape
    True
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.file: str = found["file"]
        self.maker: str = found["maker"]
        self.columns: List[TableColumn] = found["columns"]
        self.preamble: List[str] = found["preamble"]
        self._quantities: Dict[str, Any] = found["quantities"]

    @overload
    def __getitem__(self, quantity: Literal["segment", "specimen"]) -> List[str]: ...  # type: ignore[misc]
    @overload
    def __getitem__(self, quantity: str) -> Floats: ...
    def __getitem__(self, quantity: str) -> Any:
        if quantity not in self._quantities:
            raise KeyError(f"{self.file} has no {quantity}; it has {', '.join(self) or 'none that is known'}; "
                           "name its column with read_table(path, column='NAME=HEADER')")
        return self._quantities[quantity]

    def __iter__(self) -> Iterator[str]:
        return iter(self._quantities)

    def __len__(self) -> int:
        return len(self._quantities)

    def _table(self) -> _show.Columns:
        columns = {f"{one['name']} ({one['unit']})" if one["unit"] else one["header"]:
                   np.array(one["text"]) if one["text"] is not None else one["values"] for one in self.columns}
        return _show.Columns(self.file, columns, [f"read as {', '.join(self)}"])

    def to_frame(self) -> Any:
        """The quantities in SI as a DataFrame of pandas."""
        return _show.frame(self._quantities)

    def __repr__(self) -> str:
        n_rows = len(self.columns[0]["values"]) if self.columns else 0
        return f"<viscard.Table {self.file}: {n_rows} rows, {', '.join(self)}>"


@_check.arguments
def read_table(path: Path, *, column: Texts = None, sheet: str = "") -> Table:
    """Read a table of numbers from any machine: CSV, text, Excel, MATLAB, JPK and others.

    Parameters
    ----------
    path : str or path
    column : str or list of str
        "NAME=HEADER" or "NAME=2": the column of a quantity, if its header does not show it.
    sheet : str
        Of an Excel workbook, or the struct of a MATLAB file; default: the one with most numbers.

    Examples
    --------
    >>> table = viscard.read_table(viscard.data_file("demo/example_relaxation.csv"))
    >>> table["time_s"][:2]
    array([0.01     , 0.0103912])
    """
    words = [column] if isinstance(column, str) else list(column or [])
    return Table(_core.read_table(os.fspath(path), words, sheet))


class Capture(Tabular):
    """A captured run (\\*.viscap) as arrays. Those of one record are views of it; nothing is copied.

    Attributes
    ----------
    file, status, started_at, program, command, specimen_id : str
    mixing_ratio : float
        Parts of base to one of curing agent; 0: not given.
    load : dict of arrays, shape (readings,)
        index, time_s (host clock, since the run began), device_time_s, counts, volts_V, force_N,
        is_saturated, is_glitch. What the cell does not give is NaN.
    stage : dict
        time_s, position_m (grows toward the specimen), state (list of str).
    moves : dict
        time_s, from_m, to_m, speed_m_s, acceleration_m_s2, purpose (list of str).
    temperature : dict of arrays
        time_s, temperature_C.
    events : list of (time_s, name, value, text)
    notes : list of str
        What the checksums of the file say against the record; empty if it is what was written.
    unverified : bool
        Whether damage to description, events or moves was accepted.

    Examples
    --------
    >>> capture = viscard.capture("run.viscap", emulate=True, speed=500).read()
    >>> capture.load["time_s"].shape == capture.load["counts"].shape
    True
    >>> sorted(capture.table())
    ['depth_m', 'force_N', 'position_m', 'segment', 'time_s', 'volts_V']
    """

    file: str
    status: str
    started_at: str
    program: str
    command: str
    specimen_id: str
    mixing_ratio: float
    load: Load
    stage: StageRecord
    moves: Moves
    temperature: Temperatures
    events: List[Tuple[float, str, str, str]]
    notes: List[str]
    unverified: bool

    def __init__(self, found: Dict[str, Any]) -> None:
        for name, value in found.items():
            setattr(self, name, value)

    def table(self) -> Table:
        """Force and depth on the clock that the fit uses, as ``viscard export`` writes them."""
        return Table(_core.table_of_capture(self.file, self.unverified))

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write every sample as CSV, as ``viscard export`` does; an existing file is kept unless `overwrite` is True.

        Examples
        --------
        >>> viscard.capture("run.viscap", emulate=True, speed=500).read().save("run.csv")
        >>> viscard.fit("run.csv", specimen=viscard.data_file("demo/03_pdms_1to10.toml")).unit
        'Pa'
        """
        _core.write_file(os.fspath(path), _core.csv_of_capture(self.file, self.unverified), overwrite)

    def to_frame(self) -> Any:
        """Force and depth, as of `table`, as a DataFrame of pandas."""
        return self.table().to_frame()

    def _table(self) -> _show.Columns:
        rows = [("status", self.status), ("started", self.started_at), ("specimen", self.specimen_id),
                ("readings", len(self.load["time_s"])), ("moves", len(self.moves["time_s"])), ("events", len(self.events))]
        return _show.of_rows(self.file, ("name", "value"), rows, self.notes)

    def __repr__(self) -> str:
        return f"<viscard.Capture {self.file}: {self.status}, {len(self.load['time_s'])} readings>"


@_check.arguments
def read_capture(path: Path, *, unverified: bool = False) -> Capture:
    """Read a captured run, also an unfinished one. The file is never changed.

    Parameters
    ----------
    path : str or path
    unverified : bool
        Read a capture although its checksums show that description, events or moves are damaged; its notes say so.

    Examples
    --------
    >>> outcome = viscard.capture("run.viscap", emulate=True, speed=500)
    >>> viscard.read_capture("run.viscap").status
    'finished'
    """
    return Capture(_core.read_capture(os.fspath(path), unverified))
