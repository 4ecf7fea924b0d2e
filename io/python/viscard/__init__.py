"""viscard: a soft polymer from a load cell to a validated simulation.

>>> result = viscard.fit(viscard.data_file("demo/example_relaxation.csv"))
>>> result.material.card("calculix", "mm-t-s").text.splitlines()[0][:2]
'**'

Quantities are SI, with the unit in the name (E0_Pa, tau_s). A keyword takes a number in SI or a text with its unit
("0.1 mm"). Mistakes are ``viscard.Error`` with the words of the command line.
"""

from __future__ import annotations

from . import _core
from ._answer import Answer, Cost, Field, Plan, Value
from ._calibrate import Calibration, calibrate
from ._capture import CaptureOutcome, capture
from ._card import Card, card_targets
from ._data import data_file
from ._design import DesignLimits, Designs, Judgement, design
from ._error import DoubtWarning, Error
from ._fit import fit
from ._fit_result import FitResult, Flag, JointFit
from ._inverse import PressureReader, Pressures, pressures_from_voltages
from ._material import Material, Prediction, Validation, predict
from ._planning import NextTest, NextTests, TestCost, cost_of_tests, next_test, report
from ._result import Parameter
from ._rubber import RubberCard, RubberFit, RubberTerm
from ._scene import check_scene, cost, forces_from_voltages, plan, simulate
from ._sweep import Sweep, sweep
from ._table import Capture, Table, read_capture, read_table

__version__: str = _core.version

__all__ = ["Answer", "Calibration", "Capture", "CaptureOutcome", "Card", "Cost", "DesignLimits", "Designs", "DoubtWarning", "Error", "Field", "FitResult",
           "Flag", "JointFit", "Judgement", "Material", "NextTest", "NextTests", "Parameter", "Plan", "Prediction", "PressureReader", "Pressures",
           "RubberCard", "RubberFit", "RubberTerm",
           "Sweep", "Table", "TestCost", "Validation", "Value", "calibrate", "capture", "card_targets", "check_scene", "cost", "cost_of_tests",
           "data_file", "design", "fit", "forces_from_voltages", "next_test", "plan", "predict", "pressures_from_voltages", "read_capture", "read_table", "report",
           "simulate", "sweep"]


def _end_jobs() -> None:
    """At exit: a simulation that was interrupted may still be at work, and must not lose what it uses."""
    import os
    import signal
    import sys
    import time

    while _core.jobs_left() > 0:
        if getattr(sys, "last_type", None) is KeyboardInterrupt:  # as Python itself ends then
            sys.stdout.flush()
            sys.stderr.flush()
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.02)


def _at_exit() -> None:
    import atexit

    atexit.register(_end_jobs)


_at_exit()
