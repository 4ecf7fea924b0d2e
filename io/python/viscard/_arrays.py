"""Numbers from users as numpy arrays, with messages that name what is wrong."""

from __future__ import annotations

import operator
import os

import numpy as np

from ._check import is_boolean, is_number, shown
from ._error import Error


def path_of(value, name: str) -> str:
    """A path as text."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} must be a path, not {shown(value)}")
    return os.fspath(value)


def whole(value, name: str, least: int, most: int = 2**31 - 1) -> "int | None":
    """A whole number between these, or None."""
    if value is None:
        return None
    number = operator.index(value)
    if not least <= number <= most:
        raise Error(f"{name} is {number}; it must be at least {least}" + (f" and at most {most}" if number > most else ""),
                    "usage")
    return number


def number(value, name: str) -> float:
    """A finite number."""
    if not is_number(value):
        raise TypeError(f"{name} must be a number, not {shown(value)}")
    if not np.isfinite(float(value)):
        raise Error(f"{name} is {value}; it must be a finite number", "input")
    return float(value)


def _holds_boolean(values) -> bool:
    """Of nested lists; an array shows it by its type."""
    if isinstance(values, (list, tuple)):
        return any(_holds_boolean(one) for one in values)
    return is_boolean(values) or (isinstance(values, np.ndarray) and values.dtype.kind == "b")


def numbers(values, name: str, shape: "tuple[int, ...] | None" = None) -> np.ndarray:
    """Real numbers as float64. Raises TypeError for anything else."""
    try:
        array = np.asarray(values)
    except ValueError:  # rows of different lengths
        raise TypeError(f"{name} must hold numbers in rows of one length, not {shown(values)}") from None
    if _holds_boolean(values) or array.dtype.kind == "b":
        raise TypeError(f"{name} must hold real numbers, not True or False")
    if array.dtype.kind not in "fiu":
        found = "text" if array.dtype.kind in "US" else array.dtype
        raise TypeError(f"{name} must hold real numbers, not {found}")
    if shape is not None and array.shape != shape:
        raise Error(f"{name} has the shape {array.shape}; it must be {shape}", "input")
    array = np.asarray(array, dtype=np.float64, order="C")  # keeps a single number without dimension
    masked = np.ma.getmask(values)  # what a masked array masks is no number
    return np.where(masked, np.nan, array) if np.any(masked) else array


def arguments(values, name: str, unit: str) -> np.ndarray:
    """Times or frequencies: finite and not negative."""
    array = numbers(values, name)
    bad = ~(np.isfinite(array) & (array >= 0.0))
    if bad.any():
        raise Error(f"{name} holds {array[bad].flat[0]:g}; it must be finite and not negative ({unit})",
                    "input")
    return array


def table(columns, name: str) -> "dict[str, np.ndarray]":
    """Columns of one length by header."""
    out: "dict[str, np.ndarray]" = {}
    for header, values in columns.items():
        if not isinstance(header, str):
            raise TypeError(f"a column of {name} has the name {shown(header)}; names are texts such as 'time_s'")
        out[header] = numbers(values, header)
        if out[header].ndim != 1:
            raise Error(f"{name}: column '{header}' has {out[header].ndim} dimensions; give one", "input")
    lengths = {header: len(values) for header, values in out.items()}
    if len(set(lengths.values())) > 1:
        raise Error(f"{name}: the columns have different lengths: " +
                    ", ".join(f"{header} {n}" for header, n in lengths.items()), "input")
    masked = [header for header, values in columns.items() if np.any(np.ma.getmask(values))]
    if masked:  # a row that one of them masks is no reading
        kept = ~np.any([np.ma.getmaskarray(columns[header]) for header in masked], axis=0)
        out = {header: values[kept] for header, values in out.items()}
        lengths = {header: int(kept.sum()) for header in out}
    if not lengths or min(lengths.values()) == 0:
        raise Error(f"{name} holds no rows", "input")
    return out


def pair(interval) -> "tuple[float, float]":
    """An interval of the JSON, in which null is an end without bound."""
    low, high = interval if interval is not None else (None, None)
    return (float("-inf") if low is None else low, float("inf") if high is None else high)


def column(rows, key) -> np.ndarray:
    """One number of each row; null becomes NaN."""
    return np.array([np.nan if key(row) is None else key(row) for row in rows], dtype=float)


def with_head(schema: str, inputs: "list[str]", found: dict) -> dict:
    """The object of ``--json`` with what every one begins with."""
    from ._core import version

    return {"schema": schema, "version": version, "inputs": inputs, **found}
