"""Which test to make: error against time at the rig."""

from __future__ import annotations

import os
from typing import Any, Dict, List, Sequence, Union

from . import _check, _core
from ._check import OptionalPath, Path
from ._result import Result


class TestCost(Result):
    """Tests compared by their errors and their time at the rig.

    Attributes
    ----------
    rows : list of dict
        One for each test on the front, by time; the keys are those of `viscard cost --rig --json`.
    advice : str
        The test to make, in a sentence.
    test : str
        That test as a test file, for `viscard.capture(test=...)`; empty if there is none.
    json : dict
        What `viscard cost --rig --json` prints.

    Examples
    --------
    >>> rig, specimen = viscard.data_file("demo/01_rig.toml"), viscard.data_file("demo/03_pdms_1to10.toml")
    >>> found = viscard.cost_of_tests(rig, specimen, "E0=10%", at_most="2 min")
    >>> [row["touches"] for row in found.rows if row["pareto"]][:1]
    [1]
    """

    __test__ = False  # for pytest

    def __init__(self, found: Dict[str, Any]):
        super().__init__(found["result"])
        self.rows: List[Dict[str, Any]] = self.json["rows"]
        self.advice: str = self.json["text"]
        self.test: str = found["test"]

    def __repr__(self) -> str:
        return f"TestCost({len(self.rows)} tests: {self.advice})"


@_check.arguments
def cost_of_tests(rig: Path, specimen: Path, want: Union[str, Sequence[str]], *, test: OptionalPath = None,
                  guess: OptionalPath = None, scene: OptionalPath = None,
                  at_most: Union[str, float] = "60min") -> TestCost:
    """Compare tests on a rig before one is made, by what they will find and how long they take.

    Parameters
    ----------
    rig, specimen : path
        The section [performance] of the rig file has the noise of a reading.
    want : str or list of str
        Quantities with the relative half-width of their 95 % intervals: "E0=1%", "g_2=5%", or a result of the scene.
    test : path
        A test to compare with; its approach and retraction are kept.
    guess : path
        Material file of a similar material. Default: what the specimen file guesses.
    scene : path
        Whose results may be wanted, such as "electrode_voltage=3%".
    at_most : str or float
        Longest time at the rig, such as "20 min" or seconds.

    Examples
    --------
    >>> rig, specimen = viscard.data_file("demo/01_rig.toml"), viscard.data_file("demo/03_pdms_1to10.toml")
    >>> found = viscard.cost_of_tests(rig, specimen, "E0=10%", at_most="2 min")
    >>> len(found.rows) > 0, "E0" in found.advice, 'protocol = "ramp-hold"' in found.test
    (True, True, True)
    """
    words = [want] if isinstance(want, str) else list(want)

    optional = [None if one is None else os.fspath(one) for one in (test, guess, scene)]
    return TestCost(_core.cost_of_tests(os.fspath(rig), os.fspath(specimen), words, *optional, at_most))
