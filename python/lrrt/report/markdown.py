# SPDX-License-Identifier: BSD-3-Clause
"""A report as Markdown, for documents that live beside the code; figures are files of their own."""

from __future__ import annotations

import re
from urllib.parse import quote

from lrrt.report.content import Chapter, Section
from lrrt.report.style import Picture
from lrrt.report.tables import Table


def text_of(chapters: list[Chapter], figures: str | None) -> str:
    """The whole text.

    Args:
        chapters: what to say.
        figures: the folder of the figures, relative to the text; None leaves them out.
    """
    if len(chapters) == 1:
        parts = [f"# {escaped(chapters[0].title)}", *_chapter(chapters[0], figures, 2)]
    else:
        parts = ["# Benchmark report"]
        for chapter in chapters:
            parts += [f"## {escaped(chapter.title)}", *_chapter(chapter, figures, 3)]
    return "\n\n".join(parts) + "\n"


def escaped(text: str) -> str:
    """A text that says in Markdown what it says plainly, on one line."""
    return re.sub(r"([\\`*_<>&#|~$]|\](?=\())", r"\\\1", re.sub(r"[\r\n\t]+", " ", text))


def table_lines(table: Table) -> str:
    """A table with its first column left, the others right."""
    marks = ["---", *["---:"] * (len(table.columns) - 1)]
    lines = [[escaped(column) for column in table.columns], marks]
    for i, row in enumerate(table.rows):
        lines.append([f"**{escaped(cell)}**" if (i, j) in table.best else escaped(cell) for j, cell in enumerate(row)])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def picture_lines(picture: Picture, link: str) -> str:
    """A link to a picture, and its caption."""
    title = escaped(picture.title)
    return f"![{title}]({quote(link)})\n\n*{title}.* {escaped(picture.caption)}"


def code(text: str) -> str:
    """A text set as code."""
    fence = "``" if "`" in text else "`"
    return f"{fence}{text}{fence}"


def _chapter(chapter: Chapter, figures: str | None, level: int) -> list[str]:
    facts = [f"- {name}: {escaped(value)}" for name, value in chapter.facts]
    parts = ["\n".join([*facts, f"- Run it again: {code(chapter.command)}"])]
    for section in chapter.sections:
        parts += _section(section, figures, level)
    if chapter.settings is not None:
        parts += [f"{'#' * level} {chapter.settings.title}", table_lines(chapter.settings)]
    return parts


def _section(section: Section, figures: str | None, level: int) -> list[str]:
    parts = []
    if figures is not None:
        parts += [picture_lines(picture, f"{figures}/{picture.name}.svg") for picture in section.pictures]
    for table in section.tables:
        parts += [f"**{escaped(table.title)}**", table_lines(table)]
        parts += [escaped(table.note)] if table.note else []
    return [f"{'#' * level} {escaped(section.title)}", *parts] if parts else []
