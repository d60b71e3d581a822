# SPDX-License-Identifier: BSD-3-Clause
"""The directive ``headers``: everything that the C++ headers of a folder declare, so that nothing is forgotten."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

if TYPE_CHECKING:
    from sphinx.application import Sphinx

NAMESPACE = "namespacelrrt.xml"


class Symbol(NamedTuple):
    """A class, an enumeration, a function … of the namespace, as Doxygen found it."""

    file: str  #: the header, below include/
    line: int
    directive: str  #: Breathe's one
    name: str  #: of a function with its parameters

    def page(self) -> list[str]:
        """What Breathe makes its reference of."""
        members = [":members:"] if self.directive in ("doxygenclass", "doxygenstruct") else []
        return [f"```{{{self.directive}}} {self.name}", *members, "```", ""]


def _symbol(element: ElementTree.Element, name: str) -> Symbol:
    place = element.find("location")
    assert place is not None
    return Symbol(place.get("file", ""), int(place.get("line", "0")), f"doxygen{element.get('kind')}", name)


@lru_cache
def symbols(folder: Path) -> list[Symbol]:
    """All symbols of the namespace in Doxygen's folder of XML files, header by header, in the order of their lines."""
    found = []
    namespace = ElementTree.parse(folder / NAMESPACE).getroot()[0]
    for member in namespace.iter("memberdef"):
        parameters = member.findtext("argsstring", "") if member.get("kind") == "function" else ""
        found.append(_symbol(member, f"lrrt::{member.findtext('name')}{parameters}"))
    for inner in namespace.iter("innerclass"):
        if (inner.text or "").count("::") == 1:  # those inside a class stand with it
            compound = ElementTree.parse(folder / f"{inner.get('refid')}.xml").getroot()[0]
            found.append(_symbol(compound, inner.text or ""))
    return sorted(found)


class Headers(SphinxDirective):
    """``headers FOLDER``: a section for each header of include/FOLDER, not of the folders in it."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        folder = self.arguments[0]
        known = symbols(Path(self.config.breathe_projects["lrrt"]))
        chosen = [symbol for symbol in known if Path(symbol.file).parent.as_posix() == folder]
        if not chosen:
            raise self.error(f"headers: Doxygen found nothing in include/{folder}")
        files = sorted({symbol.file for symbol in chosen})
        return [self._section(file, [symbol for symbol in chosen if symbol.file == file]) for file in files]

    def _section(self, file: str, declared: list[Symbol]) -> nodes.section:
        section = nodes.section(ids=[nodes.make_id(file)], names=[file])
        section += nodes.title(file, "", nodes.literal(file, file))
        lines = [line for symbol in declared for line in symbol.page()]
        self.state.nested_parse(StringList(lines, source=file), self.content_offset, section)
        for title in [t for t in section.findall(nodes.rubric) if t.astext() == "Unnamed Group"]:
            title.parent.remove(title)  # its members share a comment, which says enough
        return section


def setup(app: Sphinx) -> dict[str, Any]:
    """Makes the directive known."""
    app.add_directive("headers", Headers)
    return {"parallel_read_safe": True}
