"""What a fit found: FitResult and JointFit."""

from __future__ import annotations

import os
from typing import Any, Dict, Iterable, List, NamedTuple, Tuple

import numpy as np

from . import _check, _core, _show
from ._types import Floats, Path
from ._error import Error
from ._material import Material
from ._result import Parameter, Result, Tabular


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


def of_fit(title: str, parameters: "Iterable[Parameter]", flags: "List[Flag]", is_trustworthy: bool) -> _show.Columns:
    """The table of a fit: its parameters, and its flags below."""
    notes = [] if is_trustworthy else ["not to be trusted"]
    return _show.of_rows(title, ("name", "value", "interval_95"), parameters, notes + [f"{flag.name}: {flag.text}" for flag in flags])


class FitResult(Result):
    """A fitted modulus and Prony series with 95 % intervals.

    Values are in `unit`: "Pa", or "N/m" (stiffness) or "N" (force) if the geometry or depth is not known.
    ``result["key"]`` gives every key of ``viscard fit --json``, ``summary()`` its text.

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
        super().__init__(found["result"])
        self.file: str = found["file"]
        self.covariance: Floats = self.values["covariance"]
        self.covariance_parameters: List[str] = self.values["covariance_parameters"]
        self.curves: Dict[str, Any] = self.values["curves"]
        self.flags = [Flag(f["name"], f.get("term", 0), f["text"]) for f in self.values["flags"]]
        self.is_trustworthy: bool = self.values["trustworthy"]
        self._letter = next(letter for letter in "EKF" if f"{letter}0_interval_95" in self.values)
        self._suffix = {"E": "_Pa", "K": "_N_m", "F": "_N"}[self._letter]
        self._stem = {"E": "modulus", "K": "stiffness", "F": "force"}[self._letter] + self._suffix
        self.unit: str = {"E": "Pa", "K": "N/m", "F": "N"}[self._letter]
        self._material = None if found["material"] is None else Material._of(found["material"])
        self._no_material: str = found["no_material"]

    def _value(self, name: str) -> float:
        return float(self.values[self._letter + name + self._suffix])

    def _interval(self, key: str) -> Tuple[float, float]:
        low, high = self.values[key]
        return float(low), float(high)

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
    def E0_interval(self) -> Tuple[float, float]:
        return self._interval(self._letter + "0_interval_95")

    @property
    def E_inf_interval(self) -> Tuple[float, float]:
        return self._interval(self._letter + "_inf_interval_95")

    @property
    def E0_combined_interval(self) -> Tuple[float, float]:
        return self._interval(self._letter + "0_combined_interval_95")

    def _terms(self, key: str) -> Floats:
        return np.array([term[key] for term in self.values["terms"]], dtype=float)

    def _intervals(self, key: str) -> Floats:
        rows = [term["interval_95"][key] for term in self.values["terms"]]
        return np.array(rows, dtype=float).reshape(-1, 2)

    @property
    def g(self) -> Floats:
        return self._terms("g")

    @property
    def tau_s(self) -> Floats:
        return self._terms("tau_s")

    @property
    def moduli(self) -> Floats:
        return self._terms(self._stem)

    @property
    def g_interval(self) -> Floats:
        return self._intervals("g")

    @property
    def tau_interval_s(self) -> Floats:
        return self._intervals("tau_s")

    @property
    def moduli_interval(self) -> Floats:
        return self._intervals(self._stem)

    @property
    def material(self) -> Material:
        """The material of the fit. Raises Error if the fit gives no modulus."""
        if self._material is None:
            raise Error(self._no_material, "input")
        return self._material

    @property
    def parameters(self) -> Dict[str, Parameter]:
        """Moduli, shares and times by name (E0_Pa, E_inf_Pa, g_1, tau_1_s, ...) with their 95 % intervals.

        Examples
        --------
        >>> found = viscard.fit(viscard.data_file("demo/example_relaxation.csv")).parameters
        >>> list(found)
        ['E0_Pa', 'E_inf_Pa', 'g_1', 'tau_1_s', 'g_2', 'tau_2_s']
        """
        rows = [(self._letter + "0" + self._suffix, self.E0, self.E0_interval),
                (self._letter + "_inf" + self._suffix, self.E_inf, self.E_inf_interval)]
        for i, (g, (g_low, g_high), tau, (tau_low, tau_high)) in enumerate(zip(self.g, self.g_interval, self.tau_s, self.tau_interval_s), 1):
            rows += [(f"g_{i}", float(g), (g_low, g_high)), (f"tau_{i}_s", float(tau), (tau_low, tau_high))]
        return {name: Parameter(name, value, interval) for name, value, interval in rows}

    @property
    def residuals(self) -> Floats:
        """Measured minus fitted, shape (rows,), in ``curves["unit"]``; of an oscillation of the storage modulus."""
        return np.asarray(self.curves["measured"] - self.curves["fitted"])

    def to_frame(self) -> Any:
        """The curves as a DataFrame of pandas: at, measured, fitted, residual, sigma."""
        columns = {name: values for name, values in self.curves.items() if isinstance(values, np.ndarray)}
        return _show.frame({**columns, "residual": self.residuals})

    def _table(self) -> _show.Columns:
        return of_fit(f"{self.file}: {self['kind']}", self.parameters.values(), self.flags, self.is_trustworthy)

    def summary(self) -> str:
        """The text of ``viscard fit``: moduli with intervals, the table of orders, flags."""
        return str(self._core.text())

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Data, fit and its 95 % band on logarithmic time (or frequency; of an indentation, on linear time). Needs
        matplotlib. Returns the axes.

        On axes of its own the residuals stand below, over the standard deviation of the data, and the hold of an
        indentation is drawn large, however small its relaxation.

        Parameters
        ----------
        ax : matplotlib axes
            Default: new ones, with the residuals below.
        style : dict
            For both curves, such as ``color="C3"``; `label` names the fit.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> axes = viscard.fit(viscard.data_file("demo/example_relaxation.csv")).plot()
        >>> axes.get_ylabel()
        'modulus (MPa)'
        """
        from ._plot import plot_fit

        return plot_fit(self, ax, style)

    def __repr__(self) -> str:
        low, high = self.E0_interval
        n = len(self.values["terms"])
        doubt = "" if self.is_trustworthy else ", not to be trusted"
        return (f"<viscard.FitResult {self.file}: E0 {self.E0:.6g} {self.unit} "
                f"(95 % {low:.6g} to {high:.6g}), {n} term{'' if n == 1 else 's'}{doubt}>")


