# SPDX-License-Identifier: BSD-3-Clause
"""From result files to the files of a report."""

from __future__ import annotations

import contextlib
import json
import os
import stat
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
    if folder is not None and os.path.exists(folder) and not os.path.isdir(folder):
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
    used = {os.path.realpath(path) for path in sources}  # resolve() gives up where links go round in circles
    for target in targets:
        place = os.path.realpath(target)
        if place in used:
            raise ResultError(f"{target}: is read or written already; expected a file of its own for the report")
        used.add(place)
        if os.path.isdir(target):  # Path.is_dir() gives up on names that are too long
            raise ResultError(f"{target}: is a folder; {_EXPECTED}")
        if not os.path.isdir(target.parent):
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
    """Writes a file, or whatever else has that name: a link is followed, a device or a pipe is written and stays."""
    data = content if isinstance(content, bytes) else content.encode("utf-8", errors="replace")
    try:
        if _is_special(path):
            path.write_bytes(data)
        else:
            _replace(Path(os.path.realpath(path)), data)
    except OSError as error:
        raise ResultError(f"{path}: cannot be written ({error.strerror or error}); {_EXPECTED}") from error
    return path


def _is_special(path: Path) -> bool:
    try:
        return not stat.S_ISREG(path.stat().st_mode)
    except FileNotFoundError:
        return False


def _replace(file: Path, data: bytes) -> None:
    """Writes under another name first, so that nobody sees half a file."""
    temporary = file.with_name(f".{file.name}.part")
    try:
        temporary.write_bytes(data)
        temporary.replace(file)
    except OSError:
        with contextlib.suppress(OSError):  # a name that is too long for the one is so for the other
            temporary.unlink(missing_ok=True)
        raise
