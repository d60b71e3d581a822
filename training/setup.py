# SPDX-License-Identifier: BSD-3-Clause
"""The version is that of the library, which CMakeLists.txt states; all else stands in pyproject.toml."""

import re
from pathlib import Path

from setuptools import setup

project = (Path(__file__).resolve().parents[1] / "CMakeLists.txt").read_text(encoding="utf-8")
match = re.search(r"project\(lrrt VERSION ([0-9.]+)", project)
if match is None:
    raise SystemExit("CMakeLists.txt states no version: expected 'project(lrrt VERSION x.y.z'")
setup(version=match.group(1))
