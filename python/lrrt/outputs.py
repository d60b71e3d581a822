# SPDX-License-Identifier: BSD-3-Clause
"""What the command line writes, checked before anything is planned."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from lrrt._core import Error

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ENDINGS = (".png", ".pdf", ".svg")
_EXPECTED = "expected a .png, .pdf or .svg in a folder that exists"


def check_picture(picture: Path, sources: Iterable[Path]) -> None:
    """Finds most of what would keep a picture from being written.

    Args:
        picture: file to write.
        sources: files that are read and must stay as they are; links to them are found, too.

    Raises:
        Error: the ending is another than .png, .pdf and .svg, there is no such folder, or the file is a source.
    """
    if picture.suffix.lower() not in _ENDINGS:
        raise Error(f"{picture}: the name of a picture must end with .png, .pdf or .svg; {_EXPECTED}")
    is_folder = os.path.isdir(picture)  # Path.is_dir() gives up on names that are too long
    if is_folder or not os.path.isdir(picture.parent):
        why = "it is a folder" if is_folder else "there is no such folder"
        raise Error(f"{picture}: cannot be written ({why}); {_EXPECTED}")
    for source in sources:
        if _same(picture, source):
            raise Error(f"{picture}: is {source}, which is read; expected another file, so that it is not overwritten")


def save_picture(axes: Axes, picture: Path) -> None:
    """Writes the figure of some axes. Raises Error where that fails."""
    try:
        axes.figure.savefig(picture)  # type: ignore[union-attr]
    except (OSError, ValueError) as error:
        raise Error(f"{picture}: cannot be written ({error}); {_EXPECTED}") from error


def _same(a: Path, b: Path) -> bool:
    try:
        return a.samefile(b)
    except OSError:  # one of them is not there
        return False
