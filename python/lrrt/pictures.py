# SPDX-License-Identifier: BSD-3-Clause
"""Picture files as arrays, with the same meaning as the C++ reader's (<lrrt/io/read_map.hpp>)."""

from __future__ import annotations

import os
import stat
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import numpy.typing as npt

from lrrt._core import MapError
from lrrt.png import SIGNATURE, checked_png

if TYPE_CHECKING:
    from PIL.Image import Image

MAX_PIXELS = 1 << 28  #: largest picture that is accepted, 16384 × 16384
MAX_BYTES = (1 << 31) - 1  #: largest file that is accepted

# Pillow modes whose bytes are passed on as they are: grey, grey + alpha, RGB, RGBA.
_PLAIN_MODES = ("L", "LA", "RGB", "RGBA")
_WIDE_MODES = ("I", "I;16", "I;16L", "I;16B")  # 16-bit grey


def decode_picture(path: str | os.PathLike[str]) -> npt.NDArray[np.uint8]:
    """Pixels of a PNG, PBM, PGM, PPM, BMP or JPEG file; the content decides, not the extension.

    Palettes are resolved and 16-bit values are scaled to 0..255. A colour that a PNG names as transparent gets an alpha
    of 0. EXIF rotation is not applied.

    Returns:
        (H, W) grey or (H, W, C) uint8 with C = 2 (grey, alpha), 3 (RGB) or 4 (RGBA).

    Raises:
        MapError: the file is missing, of another format, damaged or larger than 2^28 pixels or 2^31 - 1 bytes.
    """
    source = os.fspath(path)
    try:
        _check_file(os.stat(source), source)
        with Path(source).open("rb") as stream:
            image, transparent = _open(stream, source)
            _check_size(image.size, source)
            return _to_bytes(image, transparent, source)
    except MapError:
        raise
    except OSError as error:
        if error.strerror:  # the system's words: no such file, permission denied, is a directory
            raise MapError(f"{source}: cannot be read ({error.strerror}); expected a picture file") from error
        raise _damaged(source, error) from error
    except Exception as error:  # decoders meet damage in many ways: ValueError, SyntaxError, zlib.error …
        raise _damaged(source, error) from error


def _check_file(status: os.stat_result, source: str) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise MapError(f"{source}: not a regular file; expected a picture, not a folder, a device or a pipe")
    if status.st_size > MAX_BYTES:
        raise MapError(
            f"{source}: {status.st_size} bytes are too many; expected at most {MAX_BYTES}; is it the right file?"
        )


def _open(stream: BinaryIO, source: str) -> tuple[Image, tuple[int, ...]]:
    """The picture, by the first bytes, and its transparent grey or colour, if any.

    Pillow's general open() would refuse maps that are large but fine.
    """
    from PIL import BmpImagePlugin, JpegImagePlugin, PngImagePlugin, PpmImagePlugin

    magic = stream.read(8)
    stream.seek(0)
    if magic == SIGNATURE:
        png = checked_png(stream.read())
        return PngImagePlugin.PngImageFile(BytesIO(png.content)), png.transparent
    if magic[:1] == b"P" and magic[1:2] in b"123456" and (magic[2:3].isspace() or magic[2:3] == b"#"):
        return PpmImagePlugin.PpmImageFile(stream), ()
    if magic.startswith(b"BM"):
        return BmpImagePlugin.BmpImageFile(stream), ()
    if magic.startswith(b"\xff\xd8\xff"):
        return JpegImagePlugin.JpegImageFile(stream), ()
    raise MapError(
        f"{source}: not a picture that can be read; expected PNG, PGM, PPM, PBM, BMP or JPEG "
        "(or a map_server .yaml, or a MovingAI .map that begins with 'type octile'); convert it to PNG"
    )


def _check_size(size: tuple[int, int], source: str) -> None:
    width, height = size
    if width * height > MAX_PIXELS:
        raise MapError(
            f"{source}: size {width}×{height} is too large; expected at most {MAX_PIXELS} pixels in all; "
            "use a coarser map or crop it"
        )


def _to_bytes(image: Image, transparent: tuple[int, ...], source: str) -> npt.NDArray[np.uint8]:
    image.load()
    if image.mode == "F":
        raise MapError(f"{source}: a picture of real numbers has no agreed brightness; convert it to 8-bit PNG")
    wide = image.mode in _WIDE_MODES
    if not wide and image.mode not in _PLAIN_MODES:
        image = image.convert(_plain_mode(image))
    samples: npt.NDArray[Any] = np.asarray(image)
    pixels = ((samples.astype(np.uint32) + 128) // 257 if wide else samples).astype(np.uint8, copy=False)
    return _with_alpha(pixels, samples, transparent) if transparent else pixels


def _with_alpha(
    pixels: npt.NDArray[np.uint8], samples: npt.NDArray[Any], transparent: tuple[int, ...]
) -> npt.NDArray[np.uint8]:
    """The pixels with a channel more: 0 where the samples, before they were scaled, are the transparent ones."""
    shown = (np.atleast_3d(samples) != np.array(transparent)).any(axis=2)
    return np.dstack((pixels, np.where(shown, 255, 0).astype(np.uint8)))


def _plain_mode(image: Image) -> str:
    if image.mode == "1":
        return "L"
    has_alpha = image.mode in ("PA", "La", "RGBa") or (image.mode == "P" and "transparency" in image.info)
    return "RGBA" if has_alpha else "RGB"


def _damaged(source: str, error: Exception) -> MapError:
    why = str(error) or type(error).__name__
    return MapError(f"{source}: damaged picture ({why}); expected a complete picture; save it again")
