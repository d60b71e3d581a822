# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import io
import itertools
import math
import os
import struct
import zlib
from pathlib import Path

import numpy as np
import oracle
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

import lrrt
from lrrt import demo
from lrrt.pictures import decode_picture
from lrrt.png import SIGNATURE

DATA = Path(__file__).parents[1] / "data"


def test_a_bool_array_is_a_map_in_pixels():
    occupied = np.zeros((3, 5), dtype=bool)
    occupied[0, 4] = True
    m = lrrt.OccupancyMap.from_array(occupied)
    assert (m.width, m.height, m.resolution, m.is_metric) == (5, 3, 1.0, False)
    assert m.cells.dtype == np.uint8 and m.cells[0, 4] == 1 and m.cells.sum() == 1
    assert not m.is_free((4.5, 0.5)) and m.is_free((4.5, 1.5)) and not m.is_free((5.0, 1.5))


@given(arrays(np.uint8, st.tuples(st.integers(1, 20), st.integers(1, 20)), elements=st.integers(0, 2)))
def test_cells_round_trip_through_every_layout(cells):
    for layout in (cells, np.asfortranarray(cells), cells[::-1, ::-1].copy()[::-1, ::-1], cells.astype(np.int64)):
        np.testing.assert_array_equal(lrrt.OccupancyMap.from_array(layout).cells, cells)
    np.testing.assert_array_equal(lrrt.OccupancyMap.from_array(cells.tolist()).cells, cells)


def test_cells_are_a_read_only_view_that_keeps_the_map_alive():
    view = lrrt.OccupancyMap.from_array(np.ones((4, 4), dtype=bool)).cells
    assert not view.flags.owndata and not view.flags.writeable
    assert view.sum() == 16
    with pytest.raises(ValueError):
        view[0, 0] = 0


@pytest.mark.parametrize(
    "bad",
    [
        np.zeros((3, 3), dtype=float),
        np.zeros(3, dtype=bool),
        np.zeros((0, 0), dtype=int),
        np.zeros((2, 2, 2), dtype=bool),
        np.full((2, 2), 3),
        np.full((2, 2), 258),
        np.full((2, 2), -1),
        "no array",
    ],
)
def test_arrays_that_are_no_map_are_refused(bad):
    with pytest.raises(lrrt.MapError, match=r"expected|needs"):
        lrrt.OccupancyMap.from_array(bad)


@pytest.mark.parametrize("name", ["pipe.png", "pipe.map", "pipe.yaml"])
def test_a_pipe_is_refused_rather_than_waited_for(tmp_path, name):
    os.mkfifo(tmp_path / name)
    for read in (lrrt.read_map, decode_picture):
        with pytest.raises(lrrt.MapError, match="not a regular file"):
            read(tmp_path / name)
    with pytest.raises(lrrt.MapError, match="not a regular file"):
        lrrt.read_map("/dev/zero")


@pytest.mark.parametrize("resolution", [0.0, -0.05, math.nan, math.inf, 1e-30, 1e300])
def test_resolutions_out_of_range_are_refused(resolution):
    with pytest.raises(lrrt.MapError, match="resolution"):
        lrrt.OccupancyMap.from_array(np.zeros((2, 2), bool), resolution=resolution)


def test_an_origin_without_a_resolution_is_refused():
    with pytest.raises(lrrt.MapError, match="resolution"):
        lrrt.OccupancyMap.from_array(np.zeros((2, 2), bool), origin=(1.0, 2.0, 0.0))


@given(
    st.floats(0.01, 10), st.floats(-100, 100), st.floats(-100, 100), st.floats(-7, 7), st.floats(0, 9), st.floats(0, 6)
)
def test_conversions_round_trip(resolution, x, y, yaw, c, r):
    m = lrrt.OccupancyMap.from_array(np.zeros((6, 9), bool), resolution=resolution, origin=(x, y, yaw))
    np.testing.assert_allclose(m.to_pixel(m.to_world((c, r))), (c, r), atol=1e-6)
    assert m.origin == (x, y, yaw)


def test_metric_maps_have_y_up():
    m = lrrt.OccupancyMap.from_array(np.zeros((6, 9), bool), resolution=0.5, origin=(1.0, 2.0, 0.0))
    np.testing.assert_allclose(m.to_world((0, 6)), (1.0, 2.0))
    np.testing.assert_allclose(m.to_world((9, 0)), (5.5, 5.0))


@pytest.mark.parametrize("name", ["map.png", "map.pgm", "map.bmp"])
def test_pictures_are_read_by_brightness(tmp_path, name):
    occupied = np.random.default_rng(1).random((7, 11)) < 0.4
    Image.fromarray(np.where(occupied, 20, 230).astype(np.uint8)).save(tmp_path / name)
    np.testing.assert_array_equal(lrrt.read_map(tmp_path / name).cells == 1, occupied)