class JointFit(Tabular):
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

    def __init__(self, found: _core.RatioFit) -> None:
        import json

        self._core = found
        self.json: Dict[str, Any] = json.loads(found.to_json())
        self.law: str = found.law()
        self.ratios: Floats = np.array(found.ratios())

    @_check.arguments
    def material(self, ratio: float, *, may_extrapolate: bool = False) -> Material:
        """The material at a mixing ratio: measured, or from the law."""
        return Material._of(self._core.at(float(ratio), may_extrapolate))

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the joint file, which ``viscard card --ratio`` reads."""
        _core.write_file(os.fspath(path), self._core.to_json(), overwrite)

    def __reduce__(self) -> Tuple[Any, ...]:
        return (_joint_from_json, (self._core.to_json(),))

    @property
    def residuals(self) -> Floats:
        """E0 of each specimen over that of the material at its ratio, less 1, shape (specimens,); in the order of
        ``json["specimens"]``."""
        return np.array([one["E0_Pa"] / self.material(one["mixing_ratio"]).E0_Pa - 1.0 for one in self.json["specimens"]])

    @_check.arguments
    def plot(self, ax: Any = None) -> Any:
        """Instantaneous modulus against mixing ratio: the specimens, the measured ratios with their 95 % intervals, and the
        law. Needs matplotlib. Returns the axes."""
        from ._plot import plot_joint

        return plot_joint(self, ax)

    def _table(self) -> _show.Columns:
        rows = []
        for one in self.json["materials"]:
            of, material = one["uncertainty"], self.material(one["mixing_ratio"])
            row = {"mixing_ratio": one["mixing_ratio"], "E0_Pa": material.E0_Pa, "E0_interval_95": of.get("E0_interval_95"),
                   "E_inf_Pa": material.E_inf_Pa, "E_inf_interval_95": of.get("E_inf_interval_95")}
            for i, (g, tau_s) in enumerate(zip(material.g, material.tau_s), 1):
                row.update({f"g_{i}": g, f"tau_{i}_s": tau_s})
            rows.append(row)
        flags = [f"{one['name']}: {one['text']}" for one in self.json["flags"]]
        return _show.of_dicts(f"joint fit: {self.law}", max((list(row) for row in rows), key=len, default=[]), rows, flags)

    def __repr__(self) -> str:
        return f"<viscard.JointFit {self.law}>"


def _joint_from_json(text: str) -> JointFit:
    return JointFit(_core.ratio_fit_from_json(text, "joint fit"))
