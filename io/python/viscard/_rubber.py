"""Laws of rubber from tests at large strain."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _arrays, _check, _core, _show
from ._types import Floats, Numbers, Path
from ._error import Error
from ._fit_result import Flag, of_fit
from ._result import Compared, Parameter, Tabular


class RubberTerm(NamedTuple):
    """A term of relaxation beside a law: share of the instantaneous stress and time, with 95 % intervals.

    Examples
    --------
    >>> viscard.RubberTerm(0.2, (0.19, 0.21), 1.5, (1.4, 1.6)).tau_s
    1.5
    """

    g: float
    g_interval: Tuple[float, float]
    tau_s: float
    tau_s_interval: Tuple[float, float]


class RubberCard(Compared):
    """The card of a law of rubber for a solver; ``print(card)`` shows it.

    Attributes
    ----------
    text : str
    target : str

    Examples
    --------
    >>> rubber = viscard.fit(["uniaxial=" + viscard.data_file("reference/treloar_uniaxial.csv")], model="yeoh")
    >>> "*HYPERELASTIC, YEOH" in rubber.card("abaqus", "mm-t-s").text
    True
    """

    def __init__(self, text: str, target: str) -> None:
        self.text = text
        self.target = target

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the card; an existing file is kept unless `overwrite` is True."""
        _core.write_file(os.fspath(path), self.text, overwrite)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<viscard.RubberCard for {self.target}, {len(self.text.splitlines())} lines>"


