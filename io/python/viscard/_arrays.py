"""Numbers from users as numpy arrays, with messages that name what is wrong."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._check import is_boolean, is_number, shown
from ._error import Error
from ._types import Floats


def path_of(value: Any, name: str, others: str = "", hint: str = "") -> str:
    """A path as text. others: what may stand in its place, which the caller has looked for."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} must be a path{others}, not {shown(value)}{hint}")
    return str(os.fspath(value))


def whole(value: Any, name: str, least: int, most: int = 2**31 - 1) -> Optional[int]:
    """A whole number between these, or None."""
    if value is None:
        return None
    number = operator.index(value)
    if not least <= number <= most:
        raise Error(f"{name} is {number}; it must be at least {least}" + (f" and at most {most}" if number > most else ""),
                    "usage")
    return number


def _as_float(value: Any) -> float:
    """Infinite for a whole number beyond the range of float, NaN for a signalling NaN of decimal."""
    try:
        return float(value)
    except OverflowError:
        return float("inf")
    except ValueError:
        return float("nan")


def number(value: Any, name: str) -> float:
    """A finite number."""
    if not is_number(value):
        raise TypeError(f"{name} must be a number, not {shown(value)}")
    if not np.isfinite(_as_float(value)):
        raise Error(f"{name} is {shown(value)}; it must be a finite number", "input")
    return float(value)


def _holds_boolean(values: Any) -> bool:
    """Of nested lists; an array shows it by its type."""
    if isinstance(values, (list, tuple)):
        return any(_holds_boolean(one) for one in values)
    return is_boolean(values) or (isinstance(values, np.ndarray) and values.dtype.kind == "b")


def _is_missing(value: Any) -> bool:
    """None, and the NA of pandas, which is not imported for it."""
    return value is None or type(value).__name__ == "NAType"


def _with_gaps(values: Any) -> Any:
    """NaN in the place of what is missing: masked, None, or NA of pandas. All else as it is."""
    if isinstance(values, np.ma.MaskedArray) and values.dtype.kind in "fiu":
        return values.astype(np.float64).filled(np.nan)  # type: ignore[attr-defined]
    array = np.asarray(values)
    if array.dtype.kind != "O" or not all(_is_missing(one) or is_number(one) for one in array.flat):
        return array
    return np.array([np.nan if _is_missing(one) else _as_float(one) for one in array.flat]).reshape(array.shape)


def numbers(values: Any, name: str, shape: Optional[Tuple[int, ...]] = None) -> Floats:
    """Real numbers as float64; what is missing is NaN. Raises TypeError for anything else."""
    try:
        array = _with_gaps(values)
    except ValueError:  # rows of different lengths
        raise TypeError(f"{name} must hold numbers in rows of one length, not {shown(values)}") from None
    if _holds_boolean(values) or array.dtype.kind == "b":
        raise TypeError(f"{name} must hold real numbers, not True or False")
    if array.dtype.kind not in "fiu":
        found = "text" if array.dtype.kind in "US" else array.dtype
        raise TypeError(f"{name} must hold real numbers, not {found}")
    if shape is not None and array.shape != shape:
        raise Error(f"{name} has the shape {array.shape}; it must be {shape}", "input")
    return np.asarray(array, dtype=np.float64, order="C")  # keeps a single number without dimension


def arguments(values: Any, name: str, unit: str) -> Floats:
    """Times or frequencies: finite and not negative."""
    array = numbers(values, name)
    bad = ~(np.isfinite(array) & (array >= 0.0))
    if bad.any():
        raise Error(f"{name} holds {array[bad].flat[0]:g}; it must be finite and not negative ({unit})",
                    "input")
    return array


class Columns(Dict[str, Floats]):
    """Numbers by header, with the comments at the begin of their file: they state damage of the capture they come from."""

    comments: Sequence[str] = ()


def table(columns: Any, name: str) -> Columns:
    """Columns of numbers of one length by header, of a dict, a Table or a DataFrame; what is missing is NaN."""
    out = Columns()
    is_own = isinstance(getattr(columns, "comments", None), list)  # a Table, whose segments and specimens are texts
    attributes = getattr(columns, "attrs", None)  # of a DataFrame
    found = columns.comments if is_own else attributes.get("comments") if isinstance(attributes, dict) else None
    out.comments = [one for one in found if isinstance(one, str)] if isinstance(found, (list, tuple)) else ()
    for header in columns.keys():
        values = columns[header]
        if is_own and isinstance(values, list):
            continue
        if not isinstance(header, str):
            raise TypeError(f"a column of {name} has the name {shown(header)}; names are texts such as 'time_s'")
        out[header] = numbers(values, header)
        if out[header].ndim != 1:
            raise Error(f"{name}: column '{header}' has {out[header].ndim} dimensions; give one", "input")
    lengths = {header: len(values) for header, values in out.items()}
    if len(set(lengths.values())) > 1:
        raise Error(f"{name}: the columns have different lengths: " +
                    ", ".join(f"{header} {n}" for header, n in lengths.items()), "input")
    if not lengths or min(lengths.values()) == 0:
        raise Error(f"{name} holds no rows", "input")
    return out


