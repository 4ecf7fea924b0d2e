"""Tables of results: HTML in notebooks, and data frames of pandas, which is imported only here."""

from __future__ import annotations

import html
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence

import numpy as np

from ._error import Error


def shown(value: Any) -> str:
    """A number with six digits, an interval as "low to high"."""
    if value is None:
        return ""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return f"{shown(value[0])} to {shown(value[1])}"
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else f"{value:.6g}"
    return str(value)


class Columns(NamedTuple):
    """The table of a result: columns of one length by name, notes below it, and units that the names do not state.
    A column "interval_95" or "..._interval_95" holds pairs (low, high)."""

    title: str
    columns: Mapping[str, Any]
    notes: Sequence[str] = ()
    units: Mapping[str, str] = {}


def of_rows(title: str, heads: Sequence[str], rows: Iterable[Sequence[Any]], notes: Sequence[str] = ()) -> Columns:
    """A table from its rows."""
    kept = list(rows)
    return Columns(title, {head: [row[i] for row in kept] for i, head in enumerate(heads)}, notes)


def of_dicts(title: str, heads: Sequence[str], rows: Iterable[Mapping[str, Any]], notes: Sequence[str] = ()) -> Columns:
    """A table from rows by key; what a row does not have is None."""
    return of_rows(title, heads, ([row.get(head) for head in heads] for row in rows), notes)


def of_values(title: str, json: Mapping[str, Any], notes: Sequence[str] = ()) -> Columns:
    """The single values and intervals of an object of ``--json``, also of objects in it, "readings.missing"."""
    return of_rows(title, ("name", "value"), _values(json, ""), notes)


def _values(json: Mapping[str, Any], before: str) -> Iterable[Sequence[Any]]:
    for key, value in json.items():
        if isinstance(value, dict):
            yield from _values(value, f"{before}{key}.")
        elif key.endswith("interval_95") or not isinstance(value, list):
            if key not in ("schema", "version"):
                yield before + key, value


_HEADS = {"name": "", "interval_95": "95 %"}
_MOST_ROWS = 24


def html_of(table: Columns) -> str:
    """A table with a caption, and notes below it; of a long one the first and last rows."""
    columns = list(table.columns.values())
    n = len(columns[0]) if columns else 0
    rows: List[Optional[int]] = list(range(n))
    if n > _MOST_ROWS:
        rows = [*range(_MOST_ROWS // 4), None, *range(n - _MOST_ROWS // 4, n)]

    def cells(row: Iterable[Any], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(shown(one))}</{tag}>" for one in row) + "</tr>"

    units = {name: unit for name, unit in table.units.items() if unit not in ("", "1")}
    heads = [f"{name} ({units[name]})" if name in units else _HEADS.get(name, name) for name in table.columns]
    text = f"<table><caption>{html.escape(table.title)}</caption><thead>{cells(heads, 'th')}</thead><tbody>"
    text += "".join(cells(["..." if row is None else column[row] for column in columns], "td") for row in rows)
    text += "</tbody></table>"
    if table.notes:
        text += "<ul>" + "".join(f"<li>{html.escape(note)}</li>" for note in table.notes) + "</ul>"
    return text


def frame(columns: Mapping[str, Any]) -> Any:
    """The columns as a DataFrame; intervals become two, "..._low_95" and "..._high_95"."""
    try:
        import pandas
    except ImportError as missing:
        raise Error("to_frame() needs pandas; install python3-pandas", "missing") from missing
    out: Dict[str, Any] = {}
    for name, values in columns.items():
        if name.endswith("interval_95"):
            stem = name[:-len("interval_95")]
            pairs = [(None, None) if one is None else one for one in values]
            out[f"{stem}low_95"] = np.array([low for low, _ in pairs], dtype=float)
            out[f"{stem}high_95"] = np.array([high for _, high in pairs], dtype=float)
        else:
            out[name] = values
    return pandas.DataFrame(out)
