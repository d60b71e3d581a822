# SPDX-License-Identifier: BSD-3-Clause
"""Docstrings and signatures of the Python package as readers want them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from sphinx.ext.napoleon import GoogleDocstring

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_SHORT = (
    (r"""(?:typing\.)?Annotated\[numpy\.typing\.ArrayLike(?:, numpy\.\w+)?(?:, ["']\[[^"']*\]["'])?\]""", "ArrayLike"),
    (r"(?:typing\.)?SupportsFloat \| (?:typing\.)?SupportsIndex", "float"),
    (r"(?:typing\.)?SupportsInt \| (?:typing\.)?SupportsIndex", "int"),
    (r"\b(?:lrrt\._core|numpy\.typing|collections\.abc|typing)\.", ""),
)
_SELF = re.compile(r"^\(self: [\w.]+(?:, )?")


def read_sections(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Args and Raises as fields. Napoleon itself would take "(N, 2) array: points" of a property for a type."""
    lines[:] = GoogleDocstring(lines, what=what).lines()


def plain_signature(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, returned: str | None
) -> tuple[str | None, str | None]:
    """What pybind11 tells of types, shortened to what a caller has to know."""
    plain = [signature, returned]
    for long, short in _SHORT:
        plain = [text and re.sub(long, short, text) for text in plain]
    return plain[0] and _SELF.sub("(", plain[0]), plain[1]


def setup(app: Sphinx) -> dict[str, Any]:
    """Hooks into autodoc."""
    app.connect("autodoc-process-docstring", read_sections)
    app.connect("autodoc-process-signature", plain_signature)
    return {"parallel_read_safe": True}
