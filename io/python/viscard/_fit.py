"""Fits of tables, captures and arrays."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Dict, List, Literal, Sequence, Union, Unpack, overload

from . import _arrays, _check, _core
from ._error import DoubtWarning, Error, in_python
from ._fit_result import FitResult, JointFit
from ._options import FitOptions, JointOptions
from ._types import Progress, RubberTests, Source, Tests

if TYPE_CHECKING:
    from ._rubber import RubberFit


def _file_of(word: str) -> str:
    """The file of "creep=a.csv"."""
    kind, sign, file = word.partition("=")
    return file if sign and not os.path.exists(word) else word


def _warn(result: Union[FitResult, RubberFit], name: str) -> None:
    if result.is_trustworthy:
        return
    causes = "; ".join(in_python(flag.text) for flag in result.flags) or "no flag names the cause"
    warnings.warn(f"{name}: the result is not to be trusted: {causes}", DoubtWarning, stacklevel=5)


# A text is a sequence of texts, and a dict of tests has keys as a table has: the first overload that fits is the right one.
@overload
def fit(data: RubberTests, *, errors: str = ..., progress: Progress = ...,  # type: ignore[misc]
        **options: Unpack[FitOptions]) -> RubberFit: ...
@overload
def fit(data: Union[Source, Tests], *, errors: str = ..., progress: Progress = ...,  # type: ignore[misc]
        **options: Unpack[FitOptions]) -> FitResult: ...
@overload
def fit(data: Sequence[Source], *, joint: Literal[True], errors: str = ..., progress: Progress = ...,  # type: ignore[misc]
        **options: Unpack[JointOptions]) -> JointFit: ...
@overload
def fit(data: Sequence[Source], *, errors: Literal["return"], progress: Progress = ...,
        **options: Unpack[FitOptions]) -> List[Union[FitResult, Error]]: ...
@overload
def fit(data: Sequence[Source], *, errors: Literal["raise"] = ..., progress: Progress = ...,
        **options: Unpack[FitOptions]) -> List[FitResult]: ...
@_check.arguments
def fit(data: Any, *, errors: str = "raise", progress: Progress = None, **options: Unpack[FitOptions]) -> Any:
    """Fit the instantaneous modulus and a Prony series, with 95 % intervals.

    Quantities are texts with a unit ("0.1 mm") or numbers in SI. The options are those of ``viscard fit``, with "_"
    for "-"; from_ is --from.

    Parameters
    ----------
    data : path, Capture, Table, dict of arrays, DataFrame, list of these, or dict of these by kind of test
        A dict has arrays of shape (rows,) by header with unit: ``{"time_s": t, "modulus_Pa": E}``,
        ``{"Time [ms]": t, "Force [mN]": F}``, and so has a DataFrame of pandas; a message about "arrays:7" means row 7,
        from 1. What is missing (NaN, None, NA of pandas, masked) or infinite leaves its row out, if the fit uses the
        column; the result counts these rows.
        A list gives a list of results, fitted on all cores.
        A dict by kind gives one result: tests of one material that are fitted together, ``{"relaxation": "a.csv",
        "creep": {"time_s": t, "compliance_1_Pa": J}}`` (also dma, indentation), or tests of rubber at large strain,
        ``{"uniaxial": {"stretch": s, "nominal_stress_Pa": P}}`` (also compression, planar, equibiaxial). Several tests
        of a kind are a list. The words of the command line do the same: ["relaxation=a.csv", "creep=b.csv"].
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
        raise Error(f"errors is {_check.shown(errors)}; use 'raise' or 'return'", "usage")
    command = "viscard.fit(" + ", ".join(f"{k}={v!r}" for k, v in keywords.items() if v is not False) + ")"
    if isinstance(data, Iterator):
        data = list(data)
    given = _arrays.given(data, "data")
    if _core.is_large_strain(given.words):
        return _fit_rubber(given, keywords)
    _refuse_rubber_options(keywords)
    if keywords.get("joint"):
        if _arrays.is_table(data):
            raise Error("joint fits records at several mixing ratios; give a list of them", "usage")
        return JointFit(_core.fit_ratios(given.words, given.tables, keywords, command, progress))
    found = _core.fit_paths(given.words, given.tables, keywords, command, progress)
    return _results(data, found, errors)


_RUBBER_ONLY = ("weight", "cycle")


def _refuse_rubber_options(keywords: Dict[str, Any]) -> None:
    for name in _RUBBER_ONLY:
        if name in keywords:
            raise Error(f'{name} is for tests at large strain ("uniaxial=FILE"); omit it', "usage")


def _fit_rubber(given: _arrays.Given, keywords: Dict[str, Any]) -> RubberFit:
    from ._rubber import RubberFit

    for name, value in keywords.items():
        if name not in _RUBBER_ONLY + (
                "model", "column", "sheet", "table", "skip", "gauge_length", "area", "youngs_modulus", "terms",
                "max_terms", "plausible", "poisson_ratio") and value is not False:
            raise Error(f"{name} does not belong to tests at large strain; omit it", "usage")
    if isinstance(keywords.get("cycle"), int):
        keywords["cycle"] = str(keywords["cycle"])
    found = _core.fit_rubber(given.words, given.tables, keywords)
    result = RubberFit(found["json_text"], " + ".join(_file_of(word) for word in given.words), found["text"],
                       found["tests"], found["times"], found["stresses"])
    _warn(result, result._name)
    return result


def _results(data: Any, found: List[Dict[str, Any]], errors: str) -> Any:
    is_list = not isinstance(data, (str, os.PathLike)) and not hasattr(data, "keys") and not hasattr(data, "moves")
    is_one = len(found) == 1 and (not is_list or " + " in found[0]["file"] or "=" in str(list(data)[0]))
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
