"""Tables of results: HTML of notebooks and data frames of pandas, which is imported only here."""

from __future__ import annotations

import html
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence

import numpy as np

from ._error import Error


def shown(value: Any) -> str:
    """A number with six digits, an interval as "low to high"."""
    if value is None:
        return ""
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return f"{shown(value[0])} to {shown(value[1])}"
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else f"{value:.6g}"
    return str(value)


def html_table(title: str, heads: Sequence[str], rows: Iterable[Sequence[Any]], notes: Sequence[str] = ()) -> str:
    """A table with a caption, and notes below it."""
    def cells(row: Sequence[Any], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(shown(one))}</{tag}>" for one in row) + "</tr>"

    text = f"<table><caption>{html.escape(title)}</caption><thead>{cells(heads, 'th')}</thead><tbody>"
    text += "".join(cells(row, "td") for row in rows) + "</tbody></table>"
    if notes:
        text += "<ul>" + "".join(f"<li>{html.escape(note)}</li>" for note in notes) + "</ul>"
    return text


def html_columns(title: str, columns: Mapping[str, np.ndarray[Any, Any]], notes: Sequence[str] = (), most: int = 12) -> str:
    """The first and last rows of columns."""
    n = len(next(iter(columns.values())))
    rows: List[Optional[int]] = list(range(n)) if n <= most else [*range(most // 2), None, *range(n - most // 2, n)]
    cells = [["..."] * len(columns) if row is None else [values[row] for values in columns.values()] for row in rows]
    return html_table(title, list(columns), cells, notes)


def frame(columns: Dict[str, Any]) -> Any:
    """The columns as a DataFrame."""
    try:
        import pandas
    except ImportError as missing:
        raise Error("to_frame() needs pandas; install python3-pandas", "missing") from missing
    return pandas.DataFrame(columns)
