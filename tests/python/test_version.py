# SPDX-License-Identifier: BSD-3-Clause
"""CMakeLists.txt states the version; whatever tells one tells that. (lrrt_bench and the C++ package: ctest.)"""

from __future__ import annotations

import re
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

import lrrt
from lrrt import _core

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def stated() -> str:
    match = re.search(r"project\(lrrt VERSION ([0-9]+\.[0-9]+\.[0-9]+)\n", (ROOT / "CMakeLists.txt").read_text())
    assert match is not None
    return match.group(1)


def test_package_and_compiled_module_have_the_stated_version(stated):
    assert lrrt.__version__ == version("lrrt") == _core.__version__ == stated


def test_the_command_prints_it(stated):
    for option in (["--version"], ["--version", "plan"]):
        run = subprocess.run([sys.executable, "-m", "lrrt", *option], capture_output=True, text=True, check=True)
        assert run.stdout == f"lrrt {stated}\n"


def test_training_takes_it(stated):
    pytest.importorskip("setuptools", minversion="77")  # reads the licence as pyproject.toml states it
    command = [sys.executable, "setup.py", "--version"]
    run = subprocess.run(command, cwd=ROOT / "training", capture_output=True, text=True, check=True)
    assert run.stdout.split() == [stated]