class RubberFit(Tabular):
    """The law of rubber that describes tests at large strain best, of ``fit(["uniaxial=a.csv", ...])``.

    ``rubber["key"]`` gives every key of ``viscard fit --json``.

    Attributes
    ----------
    law : str
        Name of the chosen law, such as "yeoh".
    E0_Pa : float
        Young's modulus at rest; with terms, at once.
    E0_interval : (low, high)
        95 %, Pa.
    E_inf_Pa : float
        Young's modulus at rest after all relaxation; E0_Pa without terms.
    E_inf_interval : (low, high)
        95 %, Pa.
    terms : list of RubberTerm
        Relaxation beside the law, of tests with times; empty for an elastic law.
    series_covariance : array
        Of the parameters, the g and the ln tau_s, in that order; empty without terms.
    parameters : dict of Parameter
        Of the chosen law, by name.
    damage : dict of Parameter
        r, m_Pa and beta of the softening by the first loading (``model="yeoh+mullins-or"``); empty without it.
    covariance : array, shape (parameters, parameters)
        In the units of the parameters.
    laws : dict of dict
        All laws that were tried, by name, with their parameters, BIC and flags.
    tests : list of (stretch, nominal_stress_Pa)
        The fitted readings, arrays of shape (readings,); empty for a law that was loaded.
    times : list of array
        time_s of the readings; arrays of no length for tests without times.
    fitted, residuals : list of array
        Nominal stress of the law, with its terms or damage, at the readings; and measured minus fitted, Pa.
    flags : list of Flag
        Of the chosen law, and notes about the data.
    is_trustworthy : bool
    json : dict

    Examples
    --------
    >>> rubber = viscard.fit(["uniaxial=" + viscard.data_file("reference/treloar_uniaxial.csv"),
    ...                       "planar=" + viscard.data_file("reference/treloar_planar.csv")], model="ogden-2")
    >>> rubber.law, list(rubber.parameters)
    ('ogden-2', ['mu_1_Pa', 'mu_2_Pa', 'alpha_1', 'alpha_2'])
    >>> low, high = rubber.parameters["alpha_2"].interval
    >>> bool(low < rubber.parameters["alpha_2"].value < high)
    True
    """

    def __init__(self, text: str, name: str, summary: str, tests: "list[Tuple[Floats, Floats]]",
                 times: "Sequence[Floats]" = (), fitted: "Sequence[Floats]" = ()) -> None:
        self._text, self._name, self._summary = text, name, summary
        self.json: Dict[str, Any] = json.loads(text)
        inputs = [test["file"] for test in self.json["tests"]]
        self.json = _arrays.with_head(self.json["schema"], inputs, self.json)
        self.tests = tests
        self.times, self.fitted = list(times), list(fitted)
        self.law: str = self.json["law"]
        self.laws: Dict[str, Dict[str, Any]] = {law["name"]: law for law in self.json["laws"]}
        chosen = self.laws[self.law]
        self.E0_Pa: float = chosen["E0_Pa"]
        self.E0_interval = _arrays.pair(chosen["E0_interval_95"])
        self.E_inf_Pa: float = chosen.get("E_inf_Pa", self.E0_Pa)  # files of elastic laws may lack these
        self.E_inf_interval = _arrays.pair(chosen.get("E_inf_interval_95", chosen["E0_interval_95"]))
        self.terms = [RubberTerm(one["g"], _arrays.pair(one["g_interval_95"]), one["tau_s"],
                                 _arrays.pair(one["tau_s_interval_95"])) for one in chosen.get("terms", [])]
        self.series_covariance: Floats = np.array(chosen.get("series_covariance", []), dtype=float)
        self.parameters = {one["name"]: Parameter(one["name"], one["value"], _arrays.pair(one["interval_95"]))
                           for one in chosen["parameters"]}
        self.damage = {one["name"]: Parameter(one["name"], one["value"], _arrays.pair(one.get("interval_95")))
                       for one in chosen.get("damage", {}).get("parameters", [])}
        self.covariance: Floats = np.array(chosen["covariance"], dtype=float)
        self.flags: List[Flag] = [Flag(f["name"], f.get("term", 0), f["text"])
                                  for f in chosen["flags"] + self.json["flags"]]
        self.is_trustworthy: bool = self.json["trustworthy"]

    @classmethod
    @_check.arguments
    def load(cls, path: Path) -> "RubberFit":
        """The law of a file that `save` or ``viscard fit uniaxial=a.csv --out`` has written."""
        name = os.fspath(path)
        return cls(_core.text_of_rubber(name), name, "", [])

    @property
    def _law(self) -> _core.Rubber:
        """The compiled law; refused if a fit that is not to be trusted has no stiffness at rest."""
        return _core.rubber_from_json(self._text, self._name)

    def _identity(self) -> Any:
        return self.json

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

    @property
    def residuals(self) -> List[Floats]:
        return [np.asarray(stress - law) for (_, stress), law in zip(self.tests, self.fitted)]

    @_check.arguments
    def stress(self, stretch: Union[float, Numbers], deformation: str = "uniaxial", *, time_s: Optional[Numbers] = None) -> Floats:
        """Nominal stress in Pa (force over area at rest) at these stretches, shape of `stretch`.

        Without `time_s` it is that of the law at once. With `time_s` the stretches are a history, linear
        between its times and at rest before the first, and the terms relax. Of a law with damage the
        stretches are always a path from rest, in their order.

        Parameters
        ----------
        stretch : array
            Length over length at rest, above 0; NaN beyond the limit of a law that has one.
        deformation : "uniaxial", "planar" or "equibiaxial"
            Of a foam also "confined", "volumetric" and "shear" (then `stretch` is the tangent of the angle).
        time_s : array
            Of the shape of `stretch`; times do not decrease. Two equal times are a jump.

        Examples
        --------
        >>> rubber = viscard.fit(["uniaxial=" + viscard.data_file("reference/treloar_uniaxial.csv")], model="neo-hooke")
        >>> C10 = rubber.parameters["C10_Pa"].value
        >>> bool(abs(rubber.stress(2.0) - 2 * C10 * (2 - 1 / 2**2)) < 1e-6)
        True
        """
        at = _arrays.numbers(stretch, "stretch")
        if deformation != "shear" and not np.all(at > 0.0):
            raise Error("stretch must be above 0", "input")
        times = None if time_s is None else _arrays.numbers(time_s, "time_s")
        if times is not None and times.shape != at.shape:
            raise Error(f"time_s has the shape {times.shape}, but stretch {at.shape}", "input")
        times = times if times is None else times.ravel()
        return _core.rubber_stress(self._law, deformation, at.ravel(), times).reshape(at.shape)

    @_check.arguments
    def card(self, target: str, units: str = "SI", *, bulk_modulus_Pa: Optional[float] = None,
             density_kg_m3: Optional[float] = None, accept_flags: bool = False, approximate: bool = False,
             elastic_only: str = "", plausible: str = "on") -> RubberCard:
        """A card for a solver: "abaqus", "ansys", "calculix", "comsol", "febio", "frontistr", "lsdyna", "mfront", "moose",
        "openradioss" or "sfepy".

        Parameters
        ----------
        target, units : str
            Names of ``viscard card``.
        bulk_modulus_Pa : float
            Default: incompressible for abaqus and ansys, a thousand times the shear modulus for the others.
        density_kg_m3 : float
            LS-DYNA and OpenRadioss need it.
        accept_flags : bool
            Write a law that is not to be trusted too.
        approximate : bool
            Write terms of relaxation that the solver ("lsdyna") takes right at small strain only.
        elastic_only : str
            "instantaneous" or "long-term": the law without its terms. "abaqus", "ansys", "febio", "openradioss" and
            "sfepy" take them, "lsdyna" with `approximate`, the others not.
        plausible : "on" or "off"
            "off" accepts any bulk modulus and density.
        """
        text = _core.rubber_card(self._law, self._name, target, units, bulk_modulus_Pa, density_kg_m3,
                                 accept_flags, approximate, elastic_only, plausible)
        return RubberCard(text, target)

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the file that ``viscard card`` reads; an existing one is kept unless `overwrite` is True."""
        _core.write_file(os.fspath(path), self._text, overwrite)

    def summary(self) -> str:
        """The text of ``viscard fit``: tests, laws, parameters, flags. Of a loaded law: one line."""
        return self._summary or repr(self)

    def plot(self, ax: Any = None) -> Any:
        """Nominal stress against stretch: the readings and the law. Needs matplotlib. Returns the axes."""
        from ._plot import plot_rubber

        return plot_rubber(self, ax)

    def to_frame(self) -> Any:
        """The readings as a DataFrame of pandas: test, time_s (NaN without times), stretch, measured, fitted, residual, in
        Pa. Of a law that was loaded it has no rows."""
        rows: Dict[str, List[Any]] = {name: [] for name in ("test", "time_s", "stretch", "measured", "fitted", "residual")}
        for of, (stretch, stress), time_s, law in zip(self.json["tests"], self.tests, self.times, self.fitted):
            rows["test"] += [of["name"]] * len(stretch)
            rows["time_s"] += list(time_s) if len(time_s) else [np.nan] * len(stretch)
            for name, values in (("stretch", stretch), ("measured", stress), ("fitted", law), ("residual", stress - law)):
                rows[name] += list(values)
        return _show.frame(rows)

    def _table(self) -> _show.Columns:
        rows = [Parameter("E0_Pa", self.E0_Pa, self.E0_interval), *self.parameters.values(), *self.damage.values()]
        for i, term in enumerate(self.terms, 1):
            rows += [Parameter(f"g_{i}", term.g, term.g_interval), Parameter(f"tau_{i}_s", term.tau_s, term.tau_s_interval)]
        return of_fit(f"{self._name}: {self.law}", rows, self.flags, self.is_trustworthy)

    def __repr__(self) -> str:
        low, high = self.E0_interval
        doubt = "" if self.is_trustworthy else ", not to be trusted"
        return (f"<viscard.RubberFit {self._name}: {self.law}, E0 {self.E0_Pa:.4g} Pa "
                f"(95 % {low:.4g} to {high:.4g}){doubt}>")