def is_table(value: Any) -> bool:
    """Arrays by header: a dict, a Table, or a DataFrame of pandas, which has keys."""
    return hasattr(value, "keys") and hasattr(value, "__getitem__") and not is_by_kind(value)


def is_by_kind(value: Any) -> bool:
    """Tests by kind, {"creep": table or path}: a dict that holds paths, tables, captures, or lists of these."""
    if not isinstance(value, dict) or not value:
        return False
    first = _first_of(next(iter(value.values())))
    is_test = isinstance(first, (str, os.PathLike)) or hasattr(first, "keys") or hasattr(first, "moves")
    return is_test and not any(_is_column(one) for one in value.values())


def _first_of(value: Any) -> Any:
    return value[0] if isinstance(value, (list, tuple)) and len(value) > 0 else value


def _is_column(value: Any) -> bool:
    """A list or an array of numbers, or of texts that are numbers: no list of files."""
    if hasattr(value, "keys") or getattr(value, "ndim", 1) == 0:
        return False
    first = _first_of(value)
    try:
        is_text_of_number = first is not value and isinstance(first, str) and float(first) is not None
    except ValueError:
        is_text_of_number = False
    return is_text_of_number or hasattr(value, "__array__") or (first is not value and is_number(first))


OR_TABLE = ", a dict of arrays by header or a DataFrame"
_OR_LIST = ", a list of these, or a dict of these by kind of test"


class Given(NamedTuple):
    """What a function was given in the place of files: the words of the command, and arrays by the name that stands for
    their file."""

    words: List[str]
    tables: Dict[str, Dict[str, Floats]]
    only_files: bool

    def path_of(self, value: Any, where: str, others: str = "") -> str:
        if self.only_files:
            return path_of(value, where, f"{',' if others else ' or'} a Capture{others}", "; save arrays and materials to a file first")
        return path_of(value, where, f", a dict of arrays by header, a DataFrame{',' if others else ' or'} a Capture{others}")

    def add(self, value: Any, name: str, where: str, kind: str = "") -> None:
        """A path, a capture, or a table, which has this name unless it comes from a file. where: of the argument."""
        if is_table(value) and not self.only_files:
            name = value.file if hasattr(value, "preamble") else name  # a Table knows its file
            while name in self.tables:  # two parts of one file
                name += " again"
            self.tables[name] = table(value, name)
            path = name
        else:
            path = value.file if hasattr(value, "moves") else self.path_of(value, where)  # a Capture has one
        self.words.append(f"{kind}={path}" if kind else path)


def given(data: Any, name: str, only_files: bool = False) -> Given:
    """Of one path, capture or table, a list of these, or tests by kind; only_files: of no table."""
    out = Given([], {}, only_files)
    if is_by_kind(data):
        for kind, tests in data.items():
            each = tests if isinstance(tests, (list, tuple)) else [tests]
            if not each:
                raise Error(f"{name}[{shown(kind)}] is an empty list; give at least one test", "usage")
            for number, one in enumerate(each, 1):
                out.add(one, kind if len(each) == 1 else f"{kind} {number}", f"{name}[{shown(kind)}]", kind)
        for kind in data:
            if kind not in _core.test_kinds():
                raise Error(f"{name}: {_core.no_such_word('kind of test', str(kind), _core.test_kinds())}", "usage")
        return out
    if isinstance(data, (str, os.PathLike)) or hasattr(data, "moves") or (is_table(data) and not only_files):
        out.add(data, "arrays", name)
        return out
    if isinstance(data, (np.ndarray, bytes, bytearray)) or not hasattr(data, "__iter__") or is_table(data):
        out.path_of(data, name, _OR_LIST)  # raises what may stand there
    for number, one in enumerate(data):
        out.add(one, f"arrays {number + 1}", f"{name}[{number}]")
    if not out.words:
        raise Error(f"{name} is empty; give at least one file", "usage")
    return out


def pair(interval: Optional[Sequence[Optional[float]]]) -> Tuple[float, float]:
    """An interval of the JSON, in which null is an end without bound."""
    low, high = interval if interval is not None else (None, None)
    return (float("-inf") if low is None else low, float("inf") if high is None else high)


def column(rows: Iterable[Any], key: Callable[[Any], Optional[float]]) -> Floats:
    """One number of each row; null becomes NaN."""
    return np.array([np.nan if key(row) is None else key(row) for row in rows], dtype=float)


def with_head(schema: str, inputs: List[str], found: Dict[str, Any]) -> Dict[str, Any]:
    """The object of ``--json`` with what every one begins with."""
    from ._core import version

    return {"schema": schema, "version": version, "inputs": inputs, **found}