def test_file_names_need_be_no_text(tmp_path):
    cells = np.zeros((4, 6), bool)
    cells[1, 2] = True
    name = os.fsdecode(b"map\xff")
    Image.fromarray(np.where(cells, 0, 255).astype(np.uint8)).save(tmp_path / f"{name}.png", format="png")
    assert np.array_equal(lrrt.read_map(tmp_path / f"{name}.png").cells == 1, cells)
    folder = tmp_path / name
    folder.mkdir()
    with pytest.raises(lrrt.MapError, match="not a regular file"):
        lrrt.read_map(folder)
    (tmp_path / "one.scen").write_bytes(b"version 1\n0\tmap\xff.map\t6\t4\t0\t0\t1\t0\t1\n")
    assert lrrt.read_scenarios(tmp_path / "one.scen")[0].map == f"{name}.map"


def test_transparent_pixels_are_unknown(tmp_path):
    rgba = np.full((3, 3, 4), 255, dtype=np.uint8)
    rgba[1, 1] = (0, 0, 0, 0)
    Image.fromarray(rgba).save(tmp_path / "map.png")
    assert lrrt.read_map(tmp_path / "map.png").cells[1, 1] == 2


def chunk(name: bytes, data: bytes = b"", wrong: int = 0) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data) ^ wrong)


def png(
    rows: list[bytes], depth: int, color: int, *before: bytes, width: int = 0, after: tuple[bytes, ...] = ()
) -> bytes:
    """A PNG of bytes of rows, with chunks before its pixels, and other chunks in place of its end."""
    width = width or len(rows[0]) * 8 // depth // {0: 1, 2: 3, 3: 1}[color]
    header = struct.pack(">IIBBBBB", width, len(rows), depth, color, 0, 0, 0)
    pixels = chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows)))
    return b"".join([SIGNATURE, chunk(b"IHDR", header), *before, pixels, *(after or (chunk(b"IEND"),))])


def cells_of(folder: Path, content: bytes) -> list[int]:
    (folder / "map.png").write_bytes(content)
    return lrrt.read_map(folder / "map.png").cells[0].tolist()


def test_no_bit_of_a_png_can_flip_unseen(tmp_path):
    buffer = io.BytesIO()
    Image.fromarray(np.where(np.random.default_rng(1).random((24, 24)) < 0.7, 255, 0).astype(np.uint8)).save(
        buffer, "PNG"
    )
    content = buffer.getvalue()
    for at, bit in itertools.product(range(len(SIGNATURE), len(content)), (0, 3, 7)):
        flipped = bytearray(content)
        flipped[at] ^= 1 << bit
        (tmp_path / "map.png").write_bytes(flipped)
        with pytest.raises(lrrt.MapError, match="damaged picture"):
            decode_picture(tmp_path / "map.png")


PALETTE = chunk(b"PLTE", bytes([0, 0, 0, 255, 255, 255]))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (png([b"\xff"], 8, 0, after=(b"",)), "it is cut off"),
        (png([b"\xff"], 8, 0)[:-1], "it is cut off"),
        (png([b"\xff"], 8, 0, after=(chunk(b"IEND", wrong=1),)), "IEND does not match its checksum"),
        (png([b"\xff"], 8, 0, chunk(b"tEXt", b"a\0b", wrong=1)), "tEXt does not match its checksum"),
        (png([b"\xff"], 8, 0, chunk(b"ABCD")), "ABCD is unknown"),
        (png([b"\xff"], 8, 0, chunk(b"a\0cd")), "is no name of a chunk"),
        (png([b"\xff"], 8, 0, after=(chunk(b"tEXt"), chunk(b"IDAT"), chunk(b"IEND"))), "one run of IDAT"),
        (SIGNATURE + chunk(b"IEND"), "its chunks are not IHDR"),
        (SIGNATURE + chunk(b"IHDR", b"short") + chunk(b"IDAT") + chunk(b"IEND"), "its header"),
        (png([b"\0\1"], 8, 3), "no palette"),
        (png([b"\0\1"], 8, 3, chunk(b"PLTE", b"four")), "no palette"),
        (png([b"\0\1"], 8, 3, PALETTE, PALETTE), "in this order"),
        (png([b"\0\1"], 8, 3, chunk(b"tRNS", b"\0"), PALETTE), "in this order"),
        (png([b"\xff"], 8, 0, chunk(b"tRNS", b"\0")), "its transparency"),
    ],
    ids=lambda value: value if isinstance(value, str) else "png",
)
def test_damaged_pngs_are_refused(tmp_path, content, words):
    with pytest.raises(lrrt.MapError, match=rf"map\.png: damaged picture.*{words}"):
        cells_of(tmp_path, content)


