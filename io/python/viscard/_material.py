"""Materials and what they do in a test."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Literal, Optional, Sequence, Tuple, Union, Unpack, overload

import numpy as np

from . import _arrays, _check, _core, _show
from ._card import Card
from ._options import PredictOptions
from ._result import Result, Tabular
from ._types import Booleans, Floats, Numbers, Path, Progress


class Material(Tabular):
    """A viscoelastic solid: E0, a Poisson ratio and a Prony series.

    Parameters
    ----------
    E0_Pa : float
        Instantaneous Young's modulus.
    nu : float
        Poisson ratio, constant while the modulus relaxes.
    terms : list of (g, tau_s)
        Shares of E0 that relax, and their times.
    rho_kg_m3 : float
        Density; 0: not given.
    name : str
    plausible : "on" or "off"
        "off" accepts a modulus or density that no material has; the material says so.

    Examples
    --------
    >>> material = viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)])
    >>> material.relaxation([0, 1e3])
    array([2000000., 1600000.])
    >>> material.E_inf_Pa
    1600000.0
    """

    @_check.arguments
    def __init__(self, E0_Pa: float, nu: float, *, terms: Sequence[Tuple[float, float]] = (),
                 rho_kg_m3: float = 0.0, name: str = "", plausible: str = "on") -> None:
        if not isinstance(terms, (list, tuple, np.ndarray)):
            raise TypeError(f"terms must be a list of (g, tau_s), such as [(0.2, 1.5)], not {_check.shown(terms)}")
        try:
            rows = [{"g": _arrays.number(g, "g"), "tau_s": _arrays.number(tau_s, "tau_s")} for g, tau_s in terms]
        except (TypeError, ValueError):
            raise TypeError("terms must be a list of (g, tau_s), such as [(0.2, 1.5)], "
                            f"not {_check.shown(terms)}") from None
        text: Dict[str, Any] = {"schema": "viscard-material/1", "name": name, "E0_Pa": float(E0_Pa),
                                "nu": float(nu), "terms": rows}
        if rho_kg_m3:
            text["rho_kg_m3"] = float(rho_kg_m3)
        self._core = _core.material_from_json(json.dumps(text), name or "Material()", plausible)

    @classmethod
    def _of(cls, found: _core.Material) -> "Material":
        material = cls.__new__(cls)
        material._core = found
        return material

    @classmethod
    @_check.arguments
    def load(cls, path: Path, *, plausible: str = "on") -> "Material":
        """Read a material file.

        Examples
        --------
        >>> viscard.Material.load(viscard.data_file("materials/pdms_1to10_seed.json")).nu
        0.495
        """
        return cls._of(_core.read_material(os.fspath(path), plausible))

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the material file; an existing file is kept unless `overwrite` is True."""
        _core.write_file(os.fspath(path), _core.json_from_material(self._core), overwrite)

    def _identity(self) -> Any:
        return self.json

    @property
    def json(self) -> Dict[str, Any]:
        """The material file as a dict: terms, uncertainty, window, flags, provenance."""
        found: Dict[str, Any] = json.loads(_core.json_from_material(self._core))
        return found

    @property
    def moduli(self) -> Dict[str, Any]:
        """Derived moduli in Pa: E0_Pa, E_inf_Pa, G0_Pa, G_inf_Pa, K0_Pa, K_inf_Pa, and arrays of shape (terms,)
        of the branches, G_Pa and E_Pa."""
        return _core.moduli(self._core)

    @property
    def name(self) -> str:
        return str(self.json.get("name", ""))

    @property
    def E0_Pa(self) -> float:
        return float(self.moduli["E0_Pa"])

    @property
    def E_inf_Pa(self) -> float:
        return float(self.moduli["E_inf_Pa"])

    @property
    def nu(self) -> float:
        return float(self.json["nu"])

    @property
    def g(self) -> Floats:
        """Shares of E0 that relax, shape (terms,)."""
        return _arrays.column(self.json["terms"], lambda term: float(term["g"]))

    @property
    def tau_s(self) -> Floats:
        """Relaxation times in s, shape (terms,)."""
        return _arrays.column(self.json["terms"], lambda term: float(term["tau_s"]))

    def _curve(self, kind: str, at: Any, name: str, unit: str, band: bool) -> Any:
        array = _arrays.arguments(at, name, unit)
        found = _core.curve(self._core, kind, array.ravel(), band)
        value, low, high = [part.reshape(array.shape) if part.size == array.size else None for part in found]
        if not band:
            return value if array.ndim or value is None else float(value)
        missing = np.full(array.shape, np.nan)
        return value, missing if low is None else low, missing if high is None else high

    @overload
    def relaxation(self, time_s: float, *, band: Literal[False] = ...) -> float: ...
    @overload
    def relaxation(self, time_s: Numbers, *, band: Literal[False] = ...) -> Floats: ...
    @overload
    def relaxation(self, time_s: Union[float, Numbers], *, band: Literal[True]) -> Tuple[Floats, Floats, Floats]: ...
    @_check.arguments
    def relaxation(self, time_s: Any, *, band: bool = False) -> Any:
        """E(t) in Pa, in the shape of `time_s` (s).

        band : bool
            Return (value, low, high) with the 95 % band of the fit; NaN for a material without one.

        Examples
        --------
        >>> material = viscard.Material.load(viscard.data_file("materials/pdms_1to10_seed.json"))
        >>> bool(material.relaxation(0.0) > material.relaxation(10.0))
        True
        """
        return self._curve("relaxation", time_s, "time_s", "s", band)

    @overload
    def creep(self, time_s: float, *, band: Literal[False] = ...) -> float: ...
    @overload
    def creep(self, time_s: Numbers, *, band: Literal[False] = ...) -> Floats: ...
    @overload
    def creep(self, time_s: Union[float, Numbers], *, band: Literal[True]) -> Tuple[Floats, Floats, Floats]: ...
    @_check.arguments
    def creep(self, time_s: Any, *, band: bool = False) -> Any:
        """J(t) in 1/Pa, the exact inverse of E(t), in the shape of `time_s` (s).

        Examples
        --------
        >>> viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).creep(0.0)
        5e-07
        """
        return self._curve("creep", time_s, "time_s", "s", band)

    @overload
    def storage(self, frequency_Hz: float, *, band: Literal[False] = ...) -> float: ...
    @overload
    def storage(self, frequency_Hz: Numbers, *, band: Literal[False] = ...) -> Floats: ...
    @overload
    def storage(self, frequency_Hz: Union[float, Numbers], *, band: Literal[True]) -> Tuple[Floats, Floats, Floats]: ...
    @_check.arguments
    def storage(self, frequency_Hz: Any, *, band: bool = False) -> Any:
        """Storage modulus E' in Pa, in the shape of `frequency_Hz` (Hz).

        Examples
        --------
        >>> viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).storage([1e-9, 1e9]).round()
        array([1600000., 2000000.])
        """
        return self._curve("storage", frequency_Hz, "frequency_Hz", "Hz", band)

    @overload
    def loss(self, frequency_Hz: float, *, band: Literal[False] = ...) -> float: ...
    @overload
    def loss(self, frequency_Hz: Numbers, *, band: Literal[False] = ...) -> Floats: ...
    @overload
    def loss(self, frequency_Hz: Union[float, Numbers], *, band: Literal[True]) -> Tuple[Floats, Floats, Floats]: ...
    @_check.arguments
    def loss(self, frequency_Hz: Any, *, band: bool = False) -> Any:
        """Loss modulus E'' in Pa, in the shape of `frequency_Hz` (Hz).

        Examples
        --------
        >>> import numpy as np
        >>> round(viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).loss(1 / (2 * np.pi)))
        200000
        """
        return self._curve("loss", frequency_Hz, "frequency_Hz", "Hz", band)

    @overload
    def tan_delta(self, frequency_Hz: float) -> float: ...
    @overload
    def tan_delta(self, frequency_Hz: Numbers) -> Floats: ...
    def tan_delta(self, frequency_Hz: Any) -> Any:
        """Loss over storage modulus, in the shape of `frequency_Hz` (Hz).

        Examples
        --------
        >>> import numpy as np
        >>> f"{viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).tan_delta(1 / (2 * np.pi)):.4f}"
        '0.1111'
        """
        return self.loss(frequency_Hz) / self.storage(frequency_Hz)

    def _window(self, at: Any, name: str) -> Floats:
        """Where a curve is drawn: two decades beyond the times of the terms."""
        if at is not None:
            return np.atleast_1d(_arrays.arguments(at, name, name.rsplit("_", 1)[1]))
        times = self.tau_s if len(self.tau_s) else np.array([1.0])
        window = np.geomspace(1e-2 * times.min(), 1e2 * times.max(), 300)
        return window if name == "time_s" else 1.0 / (2.0 * np.pi * window[::-1])

    @_check.arguments
    def plot(self, kind: str = "relaxation", at: Optional[Numbers] = None, *, ax: Any = None) -> Any:
        """Draw a curve of the material with its 95 % band. Needs matplotlib. Returns the axes.

        Parameters
        ----------
        kind : "relaxation", "creep", "storage", "loss" or "tan_delta"
        at : array
            Times in s or frequencies in Hz. Default: two decades beyond the times of the terms.
        ax : matplotlib axes
            Default: new ones.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).plot("tan_delta").get_ylabel()
        'loss factor'
        """
        from ._plot import plot_material

        return plot_material(self, kind, at, ax)

    def _table(self) -> _show.Columns:
        rows = [("E0_Pa", self.E0_Pa), ("E_inf_Pa", self.E_inf_Pa), ("nu", self.nu)]
        for i, (g, tau) in enumerate(zip(self.g, self.tau_s), 1):
            rows += [(f"g_{i}", g), (f"tau_{i}_s", tau)]
        flags = [f"{flag['name']}: {flag['text']}" for flag in self.json.get("flags", [])]
        return _show.of_rows(self.name or "material", ("name", "value"), rows, flags)

    @_check.arguments
    def at_temperature(self, temperature_C: float) -> "Material":
        """The material at another temperature, by its temperature shift (degrees Celsius)."""
        return Material._of(_core.material_at_temperature(self._core, float(temperature_C)))

    @_check.arguments
    def card(self, target: str, units: str = "SI", *, terms: Optional[int] = None,
             approximate: bool = False, accept_flags: bool = False, clamp_nu: Optional[float] = None,
             bound: str = "", elastic_only: str = "", temperature_C: Optional[float] = None,
             reproducible: bool = False, plausible: str = "on") -> Card:
        """Write a material card for a solver, read it back and compare.

        Parameters
        ----------
        target : str
            One of `card_targets()`.
        units : str
            Unit system of the card, such as "SI" or "mm-t-s".
        terms, approximate, accept_flags, clamp_nu, bound, elastic_only, temperature_C, reproducible, plausible
            As in ``viscard card --help``.

        Examples
        --------
        >>> print(viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).card("febio", "mm-t-s").n_terms)
        1
        """
        words = {"terms": _arrays.whole(terms, "terms", 0), "approximate": approximate, "accept_flags": accept_flags,
                 "clamp_nu": clamp_nu, "bound": bound, "elastic_only": elastic_only,
                 "temperature_C": temperature_C, "reproducible": reproducible,
                 "plausible": plausible}
        return Card(_core.card(self._core, target, units, words))

    @_check.arguments
    def validate(self, *, max_error: float = 1e-6, progress: Progress = None) -> "Validation":
        """Run a pillar of the material in relaxation and in creep beside the exact answers, as ``viscard validate`` does.

        Parameters
        ----------
        max_error : float
            Largest relative error allowed.
        progress : function of (fraction, step)

        Examples
        --------
        >>> viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).validate().passed
        True
        """
        return Validation(_core.validate(self._core, float(max_error), progress))

    def predict(self, **options: Unpack[PredictOptions]) -> "Prediction":
        """What the material does in a test; the keywords are those of `viscard.predict`."""
        return predict(self, **options)

    def __reduce__(self) -> Tuple[Any, ...]:
        return (_from_json, (_core.json_from_material(self._core),))

    def __repr__(self) -> str:
        n = len(self.g)
        return f"<viscard.Material {self.name or 'without a name'}: E0 {self.E0_Pa:.4g} Pa, {n} term{'' if n == 1 else 's'}>"


