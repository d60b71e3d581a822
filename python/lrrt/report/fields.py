# SPDX-License-Identifier: BSD-3-Clause
"""Values of a JSON file, each checked when it is asked for; errors name the file and the field."""

from __future__ import annotations

import gzip
import json
import math
import stat
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeGuard

from lrrt._core import Error

_GZIP = b"\x1f\x8b"  # how gzipped files begin
MOST_BYTES = 1 << 28  #: of a result file, unpacked; those of whole studies have some 2^20
_MOST = 1e15  # beyond any measurement, and figures are still drawn
_LARGEST_WHOLE = 1 << 64  # beyond any count or seed; Python would read more digits than a double holds


class ResultError(Error):
    """A result file or a report cannot be read or written; names the file, the field and what was expected."""


class Fields:
    """One JSON object of a file."""

    def __init__(self, values: dict[str, Any], source: str, place: str = "") -> None:
        self._values = values
        self._source = source
        self._place = place

    def __contains__(self, key: str) -> bool:
        """Whether the object has the key with anything but null."""
        return self._values.get(key) is not None

    def __iter__(self) -> Iterator[str]:
        """The keys, in the order of the file."""
        return iter(self._values)

    def raw(self, key: str) -> Any:
        """A value as it is."""
        return self._values[key]

    def place(self, key: str) -> str:
        """Where a field stands, as in ``rows[3].times_ms.plan``."""
        return f"{self._place}.{key}" if self._place else key

    def refuse(self, key: str, expected: str) -> ResultError:
        """The error for a field that is missing or wrong."""
        where = f"{self._source}: field '{self.place(key)}'"
        if key not in self._values:
            return ResultError(f"{where} is missing; expected {expected}")
        shown = json.dumps(self._values[key], ensure_ascii=False)
        shown = shown if len(shown) <= 60 else shown[:57] + "…"
        return ResultError(f"{where} is {shown}; expected {expected}")

    def text(self, key: str, fallback: str | None = None) -> str:
        """A text; the fallback, where there is one, when the key is absent."""
        if fallback is not None and key not in self._values:
            return fallback
        value = self._values.get(key)
        if not isinstance(value, str):
            raise self.refuse(key, "a text")
        return value

    def flag(self, key: str) -> bool:
        """True or false."""
        value = self._values.get(key)
        if not isinstance(value, bool):
            raise self.refuse(key, "true or false")
        return value

    def whole(self, key: str) -> int:
        """A whole number."""
        value = self._values.get(key)
        if not isinstance(value, int) or isinstance(value, bool) or abs(value) > _LARGEST_WHOLE:
            raise self.refuse(key, "a whole number")
        return value

    def wholes(self, key: str) -> list[int]:
        """A list of whole numbers that is not empty."""
        expected = "a list of whole numbers"
        items = self._items(key, expected)
        if not all(isinstance(item, int) and is_number(item) for item in items):
            raise self.refuse(key, expected)
        return items

    def number(self, key: str) -> float:
        """A finite number below 10^15."""
        value = self._values.get(key)
        if not is_number(value):
            raise self.refuse(key, "a finite number below 1e15")
        return float(value)

    def number_or_nan(self, key: str) -> float:
        """A finite number below 10^15, or nan where the file says null or nothing."""
        return self.number(key) if key in self else math.nan

    def child(self, key: str) -> Fields:
        """An object inside this one."""
        value = self._values.get(key)
        if not isinstance(value, dict):
            raise self.refuse(key, "an object")
        return Fields(value, self._source, self.place(key))

    def children(self, key: str, expected: str, or_none: bool = False) -> list[Fields]:
        """A list of objects; it may be empty only where there may be none."""
        items = [] if or_none and self._values.get(key) == [] else self._items(key, expected)
        for i, item in enumerate(items):
            if not isinstance(item, dict):
                raise Fields({f"{key}[{i}]": item}, self._source, self._place).refuse(f"{key}[{i}]", "an object")
        return [Fields(item, self._source, f"{self.place(key)}[{i}]") for i, item in enumerate(items)]

    def matrix(self, key: str, columns: int, expected: str) -> list[list[float]]:
        """A list, not empty, of lists of so many finite numbers."""
        items = self._items(key, expected)
        for item in items:
            if not (isinstance(item, list) and len(item) == columns and all(map(is_number, item))):
                raise self.refuse(key, expected)
        return items

    def _items(self, key: str, expected: str) -> list[Any]:
        value = self._values.get(key)
        if not isinstance(value, list) or not value:
            raise self.refuse(key, expected)
        return value


def is_number(value: object) -> TypeGuard[float]:
    """Whether a JSON value is a finite number below 10^15, or above its negative; true and false are none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < _MOST  # nan is not


def read_object(path: Path, writer: str = "lrrt_bench --json") -> Fields:
    """The JSON object that a file holds, as fields; arguments and errors as ``read_document``."""
    return Fields(read_document(path, writer), str(path))


def read_document(path: Path, writer: str = "lrrt_bench --json") -> dict[str, Any]:
    """The JSON object that a file holds, gzipped or not.

    Args:
        path: the file.
        writer: the command that writes such files, for errors.

    Raises:
        ResultError: there is no such file, or it holds something else.
    """
    expected = f"expected a file that {writer} wrote"
    text = _text_of(path, expected)
    try:
        values = json.loads(text)
    except (ValueError, RecursionError) as error:
        if path.suffix == ".part":
            raise ResultError(
                f"{path}: is a run that was interrupted; give the command that began it again, then report {path.stem}"
            ) from error
        raise ResultError(f"{path}: is not JSON ({error}); {expected}") from error
    if not isinstance(values, dict):
        raise ResultError(f"{path}: holds no JSON object; {expected}")
    return values


def _text_of(path: Path, expected: str) -> str:
    try:
        content = _content_of(path)
    except (EOFError, gzip.BadGzipFile, zlib.error) as error:
        raise ResultError(f"{path}: is gzipped, but broken ({error}); {expected}") from error
    except OSError as error:
        raise ResultError(f"{path}: cannot be read ({error.strerror or error}); {expected}") from error
    if len(content) > MOST_BYTES:
        raise ResultError(f"{path}: holds more than {MOST_BYTES} bytes; {expected}; is it the right file?")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise ResultError(f"{path}: is no text ({error.reason} at byte {error.start}); {expected}") from error


def _content_of(path: Path) -> bytes:
    """What a file holds, unpacked; one byte too many where it holds too much."""
    if not stat.S_ISREG(path.stat().st_mode):  # a pipe would be waited for, a device never ends
        raise OSError("not a regular file")
    with path.open("rb") as stream:
        packed = stream.read(len(_GZIP)) == _GZIP  # by its first bytes: a file that was renamed is read, too
        stream.seek(0)
        if not packed:
            return stream.read(MOST_BYTES + 1)
        with gzip.GzipFile(fileobj=stream) as unpacked:
            return unpacked.read(MOST_BYTES + 1)
