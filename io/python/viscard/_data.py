"""The files that come with viscard: examples to run and copy."""

from __future__ import annotations

import os
import pathlib

from . import _check
from ._error import Error
from ._types import Path


@_check.arguments
def data_file(name: Path = "") -> str:
    """The path of a file that comes with viscard, such as "scenes/pillar_press.toml"; of a folder or "", the folder.

    There are the folders demo, designs, materials, protocols, reference, requirements, scenes and studies.

    Parameters
    ----------
    name : str
        As seen from the folder of these files.

    Raises
    ------
    Error
        If there is no such file; the text lists what its folder has.

    Examples
    --------
    >>> table = viscard.read_table(viscard.data_file("demo/example_relaxation.csv"))
    >>> table["time_s"].size
    241
    """
    wanted = os.fspath(name)
    # Beside the module: PREFIX/share/viscard of PREFIX/lib/python3/dist-packages/viscard; in a build folder likewise.
    roots = [parent / "share" / "viscard" for parent in pathlib.Path(__file__).absolute().parents]
    root = next((one for one in roots if (one / "demo").is_dir()), None)
    if root is None:
        raise Error(f"the files that come with viscard were not found in '{roots[-2]}' nor beside the module; install the "
                    "package viscard", "file")
    path = root / wanted
    if os.path.exists(path) and not os.path.isabs(wanted):  # pathlib's raises for a name that is too long
        return str(path)
    folder = root if os.path.isabs(wanted) else path.parent
    while not os.path.isdir(folder):
        folder = folder.parent
    there = ", ".join(sorted(os.listdir(folder)))
    raise Error(f"no file '{wanted}' comes with viscard; '{folder}' has {there}", "file")
