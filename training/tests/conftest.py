# SPDX-License-Identifier: BSD-3-Clause
"""A small store of mazes and a small trained run, made once for all tests."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
import torch
from helpers import tiny_config

from lrrt_training import store as store_module
from lrrt_training.store import MazeStore

COUNTS = {"train": 24, "evaluation": 6, "test": 6}
LEVELS = (5, 7, 9, 11, 13, 21)


@pytest.fixture(scope="session", autouse=True)
def one_thread():
    """The machine may be shared."""
    torch.set_num_threads(1)


@pytest.fixture(scope="session", autouse=True)
def few_mazes():
    """Stores that the code opens by itself hold few mazes, too."""
    with pytest.MonkeyPatch.context() as patch:
        for split, count in COUNTS.items():
            patch.setitem(store_module.DEFAULT_COUNTS, split, count)
        yield


@pytest.fixture(scope="session")
def store(tmp_path_factory, few_mazes) -> MazeStore:
    """A quarter of the mazes has loops, as in a real store."""
    made = MazeStore(tmp_path_factory.mktemp("mazes"))
    made.generate(list(LEVELS))
    return made


@pytest.fixture(scope="session")
def perfect_store(tmp_path_factory, few_mazes) -> MazeStore:
    """Mazes without loops: the path between two blocks is unique."""
    made = MazeStore(tmp_path_factory.mktemp("perfect"), seed=2, braided_share=0.0)
    made.generate(list(LEVELS), ("train",))
    return made


@pytest.fixture(scope="session")
def trained(tmp_path_factory, store) -> Path:
    """Folder of a run of two short stages that nothing interrupted."""
    from lrrt_training.train import train

    config = tiny_config(tmp_path_factory.mktemp("runs"), store.folder, workers=1)
    return train(config).parent


@pytest.fixture
def keep_sigint():
    """Lightning ignores Ctrl-C for good once it has seen one."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)
