"""What all results have."""

from __future__ import annotations

import json as _json
from functools import cached_property
from typing import Any, Dict, Iterator, NamedTuple, Tuple


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


class Compared:
    """Equal to another of its class if all keys are."""

    json: Any

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Compared) or type(other) is not type(self):
            return NotImplemented
        return bool(self.json == other.json)

    def __hash__(self) -> int:
        return hash(_json.dumps(self.json, sort_keys=True))


class Result(Compared):
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

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_core": _Kept(self.json, self.values, self._core.text())}

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