def _from_json(text: str) -> Material:
    return Material._of(_core.material_from_json(text, "material", "on"))


class Validation(Result):
    """A pillar of a material beside the exact answers.

    Attributes
    ----------
    passed : bool
        Both tests are within max_error.
    relaxation, creep : dict
        largest_relative_error, at_time_s, solver_error_estimate, steps, and arrays over time_s: stress_Pa (relaxation) or
        displacement_m (creep), with their exact_ values.

    Examples
    --------
    >>> found = viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).validate()
    >>> found.relaxation["largest_relative_error"] < 1e-6
    True
    """

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        self.passed: bool = self.values["passed"]
        self.relaxation: Dict[str, Any] = self.values["relaxation"]
        self.creep: Dict[str, Any] = self.values["creep"]

    def _table(self) -> _show.Columns:
        heads = ("test", "largest_relative_error", "at_time_s", "solver_error_estimate", "steps")
        return _show.of_dicts(f"pillar of {self['material']}: " + ("passed" if self.passed else "not passed"), heads,
                              [{"test": "relaxation", **self.relaxation}, {"test": "creep", **self.creep}])

    def __repr__(self) -> str:
        return f"<viscard.Validation of {self['material']}: {'passed' if self.passed else 'not passed'}>"


class Prediction(Result):
    """A predicted test.

    Attributes
    ----------
    at : array, shape (rows,)
        `argument` names it: "time_s" or "frequency_Hz".
    curves : dict of array, shape (rows,)
        Input and answers by name with unit, such as "stress_Pa" and "strain"; `low` and `high` hold the 95 % band, if there is one.
    inside : array of bool, shape (rows,)
        The window of the fit.
    agreement : list of dict
        With measured values, from `against`.
    notes : list of str
    json : dict
        As ``viscard predict --json``.

    Examples
    --------
    >>> found = viscard.predict(viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]), test="creep", stress="1 kPa",
    ...                         hold="10 s")
    >>> found.at.shape == found.curves["strain"].shape
    True
    """

    def __init__(self, core: _core.Result) -> None:
        super().__init__(core)
        columns = dict(self.values["curve"])
        self.inside: Booleans = columns.pop("inside_window")
        self.argument: str = next(iter(columns))
        self.at: Floats = columns.pop(self.argument)
        self.low: Dict[str, Floats] = {n[:-7]: values for n, values in columns.items() if n.endswith("_low_95")}
        self.high: Dict[str, Floats] = {n[:-8]: values for n, values in columns.items() if n.endswith("_high_95")}
        self.curves: Dict[str, Floats] = {n: values for n, values in columns.items() if not n.endswith(("_low_95", "_high_95"))}
        self.agreement: List[Dict[str, Any]] = self.values.get("against", {}).get("quantities", [])
        self.notes: List[str] = self.values["notes"]

    def _table(self) -> _show.Columns:
        columns: Dict[str, Any] = {self.argument: self.at, **self.curves}
        columns.update({f"{name}_low_95": values for name, values in self.low.items()})
        columns.update({f"{name}_high_95": values for name, values in self.high.items()})
        return _show.Columns("prediction", {**columns, "inside_window": self.inside}, self.notes)

    def plot(self, ax: Any = None) -> Any:
        """Draw the curves with their 95 % bands over time or frequency. Needs matplotlib. Returns the axes.

        Examples
        --------
        >>> import matplotlib; matplotlib.use("agg")
        >>> viscard.predict(viscard.data_file("materials/pdms_1to10_seed.json"), test="creep").plot().get_xlabel()
        'time (s)'
        """
        from ._plot import plot_prediction

        return plot_prediction(self, ax)

    def __repr__(self) -> str:
        return f"<viscard.Prediction of {', '.join(self.curves)}: {len(self.at)} rows>"


