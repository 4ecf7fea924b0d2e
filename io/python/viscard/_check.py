"""Types of arguments, by the annotations of the functions: a mistake names its keyword before anything is computed."""

from __future__ import annotations

import collections.abc
import functools
import inspect
import math
import numbers
import operator
import os
import reprlib
import threading
import types
import typing
import warnings
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, TypeVar, Union

import numpy as np

from . import _core
from ._error import DoubtWarning, Error

_Function = TypeVar("_Function", bound=Callable[..., Any])


_SHORT = reprlib.Repr()  # bounded in depth and length for every value
_SHORT.maxlevel, _SHORT.maxstring, _SHORT.maxother, _SHORT.maxlong = 4, 80, 80, 5000


def _is_path(value: Any) -> bool:
    return isinstance(value, os.PathLike) or (isinstance(value, str) and os.sep in value and "\n" not in value)


def _cut_path(text: str, most: int = 200) -> str:
    """Cut in the middle if it is long: the end names the file."""
    if len(text) <= most:
        return text
    n_end = min(max(most // 2, len(text) - text.rfind(os.sep)), most - 20)
    return text[:most - 3 - n_end] + "..." + text[-n_end:]


def shown(value: Any) -> str:
    """A value in a message, cut if it is long."""
    try:
        if _is_path(value):
            return repr(_cut_path(value)) if isinstance(value, str) else _cut_path(repr(value))
        text = _SHORT.repr(value)
    except Exception:  # of somebody's class, or a whole number of more digits than Python writes
        text = f"<{type(value).__name__}>"
    if "\n" in text:  # of a DataFrame
        text = " ".join(text.split())
    most = 200 if isinstance(value, (list, tuple)) and any(_is_path(one) for one in value[:6]) else 60
    return text if len(text) <= most else text[:most - 3] + "..."


def is_boolean(value: Any) -> bool:
    return isinstance(value, (bool, np.bool_))


def is_number(value: Any) -> bool:
    """A real number, no boolean: of Python or numpy, or an array without dimension."""
    if isinstance(value, np.ndarray):
        return value.ndim == 0 and value.dtype.kind in "fiu"
    is_real = isinstance(value, numbers.Number) and (isinstance(value, numbers.Real) or not isinstance(value, numbers.Complex))
    return is_real and not is_boolean(value)  # a Decimal is a Number and neither of the two


def _is_whole(value: Any) -> bool:
    try:
        operator.index(value)
    except TypeError:
        return False
    return not is_boolean(value)


_KINDS = {bool: ("True or False", is_boolean), float: ("a number", is_number), int: ("a whole number", _is_whole),
          str: ("a text", lambda value: isinstance(value, str)),
          os.PathLike: ("a path", lambda value: isinstance(value, os.PathLike)),
          collections.abc.Mapping: ("a dict", lambda value: isinstance(value, collections.abc.Mapping)),
          collections.abc.Callable: ("a function", callable), type(None): ("", lambda value: value is None)}
_LISTS = {str: "a list of texts", float: "a list of numbers"}


def _alternatives(hint: Any) -> "List[Any]":
    is_union = typing.get_origin(hint) in (Union, types.UnionType)
    return list(typing.get_args(hint)) if is_union else [hint]


def _element(hint: Any) -> Any:
    """float of Sequence[float]; None of what is no list."""
    return typing.get_args(hint)[0] if typing.get_origin(hint) is collections.abc.Sequence else None


def _kind(hint: Any) -> Any:
    return typing.get_origin(hint) or hint


def _is_known(hint: Any) -> bool:
    return all(_element(one) in _LISTS or _kind(one) in _KINDS for one in _alternatives(hint))


def _fits(value: Any, hint: Any) -> bool:
    element = _element(hint)
    if element is None:
        return _KINDS[_kind(hint)][1](value)
    is_list = isinstance(value, (list, tuple, np.ndarray)) and getattr(value, "ndim", 1) == 1
    return is_list and all(_KINDS[element][1](one) for one in value)


def _in_words(hint: Any) -> str:
    kinds = [_kind(one) if _kind(one) in _KINDS else one for one in _alternatives(hint)]
    if os.PathLike in kinds:  # a path is a text, which need not be said
        kinds.remove(str)
    words = [_LISTS[_element(one)] if _element(one) else _KINDS[_kind(one)][0] for one in kinds]
    words = [word for word in words if word]
    return ", ".join(words[:-1]) + " or " + words[-1] if len(words) > 1 else words[0]


def value(name: str, given: Any, hint: Any) -> None:
    """Raises TypeError for a value of another type, Error for a number that is not finite."""
    if not any(_fits(given, one) for one in _alternatives(hint)):
        raise TypeError(f"{name} must be {_in_words(hint)}, not {shown(given)}")
    for number in [given] if is_number(given) else given if isinstance(given, (list, tuple, np.ndarray)) else []:
        try:
            is_finite = not is_number(number) or math.isfinite(number)
        except (OverflowError, ValueError):  # a signalling NaN of decimal
            is_finite = False
        if not is_finite:
            raise Error(f"{name} is {shown(number)}; it must be a finite number", "usage")


def texts(name: str, given: Any, deepest: int = 3) -> None:
    """Raises Error for a text or a path that no file and no message can hold: with a NUL, or not to be written in UTF-8.
    What takes lists looks at those within lists within lists itself."""
    if isinstance(given, (list, tuple)):
        for one in given if deepest else ():
            texts(name, one, deepest - 1)
    elif isinstance(given, (str, os.PathLike)):
        text = os.fspath(given)
        if "\0" in text or any("\ud800" <= letter <= "\udfff" for letter in text):
            raise Error(f"{name} is {shown(text)}; a text holds no NUL, and nothing that UTF-8 cannot write", "usage")


def _no_such_keyword(function: str, name: str, known: "List[str]") -> str:
    import difflib  # only here, so that import viscard stays short
    near = difflib.get_close_matches(name, [one for one in known if one != "self"], 1)
    return f"{function}() has no keyword '{name}'" + (f"; did you mean '{near[0]}'?" if near else
                                                      f"; help(viscard.{function}) lists them")


def _too_many(function: str, n_most: int, surplus: "Sequence[Any]") -> str:
    text = f"{function}() takes {n_most} {'value' if n_most == 1 else 'values'} without a name"
    if any(isinstance(one, np.ndarray) or hasattr(one, "__array__") for one in surplus):
        return text + ', and arrays go into one dict by header: {"time_s": t, "modulus_Pa": E}'
    return text + "; write the others as NAME=VALUE"


def _options_of(function: Callable[..., Any]) -> Any:
    """The TypedDict of `**options: Unpack[FitOptions]`; None of other functions."""
    written = function.__annotations__.get("options", "")
    return typing.get_args(eval(written, function.__globals__))[0] if written.startswith("Unpack[") else None


def _listed(signature: inspect.Signature, options: Any) -> inspect.Signature:
    """The signature with each option as a keyword, and what they are set to if they are left out."""
    named = [one for one in signature.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
    listed = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, annotation=hint,
                                default=False if hint is bool else None)
              for name, hint in typing.get_type_hints(options).items()]
    return signature.replace(parameters=named + listed)


_calls = threading.local()


def arguments(function: _Function) -> _Function:
    """The function, with the types of its arguments checked. Those without annotation it checks itself. What is in doubt
    of the files that it read is a warning.

    Options that a TypedDict lists (`**options: Unpack[FitOptions]`) stand in its signature and its docstring.
    """
    parameters = inspect.signature(function).parameters.values()
    positional = [one.name for one in parameters if one.kind is not inspect.Parameter.VAR_KEYWORD]
    n_most = sum(one.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD for one in parameters)
    others = next((one.name for one in parameters if one.kind is inspect.Parameter.VAR_KEYWORD), None)
    options = _options_of(function) if others else None
    if options:
        positional += typing.get_type_hints(options)
        others = None

    @functools.cache  # at the first call, when all names of the module are there
    def hints() -> Dict[str, Any]:
        found = typing.get_type_hints(function) | (typing.get_type_hints(options) if options else {})
        return {name: hint for name, hint in found.items() if name != "return" and _is_known(hint)}

    @functools.wraps(function)
    def checked(*given: Any, **keywords: Any) -> Any:
        if len(given) > n_most:
            raise TypeError(_too_many(function.__qualname__, n_most - (positional[:1] == ["self"]), given[n_most:]))
        unknown = [] if others else [name for name in keywords if name not in positional]
        if unknown:
            raise TypeError(_no_such_keyword(function.__qualname__, unknown[0], positional))
        for name, one in [*zip(positional, given), *keywords.items()]:
            texts(name, one)
            hint = hints().get(name if name in positional else str(others))
            if hint is not None:
                value(name, one, hint)
        if getattr(_calls, "is_within", False):  # one public function called another
            return function(*given, **keywords)
        recorder = _core.InputRecorder()
        _calls.is_within = True
        try:
            found = function(*given, **keywords)
        except RecursionError:
            raise Error(f"{function.__qualname__}(): a value is nested too deep, or contains itself; write lists of numbers, "
                        "texts or dicts", "usage") from None
        finally:
            _calls.is_within = False
            notes = recorder.notes()
            del recorder  # which a traceback would keep, and which refuses files that change
        for note in notes:  # such as that a file was edited
            warnings.warn(note, DoubtWarning, stacklevel=2)
        return found

    if options:
        checked.__signature__ = _listed(inspect.signature(function), options)  # type: ignore[attr-defined]
        described = "\n".join("    " + line for line in str(options.__doc__).split("\n"))
        checked.__doc__ = str(function.__doc__).replace("    **options", described)
    return typing.cast(_Function, checked)
