"""Fits of tables, captures and arrays."""

from __future__ import annotations

import inspect
import os
import warnings
from collections.abc import Mapping as _Mapping
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _arrays, _check, _core
from ._check import OptionalPath, Path, Progress, Quantity, Texts
from ._error import DoubtWarning, Error
from ._material import Material
from ._table import Capture, Table


class Flag(NamedTuple):
    """What the data do not determine. `term` counts from 1; 0 is the whole material.

    Examples
    --------
    >>> viscard.Flag("tau-below-sampling", 1, "a sentence").name
    'tau-below-sampling'
    """

    name: str
    term: int
    text: str


class FitResult:
    """A fitted modulus and Prony series with 95 % intervals.

    Values are in `unit`: "Pa", or "N/m" (stiffness) or "N" (force) if the geometry or depth is not known.
    ``result["key"]`` gives every key of ``viscard fit --json``.

    Attributes
    ----------
    E0, E_inf : float
        Instantaneous and long-term modulus; `E0_Pa` and `E_inf_Pa` refuse another unit.
    E0_interval, E_inf_interval : (low, high)
        95 %; `E0_combined_interval` includes the systematic part (geometry, calibration).
    g, tau_s, moduli : array, shape (terms,)
        Shares of E0, relaxation times in s, moduli in `unit`; ascending times.
    g_interval, tau_interval_s, moduli_interval : array, shape (terms, 2)
    covariance : array, shape (parameters, parameters)
        In the units that `covariance_parameters` state.
    flags : list of Flag
    is_trustworthy : bool
        False: not converged, saturated, and so on; the flags name the cause.
    curves : dict of arrays, shape (rows,)
        at (s; Hz of an oscillation), measured, fitted, sigma in `curves["unit"]`; averages of the data.
    json : dict
    material : Material
    file : str

    Examples
    --------
    >>> result = viscard.fit(viscard.data_file("demo/example_relaxation.csv"))
    >>> len(result.tau_s), result.unit
    (2, 'Pa')
    >>> low, high = result.E0_interval
    >>> bool(low < result.E0_Pa < high)
    True
    >>> result.covariance.shape
    (5, 5)
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.json: Dict[str, Any] = _arrays.with_head("viscard-fit/1", found["inputs"], found["json"])
        self.file: str = found["file"]
        self.covariance: np.ndarray = found["covariance"]
        self.covariance_parameters: List[str] = found["covariance_parameters"]
        self.curves: Dict[str, Any] = found["curves"]
        self.flags = [Flag(f["name"], f.get("term", 0), f["text"]) for f in self.json["flags"]]
        self.is_trustworthy: bool = self.json["trustworthy"]
        self._letter = next(letter for letter in "EKF" if f"{letter}0_interval_95" in self.json)
        self._suffix = {"E": "_Pa", "K": "_N_m", "F": "_N"}[self._letter]
        self._stem = {"E": "modulus", "K": "stiffness", "F": "force"}[self._letter] + self._suffix
        self.unit: str = {"E": "Pa", "K": "N/m", "F": "N"}[self._letter]
        self._text: str = found["text"]
        self._material = found["material"]
        self._no_material: str = found["no_material"]

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

    def _value(self, name: str) -> float:
        value = self.json[self._letter + name + self._suffix]
        return float("nan") if value is None else value

    def _in_Pa(self, value: float) -> float:
        if self.unit != "Pa":
            raise Error(f"{self.file} gives no modulus but values in {self.unit}; "
                        "add punch_diameter, specimen or depth", "input")
        return value

    @property
    def E0(self) -> float:
        return self._value("0")

    @property
    def E_inf(self) -> float:
        return self._value("_inf")

    @property
    def E0_Pa(self) -> float:
        return self._in_Pa(self.E0)

    @property
    def E_inf_Pa(self) -> float:
        return self._in_Pa(self.E_inf)

    @property
    def E0_se(self) -> float:
        return self._value("0_se")

    @property
    def E0_interval(self):
        return _arrays.pair(self.json[self._letter + "0_interval_95"])

    @property
    def E_inf_interval(self):
        return _arrays.pair(self.json[self._letter + "_inf_interval_95"])

    @property
    def E0_combined_interval(self):
        return _arrays.pair(self.json[self._letter + "0_combined_interval_95"])

    def _terms(self, key: str) -> np.ndarray:
        return _arrays.column(self.json["terms"], lambda term: term[key])

    def _intervals(self, key: str) -> np.ndarray:
        rows = [_arrays.pair(term["interval_95"][key]) for term in self.json["terms"]]
        return np.array(rows, dtype=float).reshape(-1, 2)

    @property
    def g(self) -> np.ndarray:
        return self._terms("g")

    @property
    def tau_s(self) -> np.ndarray:
        return self._terms("tau_s")

    @property
    def moduli(self) -> np.ndarray:
        return self._terms(self._stem)

    @property
    def g_interval(self) -> np.ndarray:
        return self._intervals("g")

    @property
    def tau_interval_s(self) -> np.ndarray:
        return self._intervals("tau_s")

    @property
    def moduli_interval(self) -> np.ndarray:
        return self._intervals(self._stem)

    @property
    def material(self) -> Material:
        """The material of the fit. Raises Error if the fit gives no modulus."""
        if self._material is None:
            raise Error(self._no_material, "input")
        return Material._of(self._material)

    def summary(self) -> str:
        """The text of ``viscard fit``: moduli with intervals, the table of orders, flags."""
        return self._text

    def plot(self, ax=None, **style):
        """Data and fit on logarithmic time (or frequency; of an indentation, on linear time). Needs matplotlib.
        Returns the axes.

        Parameters
        ----------
        ax : matplotlib axes
            Default: new ones.
        style : dict
            For both curves, such as ``color="C3"``; `label` names the fit.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> axes = viscard.fit(viscard.data_file("demo/example_relaxation.csv")).plot()
        >>> axes.get_xlabel()
        'time (s)'
        """
        from ._plot import plot_fit

        return plot_fit(self, ax, style)

    def __repr__(self) -> str:
        low, high = self.E0_interval
        n = len(self.json["terms"])
        doubt = "" if self.is_trustworthy else ", not to be trusted"
        return (f"<viscard.FitResult {self.file}: E0 {self.E0:.6g} {self.unit} "
                f"(95 % {low:.6g} to {high:.6g}), {n} term{'' if n == 1 else 's'}{doubt}>")


class JointFit:
    """The law of a material in its mixing ratio, from ``fit(files, joint=True)``.

    Attributes
    ----------
    json : dict
        The joint file.
    law : str
        The law in words.
    ratios : array, shape (ratios,)
        That were measured, parts of base to one of curing agent.

    Examples
    --------
    >>> import numpy as np
    >>> time_s, random = np.geomspace(0.01, 100.0, 300), np.random.default_rng(4)
    >>> for ratio in (10, 13, 20):
    ...     E = viscard.Material(2e7 / ratio, 0.495, terms=[(0.1, 0.5), (0.1, 8.0)]).relaxation(time_s)
    ...     np.savetxt(f"1to{ratio}.csv", np.c_[time_s, E * random.normal(1.0, 1e-3, 300)], delimiter=",",
    ...                header="time_s,modulus_Pa", comments="")
    >>> joint = viscard.fit(["1to10.csv", "1to13.csv", "1to20.csv"], joint=True, ratio=[10, 13, 20])
    >>> joint.ratios
    array([10., 13., 20.])
    >>> bool(joint.material(20).E0_Pa < joint.material(10).E0_Pa)
    True
    """

    def __init__(self, found) -> None:
        import json

        self._core = found
        self.json: Dict[str, Any] = json.loads(found.to_json())
        self.law: str = found.law()
        self.ratios: np.ndarray = np.array(found.ratios())

    @_check.arguments
    def material(self, ratio: float, *, may_extrapolate: bool = False) -> Material:
        """The material at a mixing ratio: measured, or from the law."""
        return Material._of(self._core.at(float(ratio), may_extrapolate))

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the joint file, which ``viscard card --ratio`` reads."""
        _core.write_file(os.fspath(path), self._core.to_json(), overwrite)

    def __repr__(self) -> str:
        return f"<viscard.JointFit {self.law}>"


