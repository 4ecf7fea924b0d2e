"""Exceptions of viscard."""

from __future__ import annotations

import re
from typing import Any, Tuple

_OPTION = re.compile(r"--([a-z]+(?:-[a-z]+)*)")
_OTHER_NAMES = {"from": "from_", "emulate": "emulate=True", "force": "overwrite=True",
                "joint": "joint=True", "uncalibrated": "uncalibrated=True",
                "extrapolate": "may_extrapolate=True", "accept-flags": "accept_flags=True", "approximate": "approximate=True",
                "temperature": "temperature"}


def _keyword(match: "re.Match[str]") -> str:
    name = match.group(1)
    return _OTHER_NAMES.get(name, name.replace("-", "_"))


# What messages advise to write: "write --column 'stress_Pa=1e6*stress'", quoted for a shell, '--density "1.1 g/cm3"' and
# 'write diameter "40 um"'.
_COLUMN = re.compile(r"write --column (?:'((?:[^']|'\\'')*)'|([^\s;]+))")
_TEXT = re.compile(r'(?:--|(?<=write ))([a-z]+(?:[-_][a-z]+)*) (?=")')


def _column(match: "re.Match[str]") -> str:
    words = (match.group(1) or match.group(2)).replace("'\\''", "'")
    return f'write column="{words}"'


def in_python(text: str) -> str:
    """The same words with keywords (max_terms) in the place of options (--max-terms)."""
    text = text.replace("--plausible off", 'plausible="off"')
    text = _COLUMN.sub(_column, text)
    return _OPTION.sub(_keyword, _TEXT.sub(lambda match: _keyword(match) + "=", text))


class Error(RuntimeError):
    """What failed, where, and what to do: the same words as on the command line.

    Attributes
    ----------
    code : str
        Short and stable: "usage" (keywords that are not allowed), "input" (the contents of a file, or a value), "exists" (an
        output that is there already), "file" (a file or folder that cannot be used), "missing" (a module that is not
        installed), or "failed" (anything else). Of a capture also "preflight" (this rig cannot do the test), "calibration" (it
        has expired), "port" (does not exist, or is in use), "device" (does not answer as it should, or the test met what it
        must not), "device-lost", "device-restarted", "stage-alarm", "readings-old" and "computer-late" (too late to watch the
        force), "force-limit", "pressing" (something pressed before the test), "interrupted", and "records-lost" (the disk did
        not keep up).
    message : str
        What happened, with the value and its limit.
    where : str
        File with its line, keyword, port or phase of the run; may be empty.
    hint : str
        What to do next; may be empty.

    Examples
    --------
    >>> try:
    ...     viscard.fit(viscard.data_file("demo/example_relaxation.csv"), max_terms=200)
    ... except viscard.Error as error:
    ...     print(error.code, "|", error.message)
    usage | max_terms 200 is outside 0 to 100
    """

    def __init__(self, text: str, code: str = "failed", message: "str | None" = None,
                 where: str = "", hint: str = "") -> None:
        super().__init__(in_python(text))
        self.code = code
        self.message = in_python(text if message is None else message)
        self.where = in_python(where)
        self.hint = in_python(hint)

    def __reduce__(self) -> Tuple[Any, ...]:
        return (Error, (str(self), self.code, self.message, self.where, self.hint))


class DoubtWarning(UserWarning):
    """A result is not to be trusted; the text names the cause.

    Examples
    --------
    >>> issubclass(viscard.DoubtWarning, UserWarning)
    True
    """
