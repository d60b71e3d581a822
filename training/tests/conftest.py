# SPDX-License-Identifier: BSD-3-Clause
"""A small store of mazes and a small trained run, made once for all tests."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
import torch
from helpers import write_config

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
    """Folder of a run of two short stages that nothing interrupted; a process of its own makes the samples."""
    from lrrt_training.train import train

    folder = tmp_path_factory.mktemp("trained")
    config = write_config(folder, store.folder, {"data.workers": 1})
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        return folder / train(["--config", str(config)])


@pytest.fixture
def keep_sigint():
    """Lightning ignores Ctrl-C for good once it has seen one."""
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)