def _paths(data, name: str = "data") -> "list[str]":
    if isinstance(data, Capture):
        return [data.file]
    if isinstance(data, (str, os.PathLike)):
        return [_arrays.path_of(data, name)]
    if isinstance(data, np.ndarray) or not hasattr(data, "__iter__"):
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
def fit(data, *, kind: Optional[str] = None, terms: Optional[int] = None,
        max_terms: Optional[int] = None, liquid: bool = False, solid: bool = False,
        allow_negative: bool = False, noise: Optional[str] = None, drift: bool = False,
        no_drift: bool = False, full_data: bool = False, profiles: bool = False,
        diagnose: bool = False, model: Optional[str] = None, bootstrap: Optional[int] = None,
        fix: Texts = None, bound: Texts = None, constraints: OptionalPath = None, column: Texts = None,
        sheet: Optional[str] = None, segment: Texts = None, time_zero: Quantity = None,
        from_: Quantity = None, to: Quantity = None, hold: Optional[int] = None,
        crop: Optional[str] = None, depth: Quantity = None, specimen: OptionalPath = None,
        punch_diameter: Quantity = None, layer_thickness: Quantity = None,
        poisson_ratio: Optional[float] = None, frame_stiffness: Quantity = None,
        reference_temperature: Quantity = None, vertical_shift: Optional[str] = None,
        density: Quantity = None, ratio: Union[float, Sequence[float], None] = None,
        joint: bool = False, specimen_id: Texts = None, own_terms: bool = False,
        share: Texts = None, weight: Optional[str] = None, youngs_modulus: Quantity = None,
        cycle: Union[int, str, None] = None, errors: str = "raise", progress: Progress = None):
    """Fit the instantaneous modulus and a Prony series, with 95 % intervals.

    Parameters
    ----------
    data : path, Capture, Table, dict of arrays, or list of paths
        A list gives a list of results, fitted on all cores. "relaxation=a.csv", "creep=b.csv", ... in a list are
        tests of one material, fitted together into one result; "uniaxial=a.csv", "compression=b.csv", "planar=c.csv",
        "equibiaxial=d.csv" are tests of rubber at large strain. A dict has arrays of shape (rows,) by header with
        unit: ``{"time_s": t, "modulus_Pa": E}``, ``{"Time [ms]": t, "Force [mN]": F}``; a message about
        "arrays:7" means row 7, from 1.
    errors : "raise" or "return"
        Of a list: "return" puts the Error of a file that cannot be fitted in the place of its result.
    progress : function of (fraction, step)
    **options
        Those of ``viscard fit``, with "_" for "-" (``viscard fit --help`` explains each). Quantities are texts
        with a unit ("0.1 mm") or numbers in SI; from_ is --from.

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
    given = dict(locals())
    keywords = {name: given[name] for name in _OPTIONS if given[name] is not None}
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
    if joint:
        return JointFit(_core.fit_ratios(paths, keywords, command, progress))
    found = _core.fit_paths(paths, keywords, command, progress)
    inputs = [[one["file"]] for one in found] if len(found) == len(paths) else [[_file_of(path) for path in paths]]
    return _results(data, [{"inputs": of_one, **one} for of_one, one in zip(inputs, found)], errors)


_RUBBER_ONLY = ("weight", "youngs_modulus", "cycle")


def _refuse_rubber_options(keywords) -> None:
    for name in _RUBBER_ONLY:
        if name in keywords:
            raise Error(f'{name} is for tests at large strain ("uniaxial=FILE"); omit it', "usage")


def _fit_rubber(paths, keywords):
    from ._rubber import RubberFit

    for name, value in keywords.items():
        if name not in _RUBBER_ONLY + ("model", "column", "sheet", "terms", "max_terms") and value is not False:
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
    result = FitResult({"inputs": [name], **found})
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


_OPTIONS = [name for name in inspect.signature(fit).parameters if name not in ("data", "errors", "progress")]
