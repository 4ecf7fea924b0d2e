"""Fits of tables, captures and arrays."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping as _Mapping
from typing import Any, List, Unpack

import numpy as np

from . import _arrays, _check, _core
from ._error import DoubtWarning, Error
from ._fit_result import FitResult, JointFit
from ._options import FitOptions
from ._table import Capture, Table
from ._types import Progress


def _paths(data, name: str = "data") -> "list[str]":
    if isinstance(data, Capture):
        return [data.file]
    if isinstance(data, (str, os.PathLike)):
        return [_arrays.path_of(data, name)]
    if isinstance(data, (np.ndarray, bytes, bytearray)) or not hasattr(data, "__iter__"):
        raise TypeError(f"{name} must be a path, a dict of arrays by header, a Capture or a list of paths, "
                        f"not {_check.shown(data)}")
    return [one.file if isinstance(one, Capture) else _arrays.path_of(one, name) for one in data]


def _file_of(word: str) -> str:
    """The file of "creep=a.csv"."""
    kind, sign, file = word.partition("=")
    return file if sign and not os.path.exists(word) else word


def _warn(result, name: str) -> None:
    if result.is_trustworthy:
        return
    causes = "; ".join(flag.text for flag in result.flags) or "no flag names the cause"
    warnings.warn(f"{name}: the result is not to be trusted: {causes}", DoubtWarning, stacklevel=5)


@_check.arguments
def fit(data, *, errors: str = "raise", progress: Progress = None, **options: Unpack[FitOptions]):
    """Fit the instantaneous modulus and a Prony series, with 95 % intervals.

    Quantities are texts with a unit ("0.1 mm") or numbers in SI. The options are those of ``viscard fit``, with "_"
    for "-"; from_ is --from.

    Parameters
    ----------
    data : path, Capture, Table, dict of arrays, or list of paths
        A list gives a list of results, fitted on all cores. "relaxation=a.csv", "creep=b.csv", ... in a list are
        tests of one material, fitted together into one result; "uniaxial=a.csv", "compression=b.csv", "planar=c.csv",
        "equibiaxial=d.csv" are tests of rubber at large strain. A dict has arrays of shape (rows,) by header with
        unit: ``{"time_s": t, "modulus_Pa": E}``, ``{"Time [ms]": t, "Force [mN]": F}``; a message about
        "arrays:7" means row 7, from 1. Rows that a masked array masks are left out.
    errors : "raise" or "return"
        Of a list: "return" puts the Error of a file that cannot be fitted in the place of its result.
    progress : function of (fraction, step)
    **options

    Returns
    -------
    FitResult, list of FitResult, JointFit with joint=True, or RubberFit of tests at large strain

    Examples
    --------
    >>> result = viscard.fit(viscard.data_file("demo/example_relaxation.csv"))
    >>> print(f"{result.E0_Pa / 1e6:.2f} MPa")
    1.88 MPa
    >>> import numpy as np
    >>> t = np.geomspace(0.01, 100, 400)
    >>> E = 1e6 + 5e5 * np.exp(-t / 2)
    >>> noise = 1e3 * np.random.default_rng(1).standard_normal(t.size)
    >>> viscard.fit({"time_s": t, "modulus_Pa": E + noise}).tau_s.round(1)
    array([2.])
    """
    keywords = {name: value for name, value in options.items() if value is not None}
    if errors not in ("raise", "return"):
        raise Error(f"errors is {errors!r}; use 'raise' or 'return'", "usage")
    command = "viscard.fit(" + ", ".join(f"{k}={v!r}" for k, v in keywords.items() if v is not False) + ")"
    if isinstance(data, _Mapping) or hasattr(data, "keys"):  # a DataFrame of pandas has keys
        _refuse_rubber_options(keywords)
        return _fit_arrays(data, keywords, command, progress)
    paths = _paths(data)
    if not paths:
        raise Error("there is nothing to fit: the list is empty", "usage")
    if _core.is_large_strain(paths):
        return _fit_rubber(paths, keywords)
    _refuse_rubber_options(keywords)
    if keywords.get("joint"):
        return JointFit(_core.fit_ratios(paths, keywords, command, progress))
    found = _core.fit_paths(paths, keywords, command, progress)
    return _results(data, found, errors)


_RUBBER_ONLY = ("weight", "cycle")


def _refuse_rubber_options(keywords) -> None:
    for name in _RUBBER_ONLY:
        if name in keywords:
            raise Error(f'{name} is for tests at large strain ("uniaxial=FILE"); omit it', "usage")


def _fit_rubber(paths, keywords):
    from ._rubber import RubberFit

    for name, value in keywords.items():
        if name not in _RUBBER_ONLY + (
                "model", "column", "sheet", "table", "skip", "gauge_length", "area", "youngs_modulus", "terms",
                "max_terms", "plausible") and value is not False:
            raise Error(f"{name} does not belong to tests at large strain; omit it", "usage")
    if isinstance(keywords.get("cycle"), int):
        keywords["cycle"] = str(keywords["cycle"])
    found = _core.fit_rubber(paths, keywords)
    result = RubberFit(found["json_text"], " + ".join(_file_of(path) for path in paths), found["text"],
                       found["tests"], found["times"], found["stresses"])
    _warn(result, result._name)
    return result


def _fit_arrays(data, keywords, command, progress):
    name = data.file if isinstance(data, Table) else "arrays"
    numbers = {key: data[key] for key in data.keys() if not (isinstance(data, Table) and isinstance(data[key], list))}
    arrays = _arrays.table(numbers, name)
    found = _core.fit_arrays(arrays, name, keywords, command, progress)[0]
    result = FitResult(found)
    _warn(result, result.file)
    return result


def _results(data, found, errors):
    is_one = len(found) == 1 and (isinstance(data, (str, os.PathLike, Capture)) or
                                  " + " in found[0]["file"] or "=" in str(list(data)[0]))
    results: List[Any] = []
    for one in found:
        error = one["error"]
        if error is not None:
            failure = Error(error["text"], error["code"], error["message"], error["where"], error["hint"])
            if errors == "raise" or is_one:
                raise failure
            results.append(failure)
            continue
        results.append(FitResult(one))
        _warn(results[-1], results[-1].file)
    return results[0] if is_one else results
