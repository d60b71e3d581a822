# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a PNG that say what its pixels are, checked; Pillow alone would take much for granted."""

from __future__ import annotations

import re
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

SIGNATURE = b"\x89PNG\r\n\x1a\n"  #: how PNG files begin

_KEPT = ("IHDR", "PLTE", "tRNS", "IDAT", "IEND")
_ORDER = re.compile(r"IHDR(-*)(PLTE)?(-*)(tRNS)?(-*)(IDAT)+(-*)IEND")  # a dash is a chunk that is not kept
_GREY, _COLOR, _PALETTE = 0, 2, 3  # colour types


class PngError(ValueError):
    """A PNG is damaged; says what is wrong with it."""


@dataclass(frozen=True)
class Png:
    """A PNG without what does not change its pixels, such as texts, however large."""

    content: bytes  #: the file again: header, palette and its transparency, pixels
    transparent: tuple[
        int, ...
    ] = ()  #: the grey, or red, green and blue, that stands for transparent, as Pillow has it


def checked_png(content: bytes) -> Png:
    """Checks every chunk of a file that begins with the signature.

    Raises:
        PngError: a chunk is cut off, missing, in the wrong place or does not match its checksum.
    """
    chunks = list(_chunks(content))
    if not _ORDER.fullmatch("".join(name if _is_kept(name) else "-" for name, _ in chunks)):
        raise PngError("its chunks are not IHDR, perhaps PLTE and tRNS, one run of IDAT and IEND, in this order")
    chunks = [(name, whole) for name, whole in chunks if _is_kept(name)]
    parts = {name: bytes(whole[8:-4]) for name, whole in chunks if name != "IDAT"}
    if len(parts["IHDR"]) != 13:
        raise PngError("its header has another length than 13 bytes")
    depth, color = parts["IHDR"][8:10]
    if color == _PALETTE and len(parts.get("PLTE", b"")) not in range(3, 769, 3):
        raise PngError("there is no palette, or one that does not hold 1 to 256 colours")
    kept = [whole for name, whole in chunks if name != "tRNS" or color == _PALETTE]
    return Png(b"".join([SIGNATURE, *kept]), _transparent(depth, color, parts.get("tRNS")))


def _chunks(content: bytes) -> Iterator[tuple[str, memoryview]]:
    """Names of the chunks up to the end, each with all of its bytes: length, name, data and checksum."""
    view, at, name = memoryview(content), len(SIGNATURE), b""
    while name != b"IEND":
        if at + 12 > len(view):
            raise PngError("it is cut off")
        length, name = struct.unpack_from(">I4s", view, at)
        chunk = view[at : at + 12 + length]
        if len(chunk) != 12 + length:
            raise PngError("it is cut off")
        if not name.isalpha():
            raise PngError(f"{name!r} is no name of a chunk")
        if zlib.crc32(chunk[4:-4]) != struct.unpack(">I", chunk[-4:])[0]:
            raise PngError(f"chunk {name.decode()} does not match its checksum")
        yield name.decode(), chunk
        at += len(chunk)


def _is_kept(name: str) -> bool:
    """Raises PngError for an unknown chunk that begins with a capital: it is not to be passed over."""
    if name[0].isupper() and name not in _KEPT:
        raise PngError(f"chunk {name} is unknown, but needed to read it")
    return name in _KEPT


def _transparent(depth: int, color: int, chunk: bytes | None) -> tuple[int, ...]:
    """The transparent value, scaled as Pillow scales pixels: to 8 bits, but for 16-bit grey."""
    count = {_GREY: 1, _COLOR: 3}.get(color, 0)
    if chunk is None or not count:
        return ()
    if len(chunk) != 2 * count:
        raise PngError(f"its transparency has another length than {2 * count} bytes")
    values = struct.unpack(f">{count}H", chunk)
    if depth == 16:
        # Pillow drops the lower byte of colours; a few more pixels may be unknown, never fewer.
        return values if color == _GREY else tuple(value >> 8 for value in values)
    return tuple(value * 255 // ((1 << depth) - 1) for value in values)
