"""What all results have."""

from __future__ import annotations

import json as _json
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Dict, Iterator, NamedTuple, Tuple

import numpy as np

from . import _check, _show


class Parameter(NamedTuple):
    """A parameter of a law with its 95 % interval, in the unit that its name states.

    Examples
    --------
    >>> viscard.Parameter("C10_Pa", 2e5, (1.9e5, 2.1e5)).value
    200000.0
    """

    name: str
    value: float
    interval: Tuple[float, float]


class _Kept:
    """What the compiled part gives of a result, kept as values: of a result that was pickled."""

    def __init__(self, json: Dict[str, Any], values: Dict[str, Any], text: str) -> None:
        self._json, self._values, self._text = json, values, text

    def json(self) -> Dict[str, Any]:
        return self._json

    def values(self) -> Dict[str, Any]:
        return self._values

    def text(self) -> str:
        return self._text


def plain(value: Any) -> Any:
    """The same as dicts, lists, numbers and texts, which can be compared as a whole: NaN becomes None, an array its bytes."""
    if isinstance(value, np.ndarray):
        return plain(value.tolist()) if value.dtype.hasobject else [value.shape, value.dtype.str, value.tobytes().hex()]
    if isinstance(value, Compared):
        return value._identity()
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    return None if isinstance(value, float) and value != value else value


class Compared:
    """Equal to another of its class if all its values are, such as a copy."""

    def _identity(self) -> Any:
        return plain({name: value for name, value in vars(self).items() if name != "_core"})

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Compared) or type(other) is not type(self):
            return NotImplemented
        return bool(self._identity() == other._identity())

    def __hash__(self) -> int:
        return hash(_json.dumps(self._identity(), sort_keys=True))


class Shown:
    """What has a table: notebooks show it, and `to_frame` returns it."""

    def _table(self) -> _show.Columns:
        raise NotImplementedError

    def _repr_html_(self) -> str:
        return _show.html_of(self._table())

    def to_frame(self) -> Any:
        """The table that a notebook shows, with all rows, as a DataFrame of pandas."""
        return _show.frame(self._table().columns)


class Tabular(Shown, Compared):
    """What has a table and can be compared."""


class Result(Tabular):
    """A result of the compiled part. ``result["key"]`` gives every key of ``--json``.

    Results can be pickled and copied, so that ``multiprocessing`` can return them; two are equal if all their keys are.

    Attributes
    ----------
    json : dict
        What the command prints with ``--json``.
    values : dict
        The same with arrays of numpy and intervals as (low, high); a number that does not exist is NaN.
    """

    def __init__(self, core: Any) -> None:
        self._core = core

    @cached_property
    def json(self) -> Dict[str, Any]:
        found: Dict[str, Any] = self._core.json()
        return found

    @cached_property
    def values(self) -> Dict[str, Any]:
        found: Dict[str, Any] = self._core.values()
        return found

    def _identity(self) -> Any:
        return self.json

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_core": _Kept(self.json, self.values, self._core.text())}

    @_check.arguments
    def find(self, name: str) -> Any:
        """The value of a key, wherever it stands, or of a path such as "terms.0.tau_s".

        Raises KeyError if there is none, or several that differ in their place.
        """
        at: Any = self.values
        first, *rest = name.split(".")
        places = list(_places(at, first))
        if len(places) != 1:
            raise KeyError(f"there is no '{name}'" if not places else f"'{name}' stands in {len(places)} places; give a path")
        at = places[0]
        for part in rest:
            try:
                at = at[int(part)] if isinstance(at, (list, tuple)) else at[part]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(f"there is no '{name}': '{part}' is missing") from None
        return at


def _places(values: Dict[str, Any], key: str) -> Iterator[Any]:
    """The values of a key: at the top, or else in objects below."""
    if key in values:
        yield values[key]
        return
    for below in values.values():
        if isinstance(below, dict):
            yield from _places(below, key)
