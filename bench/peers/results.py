# SPDX-License-Identifier: BSD-3-Clause
"""Result files in the format of ``lrrt_bench``, written row by row, so that an interrupted run loses nothing."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lrrt.report.fields import ResultError
from lrrt.report.results import FORMAT
from lrrt.report.writing import document_text, write_file

Json = dict[str, Any]

#: What differs between two runs of one command, and need not agree to go on with a file.
_OF_THE_MOMENT = ("started", "callback_overhead_us")


class ResultFile:
    """The rows of a run while they are made.

    They are kept in F.part as they come; the next run with the same header goes on where this one stopped. ``finish``
    writes F and removes F.part.
    """

    def __init__(self, path: Path, header: Json) -> None:
        """Opens F.part.

        Raises:
            ResultError: it cannot be written, or was begun with another header.
        """
        self._path = path
        self._part = path.with_name(path.name + ".part")
        self._rows: dict[str, Json] = {}
        self.header = header
        if self._part.exists():
            self._resume()
        # Written anew: a run that was killed may have left half a line.
        write_file(self._part, "".join(f"{_line(item)}\n" for item in (self.header, *self._rows.values())))

    def __contains__(self, row_id: str) -> bool:
        """Whether a row is there already."""
        return row_id in self._rows

    def __len__(self) -> int:
        """How many rows are there."""
        return len(self._rows)

    def add(self, row: Json) -> None:
        """Keeps a finished row."""
        self._rows[row["id"]] = row
        try:
            with self._part.open("a", encoding="utf-8") as file:
                file.write(_line(row) + "\n")
        except OSError as error:
            raise _unwritable(self._part, error) from error

    def finish(self, ids: Sequence[str]) -> Json:
        """Writes F with the rows in this order, complete or not at all, and returns what it holds."""
        document = {"format": FORMAT, **self.header, "rows": [self._rows[row_id] for row_id in ids]}
        write_file(self._path, document_text(document))
        self._part.unlink(missing_ok=True)
        return document

    def _resume(self) -> None:
        try:
            begun, *lines = (_parsed(line) for line in self._part.read_text(encoding="utf-8").splitlines())
        except (OSError, ValueError):
            begun, lines = {}, []
        if _lasting(begun) != _lasting(json.loads(_line(self.header))):
            raise ResultError(
                f"{self._part}: was begun with other problems, planners, settings or versions; give the command that "
                "began it to go on, or remove the file to begin anew"
            )
        self.header = begun
        self._rows = {row["id"]: row for row in lines if "id" in row}


def _parsed(line: str) -> Json:
    """A line of JSON; nothing for the unfinished line of a run that was killed."""
    try:
        value = json.loads(line)
    except ValueError:
        return {}
    return value if isinstance(value, dict) else {}


def _lasting(header: Json) -> Json:
    return {key: value for key, value in header.items() if key not in _OF_THE_MOMENT}


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def _unwritable(path: Path, error: OSError) -> ResultError:
    reason = error.strerror or error
    return ResultError(
        f"{path}: cannot be written ({reason}); expected a folder that exists, may be written and has room"
    )
