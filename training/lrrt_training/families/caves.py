# SPDX-License-Identifier: BSD-3-Clause
"""Caves: cellular automata, thresholds of noise, tunnels of drunkards."""

from __future__ import annotations

import math

import numpy as np
from scipy import ndimage

from lrrt_training.families.draw import (
    Shape,
    chance,
    disc_offsets,
    fill_disc,
    frame,
    log_uniform,
    random_shape,
    smooth_noise,
    stamp,
    stroke,
)

MOST_JOINED = 8


def _neighbour_count(mask: np.ndarray) -> np.ndarray:
    """Set pixels in the 3×3 neighbourhood of every pixel, all set outside the map."""
    padded = np.pad(mask.view(np.uint8), 1, constant_values=1)
    rows = padded[:-2] + padded[1:-1] + padded[2:]
    return rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:]


def _winding(rng: np.random.Generator, source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Corners of a line that strays from the straight one between its ends."""
    part = np.linspace(0.0, 1.0, 9)[:, None]
    straying = rng.standard_normal((9, 2)) * (part * (1 - part)) * 0.35 * math.dist(source, target)
    return source + (target - source) * part + straying


def _join(rng: np.random.Generator, occupied: np.ndarray, thickness: int) -> None:
    """Tunnels from the largest cave to a few others."""
    labels, count = ndimage.label(~occupied)
    if count < 2:
        return
    sizes = np.bincount(labels.ravel())[1:]
    order = np.argsort(-sizes, kind="stable")[:MOST_JOINED]
    flat, width = labels.ravel(), occupied.shape[1]
    main = np.flatnonzero(flat == order[0] + 1)
    for other in order[1:]:
        if sizes[other] < 8:
            break
        pixels = np.flatnonzero(flat == other + 1)
        target = np.array(divmod(pixels[rng.integers(len(pixels))], width))
        candidates = np.stack(divmod(main[rng.integers(len(main), size=24)], width), axis=1)
        source = candidates[((candidates - target) ** 2).sum(axis=1).argmin()]
        stroke(occupied, _winding(rng, source, target), thickness, value=False)


def _enlarged(rng: np.random.Generator, coarse: np.ndarray, shape: Shape) -> np.ndarray:
    """A coarse map in the pixels of ``shape``, its corners left or rounded."""
    rows = np.arange(shape[0]) * coarse.shape[0] // shape[0]
    cols = np.arange(shape[1]) * coarse.shape[1] // shape[1]
    occupied = coarse[rows[:, None], cols]
    scale = shape[0] // coarse.shape[0]
    if scale >= 2 and chance(rng, 0.7):
        blurred = ndimage.uniform_filter(occupied.astype(np.float32), 2 * (scale // 2) + 1, mode="nearest")
        occupied = blurred + 0.1 * smooth_noise(rng, shape, 2 * scale) > 0.5
    return occupied


def automata_caves(rng: np.random.Generator, side: int) -> np.ndarray:
    """Random pixels that a majority rule lumps together, at several scales."""
    shape = random_shape(rng, side)
    scale = max(1, round(log_uniform(rng, 1.5, 7.0) * side / 256))
    coarse = rng.random((shape[0] // scale, shape[1] // scale), dtype=np.float32) < rng.uniform(0.41, 0.49)
    for _ in range(rng.integers(3, 7)):
        coarse = _neighbour_count(coarse) >= 5
    if chance(rng, 0.7):
        _join(rng, coarse, max(2, 4 // scale))
    occupied = _enlarged(rng, coarse, shape)
    frame(occupied, scale)
    return occupied


def noise_caves(rng: np.random.Generator, side: int) -> np.ndarray:
    """Smooth noise cut at a threshold (islands and bays) or near zero (winding passages)."""
    shape = random_shape(rng, side)
    period = log_uniform(rng, side / 16, side / 4)
    field = smooth_noise(rng, shape, period)
    for octave in range(1, rng.integers(1, 4)):
        field += smooth_noise(rng, shape, period / 2**octave) * np.float32(0.5**octave)
    winding = chance(rng, 0.4)
    if winding:
        field = abs(field)
    share = rng.uniform(0.3, 0.5) if winding else rng.uniform(0.4, 0.75)
    occupied = field > np.quantile(field[::4, ::4], share)
    if chance(rng, 0.5):
        _join(rng, occupied, max(3, side // 50))
    if chance(rng, 0.6):
        frame(occupied, int(rng.integers(1, 5)))
    return occupied


def _fold(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Reflects a walk at the ends of an interval."""
    span = high - low
    return low + span - abs((values - low) % (2 * span) - span)


def _walks(rng: np.random.Generator, shape: Shape, margin: float) -> list[np.ndarray]:
    """Walks with slowly changing direction; each begins on one before it, or anywhere and returns to it."""
    length = int(max(shape) * rng.uniform(0.8, 2.5))
    bend = log_uniform(rng, 0.08, 0.35)
    upright = chance(rng, 0.3)
    walks: list[np.ndarray] = []
    for _ in range(rng.integers(3, 11)):
        start = rng.uniform(0.1, 0.9, 2) * shape
        if walks:
            before = walks[rng.integers(len(walks))]
            meeting = before[rng.integers(len(before))]
            if chance(rng, 0.5):
                way = _winding(rng, meeting, start)
                at, steps = np.arange(len(way)), np.linspace(0, len(way) - 1, int(math.dist(meeting, start)) + 2)
                walks.append(np.stack([np.interp(steps, at, way[:, i]) for i in range(2)], axis=1))
            else:
                start = meeting
        heading = rng.uniform(0, 2 * math.pi) + np.cumsum(bend * rng.standard_normal(length))
        if upright:
            heading = np.rint(heading / (math.pi / 2)) * (math.pi / 2)
        steps = np.stack((np.cos(heading), np.sin(heading)), axis=1)
        walk = start + np.concatenate((np.zeros((1, 2)), steps.cumsum(axis=0)))
        walks.append(np.stack([_fold(walk[:, i], margin, shape[i] - 1 - margin) for i in range(2)], axis=1))
    return walks


def _grid_walk(rng: np.random.Generator, shape: Shape) -> np.ndarray:
    """A drunkard on a coarse grid: every step in one of four directions."""
    scale = max(2, round(log_uniform(rng, 3, 9) * max(shape) / 256))
    height, width = shape[0] // scale, shape[1] // scale
    coarse = np.ones((height, width), dtype=bool)
    run = int(rng.integers(1, 6))
    start = np.array([height // 2, width // 2])
    for _ in range(rng.integers(2, 6)):
        turns = rng.integers(4, size=max(8, height * width // (3 * run))).repeat(run)
        steps = np.array([(-1, 0), (1, 0), (0, -1), (0, 1)])[turns]
        walk = start + steps.cumsum(axis=0)
        walk = np.stack((_fold(walk[:, 0], 1, height - 2), _fold(walk[:, 1], 1, width - 2)), axis=1)
        coarse[walk[:, 0], walk[:, 1]] = False
        other = rng.integers(1, (height - 1, width - 1))  # a straight way to where the next one begins
        meeting = walk[rng.integers(len(walk))]
        coarse[min(meeting[0], other[0]) : max(meeting[0], other[0]) + 1, meeting[1]] = False
        coarse[other[0], min(meeting[1], other[1]) : max(meeting[1], other[1]) + 1] = False
        start = other
    return _enlarged(rng, coarse, shape)


def tunnels(rng: np.random.Generator, side: int) -> np.ndarray:
    """What drunkards dig: winding tunnels that meet, and chambers along them."""
    shape = random_shape(rng, side)
    if chance(rng, 0.3):
        return _grid_walk(rng, shape)
    occupied = np.ones(shape, dtype=bool)
    thickness = max(3, round(log_uniform(rng, 3, 12) * side / 256))
    for walk in _walks(rng, shape, thickness + 1):
        size = max(3, round(thickness * rng.uniform(0.7, 1.4)))
        stamp(occupied, walk[:: max(1, size // 4)], disc_offsets(size), value=False)
        if chance(rng, 0.4):
            for _ in range(rng.integers(1, 4)):
                fill_disc(occupied, walk[rng.integers(len(walk))], size * rng.uniform(1.0, 3.0), value=False)
    frame(occupied, 1)
    return occupied