def transparent(*values: int) -> bytes:
    return chunk(b"tRNS", struct.pack(f">{len(values)}H", *values))


@pytest.mark.parametrize(
    ("content", "cells"),
    [
        (png([b"\x00\x32\xc8\xff"], 8, 0, transparent(255)), [1, 1, 0, 2]),
        (png([b"\x0f\xf3"], 4, 0, transparent(15)), [1, 2, 2, 1]),
        (png([b"\xa0"], 1, 0, transparent(1), width=4), [2, 1, 2, 1]),
        (png([struct.pack(">3H", 65535, 65534, 0)], 16, 0, transparent(65535)), [2, 0, 1]),
        (png([bytes([0, 0, 0, 255, 255, 255, 255, 255, 0])], 8, 2, transparent(255, 255, 255)), [1, 2, 0]),
        (png([struct.pack(">6H", *[65535] * 3, *[257] * 3)], 16, 2, transparent(*[65535] * 3)), [2, 1]),
        (png([b"\0\1"], 8, 3, PALETTE, chunk(b"tRNS", b"\xff\0")), [1, 2]),
    ],
    ids=["grey 8", "grey 4", "grey 1", "grey 16", "colour 8", "colour 16", "palette"],
)
def test_a_transparent_colour_of_a_png_is_unknown(tmp_path, content, cells):
    assert cells_of(tmp_path, content) == cells


@pytest.mark.parametrize("name", [b"zTXt", b"iCCP"])
def test_texts_and_profiles_in_a_png_are_passed_over_however_large(tmp_path, name):
    packed = chunk(name, b"a\0\0" + zlib.compress(bytes(100_000_000), 1))
    assert cells_of(tmp_path, png([b"\0\xff"], 8, 0, packed)) == [1, 0]


def test_map_server_maps_are_in_metres():
    m = lrrt.read_map(DATA / "room.yaml")
    assert m.is_metric and m.resolution > 0 and (m.cells == 0).any()


def test_moving_ai_maps_and_scenarios():
    m = lrrt.read_map(DATA / "room.map")
    assert not m.is_metric
    scenarios = lrrt.read_scenarios(DATA / "room.scen")
    for scenario in scenarios:
        path = lrrt.shortest_path(m, scenario.start, scenario.goal)
        assert oracle.length(path) == pytest.approx(scenario.optimal_length, abs=1e-3)
    assert scenarios


def test_errors_may_quote_bytes_that_are_no_text(tmp_path):
    (tmp_path / "x.map").write_bytes(b"type \xff\xfe\nheight 1\nwidth 1\nmap\n.\n")
    (tmp_path / "x.yaml").write_bytes(b"image: a.png\nresolution: \xff\n")
    for name in ("x.map", "x.yaml"):
        with pytest.raises(lrrt.MapError, match=name):
            lrrt.read_map(tmp_path / name)


@pytest.mark.parametrize("name", ["missing.png", "missing.yaml", "missing.map"])
def test_missing_files_are_named(tmp_path, name):
    with pytest.raises(lrrt.MapError, match=name):
        lrrt.read_map(tmp_path / name)


@settings(max_examples=60)
@given(st.binary(max_size=200), st.sampled_from(["x.png", "x.yaml", "x.map", "x.pgm", "x.jpg"]))
def test_rubbish_is_a_map_error(tmp_path_factory, content, name):
    path = tmp_path_factory.mktemp("rubbish") / name
    path.write_bytes(content)
    with pytest.raises(lrrt.MapError):
        lrrt.read_map(path)


@settings(max_examples=40)
@given(arrays(bool, st.tuples(st.integers(2, 16), st.integers(2, 16))), st.randoms(use_true_random=False))
def test_shortest_paths_are_free_and_exist_where_a_flood_fill_says_so(occupied, random):
    free = ~occupied
    if not free.any():
        return
    m = lrrt.OccupancyMap.from_array(occupied)
    pixels = np.argwhere(free)
    (r0, c0), (r1, c1) = (pixels[random.randrange(len(pixels))] for _ in range(2))
    start, goal = (c0 + 0.5, r0 + 0.5), (c1 + 0.5, r1 + 0.5)
    if not oracle.reachable(free, (c0, r0))[r1, c1]:
        with pytest.raises(lrrt.RequestError, match="no free path"):
            lrrt.shortest_path(m, start, goal)
        return
    path = lrrt.shortest_path(m, start, goal)
    assert oracle.first_collision(free, path) is None
    np.testing.assert_array_equal(path[[0, -1]], (start, goal))


def test_the_sample_map_is_a_maze_with_a_way():
    m = demo.sample_map()
    assert len(lrrt.shortest_path(m, demo.START, demo.GOAL)) > 500
