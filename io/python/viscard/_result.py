"""What all results have."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Dict


class Result:
    """A result of the compiled part. ``result["key"]`` gives every key of ``--json``.

    Attributes
    ----------
    json : dict
        What the command prints with ``--json``.
    values : dict
        The same with arrays of numpy and intervals as (low, high); a number that does not exist is NaN.
    """

    def __init__(self, core) -> None:
        self._core = core

    @cached_property
    def json(self) -> Dict[str, Any]:
        return self._core.json()

    @cached_property
    def values(self) -> Dict[str, Any]:
        return self._core.values()

    def __getitem__(self, key: str) -> Any:
        return self.json[key]

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


def _places(values, key):
    """The values of a key: at the top, or else in objects below."""
    if key in values:
        yield values[key]
        return
    for below in values.values():
        if isinstance(below, dict):
            yield from _places(below, key)
