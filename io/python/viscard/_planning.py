"""Which test to make: error against time at the rig."""

from __future__ import annotations

import os
import warnings
from typing import Any, Dict, List, Sequence, TypedDict, Union, Unpack

from . import _arrays, _check, _core, _show
from ._error import DoubtWarning, Error
from ._options import FitOptions
from ._types import OptionalPath, Path, Progress, Texts
from ._result import Result, Shown
from ._table import Capture


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

    def _table(self) -> _show.Columns:
        quantities = {one["quantity"]: f"{one['quantity']}_half_width_95" for one in self.json["wanted"]}
        rows = [{**row, **{quantities.get(one["quantity"], one["quantity"]): one["half_width_95"] for one in row["errors"]}}
                for row in self.rows]
        heads = ["time_s", "touches", "protocol", "depth_m", "ramp_s", "hold_s", "recovery_s", "pareto", *quantities.values()]
        return _show.of_dicts("tests by their time", heads, rows, [self.advice, *self.json["limits"]])

    def __repr__(self) -> str:
        return f"TestCost({len(self.rows)} tests: {self.advice})"


class NextTest(TypedDict):
    """What may be measured next, and how it narrows the 95 % interval of a quantity; of `next_test`.

    Examples
    --------
    >>> sorted(viscard.NextTest.__annotations__)
    ['half_width_95', 'half_width_95_after', 'how', 'minutes', 'quantity', 'what']
    """

    what: str
    how: str
    quantity: str
    half_width_95: float
    half_width_95_after: float
    minutes: float


class NextTests(Shown, List[NextTest]):
    """What may be measured next, best first: a list of `NextTest`, with a table.

    Examples
    --------
    >>> capture = viscard.capture("run.viscap", emulate=True, speed=500).read()
    >>> tests = viscard.next_test(capture, "E0=1%")
    >>> len(tests) > 0 and tests[0]["minutes"] > 0
    True
    """

    def _table(self) -> _show.Columns:
        heads = ("what", "quantity", "half_width_95", "half_width_95_after", "minutes", "how")
        return _show.of_dicts("what to measure next", heads, self)


@_check.arguments
def next_test(capture: Union[Path, Capture], want: Union[str, Sequence[str]], **options: Unpack[FitOptions]) -> NextTests:
    """What to measure next after a capture: what narrows the widest interval most for a minute at the rig, best first.

    Parameters
    ----------
    capture : path or Capture
    want : str or list of str
        Quantities with the relative half-width of their 95 % intervals: "E0=5%", "g_2=10%".
    **options

    Returns
    -------
    NextTests, a list of dict
        what, how (a command, or empty), quantity, half_width_95 now and half_width_95_after (relative), minutes.

    Examples
    --------
    >>> capture = viscard.capture("run.viscap", emulate=True, speed=500).read()
    >>> best = viscard.next_test(capture, "E0=1%")[0]
    >>> best["half_width_95_after"] < best["half_width_95"]
    True
    """
    words = [want] if isinstance(want, str) else list(want)
    path = capture.file if isinstance(capture, Capture) else _arrays.path_of(capture, "capture", " or a Capture")
    keywords = {name: value for name, value in options.items() if value is not None}
    return NextTests(_core.next_test(path, words, keywords)["measurements"])


@_check.arguments
def report(data: Any, out: Path, *, title: str = "Soft polymer, from load cell to material", cards: Texts = None,
           units: str = "mm-t-s", logo: OptionalPath = None, truth: Union[Path, Sequence[Path], None] = None,
           pictures: OptionalPath = None, unverified: bool = False, overwrite: bool = False, reproducible: bool = False,
           plausible: str = "on", progress: Progress = None) -> None:
    """Write one HTML page about captures, tables and materials, as ``viscard report`` does.

    Warns with DoubtWarning of results on it that are not to be trusted.

    Parameters
    ----------
    data : path, Capture, list of these, or dict of these by kind of test
        Captures and tables (which are fitted), files of materials, of a joint fit and of laws of rubber. A dict by kind is
        of tests of one material, as in `fit`. The page states the SHA-256 of each, so all are files: arrays and results
        of fits are saved first (``result.material.save("pdms.json")``).
    out : path
        The page; an existing file is kept unless `overwrite` is True.
    title : str
    cards : str or list of str
        Targets of cards to show; default: abaqus, ansys, febio and json.
    units : str
        Unit system of the cards.
    logo : path
        Picture above the heading (PNG, JPEG or SVG).
    truth : path or list of paths
        Truth of each emulated capture, in their order. Default: the file beside the capture.
    pictures : path
        Folder to write every picture into, as SVG.
    unverified : bool
        Take damaged captures too, as in `fit`; the page says so.
    reproducible : bool
        Leave out the date, so that the same input gives the same bytes.
    plausible : "on" or "off"
    progress : function of (fraction, step)

    Examples
    --------
    >>> viscard.report(viscard.data_file("materials/pdms_1to10_seed.json"), "report.html")
    >>> open("report.html").read(15)
    '<!DOCTYPE html>'
    """
    given = _arrays.given(data, "data", only_files=True)
    page = os.fspath(out)
    if os.path.exists(page) and not overwrite:
        _core.write_file(page, "", False)  # refuses before the work begins
    targets = [cards] if isinstance(cards, str) else list(cards or ("abaqus", "ansys", "febio", "json"))
    if truth is not None and not isinstance(truth, (str, os.PathLike, list, tuple)):
        raise TypeError(f"truth must be a path or a list of paths, not {_check.shown(truth)}")
    truths = [] if truth is None else list(truth) if isinstance(truth, (list, tuple)) else [truth]
    keywords: Dict[str, Any] = {"title": title, "cards": targets, "units": units, "plausible": plausible, "overwrite": overwrite,
                "truth": [_arrays.path_of(one, "truth") for one in truths], "unverified": unverified,
                "reproducible": reproducible, "logo": "" if logo is None else os.fspath(logo),
                "pictures": "" if pictures is None else os.fspath(pictures)}
    for defect in _core.report(given.words, page, keywords, progress):
        warnings.warn(defect, DoubtWarning, stacklevel=3)


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

    test_path, guess_path, scene_path = (None if one is None else os.fspath(one) for one in (test, guess, scene))
    return TestCost(_core.cost_of_tests(os.fspath(rig), os.fspath(specimen), words, test_path, guess_path, scene_path, at_most))
