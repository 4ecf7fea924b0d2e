"""What arguments may be."""

import os
from typing import Callable, Mapping, Optional, Sequence, Union

Path = Union[str, os.PathLike]
OptionalPath = Union[str, os.PathLike, None]
Scene = Union[str, os.PathLike, Mapping]
Quantity = Union[str, float, None]
Texts = Union[str, Sequence[str], None]
Progress = Optional[Callable[[float, str], object]]
