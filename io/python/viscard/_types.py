"""What arguments may be, and what arrays are."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Iterable, Mapping, Optional, Protocol, Sequence, TypedDict, Union

import numpy as np

if TYPE_CHECKING:
    from ._table import Capture

Path = Union[str, os.PathLike[str]]
OptionalPath = Union[str, os.PathLike[str], None]
Scene = Union[str, os.PathLike[str], Mapping[str, object]]
Quantity = Union[str, float, None]
Texts = Union[str, Sequence[str], None]
Progress = Optional[Callable[[float, str], object]]

Floats = np.ndarray[Any, np.dtype[np.float64]]
Booleans = np.ndarray[Any, np.dtype[np.bool_]]
Integers = np.ndarray[Any, np.dtype[np.int64]]


class HasArray(Protocol):
    """An array of numpy, a Series of pandas, and others that numpy reads."""

    def __array__(self) -> np.ndarray[Any, Any]: ...


Numbers = Union[HasArray, Sequence[float], Sequence[Sequence[float]]]
Column = Union[HasArray, Sequence[Optional[float]]]


class HasColumns(Protocol):
    """A dict of arrays by header with unit, or a DataFrame of pandas."""

    def keys(self) -> Iterable[str]: ...
    def __getitem__(self, header: str, /) -> Column: ...


class HasValues(Protocol):
    """Values by key of a scene: a dict of lists or arrays, or a DataFrame of pandas."""

    def keys(self) -> Iterable[str]: ...
    def __getitem__(self, key: str, /) -> Union[HasArray, Sequence[float], Sequence[str]]: ...


# What holds a table: a path, arrays, a Table.
TableLike = Union[str, os.PathLike[str], HasColumns]
OptionalTable = Union[TableLike, None]
Source = Union[TableLike, "Capture"]
Sources = Union[Source, Sequence[Source]]


class Tests(TypedDict, total=False):
    """Tests of one material by kind, which are fitted together."""

    relaxation: Sources
    creep: Sources
    dma: Sources
    oscillation: Sources
    indentation: Sources


class RubberTests(TypedDict, total=False):
    """Tests of rubber at large strain by kind, which give one law."""

    uniaxial: Sources
    tension: Sources
    compression: Sources
    planar: Sources
    equibiaxial: Sources
    biaxial: Sources
