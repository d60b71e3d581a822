# SPDX-License-Identifier: BSD-3-Clause
"""Result files small enough to live in the repository: nothing that a table or a figure shows is lost."""

from __future__ import annotations

import gzip
import os
from pathlib import Path
from typing import Any

from lrrt.report.fields import read_document
from lrrt.report.results import load
from lrrt.report.writing import document_text, write_file

LEAST_FALL = 0.001  #: share by which a path has to get shorter for its step to be kept; below the width of a line
_DIGITS = 6  # of the steps between the first and the last
_SUITES = ("bench", "suites")  # where the suites that ship lie, from the top of the repository

Step = list[float]  #: milliseconds, iteration, length


def store(source: str | os.PathLike[str], target: str | os.PathLike[str]) -> tuple[int, int]:
    """Writes a result of ``lrrt_bench`` slimmed and gzipped.

    Args:
        source: file that ``lrrt_bench --json`` wrote, gzipped or not.
        target: file to write, ending in ``.json.gz``; replaced where it exists.

    Returns:
        Bytes of the source and of the target.

    Raises:
        ResultError: the source is no result, or the target cannot be written.
    """
    source, target = Path(source), Path(target)
    load(source)  # refuses what no report could show
    content = gzip.compress(document_text(slimmed(read_document(source))).encode(), mtime=0)  # same result, same bytes
    write_file(target, content)
    return source.stat().st_size, len(content)


def slimmed(document: dict[str, Any]) -> dict[str, Any]:
    """A result without the steps of cost histories that no figure shows; everything else as it is.

    The suite's folder, which is relative to where the program ran, becomes relative to the repository, so that a
    replay works from there; one that lies elsewhere is not told.
    """
    rows = [{**row, "history": thinned(row["history"])} if row.get("history") else row for row in document["rows"]]
    slim = {**document, "rows": rows}
    if "system" in document.get("machine", {}):  # as "Linux x86_64": the kernel's version says nothing about the times
        name, *_, kind = document["machine"]["system"].split() * 2
        slim["machine"] = {**document["machine"], "system": name if kind == name else f"{name} {kind}"}
    if "folder" in document:
        slim["folder"] = "/".join(_SUITES) if Path(document["folder"]).parts[-2:] == _SUITES else "."
    return slim


def thinned(history: list[Step]) -> list[Step]:
    """The first step, the last, and those that make the path shorter by LEAST_FALL than the one kept before."""
    kept = [history[0]]
    for milliseconds, iteration, length in history[1:-1]:
        step = [_rounded(milliseconds), iteration, _rounded(length)]
        if step[2] <= kept[-1][2] * (1 - LEAST_FALL):
            kept.append(step)
    return [*kept, history[-1]] if len(history) > 1 else kept


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
