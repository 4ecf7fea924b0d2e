"""Material cards for solvers."""

from __future__ import annotations

import pathlib
from typing import Any, Dict, List, NamedTuple, Tuple

from . import _check, _core
from ._result import Compared
from ._types import Path


class Fidelity(NamedTuple):
    """How one part of the material was written; mapping: "exact", "approximated" or "dropped"."""

    item: str
    mapping: str
    text: str


class Card(Compared):
    """A material card for a solver; ``print(card)`` shows it.

    Attributes
    ----------
    text : str
    companions : list of (suffix, text)
        Files beside the card, which `save` writes too.
    fidelity : list of Fidelity
        What was written exactly, approximated or dropped.
    n_terms : int
    largest_difference : float
        Of E(t) as a reader of the card gets it, relative, over the window of the fit.

    Examples
    --------
    >>> card = viscard.Material(2e6, 0.49, terms=[(0.2, 1.0)]).card("abaqus", "mm-t-s")
    >>> "*VISCOELASTIC" in card.text.upper()
    True
    >>> card.largest_difference < 1e-6
    True
    """

    def __init__(self, found: Dict[str, Any]) -> None:
        self.text: str = found["text"]
        self.companions: List[Tuple[str, str]] = found["companions"]
        self.fidelity = [Fidelity(*row) for row in found["fidelity"]]
        self.n_terms: int = found["n_terms"]
        self.largest_difference: float = found["largest_difference"]

    @_check.arguments
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Write the card and its companions; existing files are kept unless `overwrite` is True."""
        to = pathlib.Path(path)
        _core.write_file(str(to), self.text, overwrite)
        for suffix, text in self.companions:
            _core.write_file(str(to.with_suffix("")) + suffix, text, overwrite)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<viscard.Card of {self.n_terms} terms, {len(self.text.splitlines())} lines>"


def card_targets() -> "list[str]":
    """The names of the solvers that cards are written for.

    Examples
    --------
    >>> "abaqus" in viscard.card_targets()
    True
    """
    return _core.card_targets()