@_check.arguments
def predict(material: Union[Material, Path], **options: Unpack[PredictOptions]) -> Prediction:
    """Predict what a material does in a test, with its 95 % band.

    Quantities are texts with a unit ("10 kPa") or numbers in SI; from_ is --from. `history` and `against` take a path, a
    dict of arrays by header with unit, a Table or a DataFrame; rows without a number are left out, and the notes count them.

    Parameters
    ----------
    material : Material or path
    **options

    Examples
    --------
    >>> found = viscard.predict(viscard.data_file("materials/pdms_1to10_seed.json"), test="oscillation", from_=0.1, to=10)
    >>> sorted(found.curves)
    ['loss_modulus_Pa', 'storage_modulus_Pa', 'tan_delta']
    """
    keywords: Dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    plausible = options.get("plausible") or "on"
    tables = {}
    for name in ("history", "against"):
        if _arrays.is_table(keywords.get(name)):
            tables[name] = _arrays.table(keywords[name], name)
            keywords[name] = name
        elif name in keywords:
            _arrays.path_of(keywords[name], name, _arrays.OR_TABLE)
    one = material if isinstance(material, Material) else Material.load(_arrays.path_of(material, "material", " or a Material"), plausible=plausible)
    inputs = [os.fspath(path) for path in (material, options.get("history"), options.get("against"))
              if isinstance(path, (str, os.PathLike))]
    return Prediction(_core.predict(one._core, keywords, tables, inputs))
