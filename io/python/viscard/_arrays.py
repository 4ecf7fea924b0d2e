"""Numbers from users as numpy arrays, with messages that name what is wrong."""

from __future__ import annotations

import operator
import os

import numpy as np

from ._error import Error


def path_of(value, name: str) -> str:
    """A path as text."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} must be a path, not {type(value).__name__}")
    return os.fspath(value)


def optional_path(value, name: str) -> "str | None":
    return None if value is None else path_of(value, name)


def whole(value, name: str, least: int) -> "int | None":
    """A whole number or None."""
    if value is None:
        return None
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {value!r}") from None
    if number < least:
        raise Error(f"{name} is {number}; it must be at least {least}", "usage")
    return number


def numbers(values, name: str, shape: "tuple[int, ...] | None" = None) -> np.ndarray:
    """Real numbers as float64. Raises TypeError for anything else."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    if shape is not None and array.shape != shape:
        raise Error(f"{name} has the shape {array.shape}; it must be {shape}", "input")
    return np.asarray(array, dtype=np.float64, order="C")  # keeps a single number without dimension


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
            raise TypeError(f"a column of {name} has the name {header!r}; names are texts such as 'time_s'")
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
