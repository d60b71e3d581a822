# SPDX-License-Identifier: BSD-3-Clause
"""From result files to the files of a report."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lrrt.report import html, markdown
from lrrt.report.content import chapters
from lrrt.report.fields import ResultError
from lrrt.report.results import load
from lrrt.report.style import svg_file

_EXPECTED = "expected a file in a folder that exists and may be written"


def write_report(
    results: Sequence[str | os.PathLike[str]],
    output: str | os.PathLike[str],
    figures: str | os.PathLike[str] | None = None,
    markdown_file: str | os.PathLike[str] | None = None,
) -> list[Path]:
    """Reads result files of ``lrrt_bench`` and writes a report of them.

    Args:
        results: files that ``lrrt_bench --json`` wrote; each becomes a chapter.
        output: HTML file, complete in itself.
        figures: folder for the figures as SVG files; made where it does not exist.
        markdown_file: the same tables as Markdown, with links to the figures where a folder is given for them.

    Returns:
        The files that were written, the HTML file first.

    Raises:
        ResultError: a file cannot be read or written; names it, the field and what was expected.
    """
    sources, page = [Path(path) for path in results], Path(output)
    text = None if markdown_file is None else Path(markdown_file)
    folder = None if figures is None else Path(figures)
    _check_targets(sources, [page] if text is None else [page, text])
    if folder is not None and folder.exists() and not folder.is_dir():
        raise ResultError(f"{folder}: is a file; expected a folder for the figures")
    contents = chapters([load(path) for path in sources])
    written = [write_file(page, html.page(contents))]
    if folder is not None:
        pictures = [picture for chapter in contents for section in chapter.sections for picture in section.pictures]
        written += [write_file(made_folder(folder) / f"{picture.name}.svg", svg_file(picture)) for picture in pictures]
    if text is not None:
        link = None if folder is None else Path(os.path.relpath(folder, text.parent)).as_posix()
        written.append(write_file(text, markdown.text_of(contents, link)))
    return written


def _check_targets(sources: list[Path], targets: list[Path]) -> None:
    """Finds most of what would fail before anything is read and drawn."""
    if not sources:
        raise ResultError("no result files; expected at least one that lrrt_bench --json wrote")
    used = {path.resolve() for path in sources}
    for target in targets:
        if target.resolve() in used:
            raise ResultError(f"{target}: is read or written already; expected a file of its own for the report")
        used.add(target.resolve())
        if target.is_dir():
            raise ResultError(f"{target}: is a folder; {_EXPECTED}")
        if not target.parent.is_dir():
            raise ResultError(f"{target}: cannot be written, there is no such folder; {_EXPECTED}")


def made_folder(folder: Path) -> Path:
    """The folder, made where it does not exist."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ResultError(f"{folder}: cannot be made ({error.strerror or error}); expected a folder") from error
    return folder


def document_text(document: dict[str, Any]) -> str:
    """A result as lrrt_bench writes it: indented, but every row on one line."""
    head = {key: value for key, value in document.items() if key != "rows"}
    rows = ",".join(f"\n  {json.dumps(row, ensure_ascii=False, separators=(',', ':'))}" for row in document["rows"])
    return json.dumps(head, ensure_ascii=False, indent=1).removesuffix("\n}") + f',\n "rows": [{rows}\n ]\n}}\n'


def write_file(path: Path, content: str | bytes) -> Path:
    """Writes under another name first, so that nobody sees half a file."""
    temporary = path.with_name(f".{path.name}.part")
    try:
        temporary.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", errors="replace"))
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise ResultError(f"{path}: cannot be written ({error.strerror or error}); {_EXPECTED}") from error
    return path
