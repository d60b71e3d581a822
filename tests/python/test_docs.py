# SPDX-License-Identifier: BSD-3-Clause
"""The pages tell the truth: their Python runs, their commands work, their C++ stands in the examples, links lead on."""

from __future__ import annotations

import inspect
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

import lrrt
from lrrt import cli

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), ROOT / "models/README.md", ROOT / "training/README.md"]
)
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
BENCH = next(iter(sorted(ROOT.glob("build/*/bench/lrrt_bench"))), None)
NOT_RUN = ("lrrt report", "lrrt sweep")  # they need results of lrrt_bench, or a cluster; test_report and test_sweep do


def blocks(page: Path, language: str) -> list[str]:
    return [text for name, text in BLOCK.findall(page.read_text(encoding="utf-8")) if name == language]


def pages_with(language: str) -> list:
    """The pages that have blocks in a language, named after their place."""
    return [pytest.param(p, id=p.relative_to(ROOT).as_posix()) for p in PAGES if blocks(p, language)]


@pytest.fixture
def files(tmp_path, monkeypatch) -> None:
    """The folder that the pages have in mind: a maze of 256×256 pixels, an office of 20×14 m, a model."""
    maze = np.full((256, 256), 255, dtype=np.uint8)
    maze[:200, 80:90] = maze[60:, 160:170] = 0
    Image.fromarray(maze).save(tmp_path / "maze.png")
    office = np.full((280, 400), 254, dtype=np.uint8)
    office[:200, 150:155] = office[100:, 250:255] = 0
    Image.fromarray(office).save(tmp_path / "office.png")
    (tmp_path / "office.yaml").write_text(
        "image: office.png\nresolution: 0.05\norigin: [-2, -1, 0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    (tmp_path / "first.onnx").symlink_to(ROOT / "models" / "default.onnx")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("page", pages_with("python"))
def test_python_runs(page, files, capsys):
    """All blocks of a page, one after the other, as a reader would type them."""
    variables: dict[str, object] = {}
    for block in blocks(page, "python"):
        exec(compile(block, str(page), "exec"), variables)
    result = variables["result"]
    assert isinstance(result, lrrt.PlanResult) and result.solved


@pytest.mark.parametrize("page", pages_with("sh"))
def test_commands_work(page, files):
    """Commands of lrrt are run; targets of make must be there."""
    targets = re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE)
    for line in "".join(blocks(page, "sh")).replace("\\\n", " ").splitlines():
        program, *words = shlex.split(line, comments=True) or [""]
        if program == "make":
            assert all(word in targets for word in words if "=" not in word), line
        if program == "lrrt" and not line.startswith(NOT_RUN):
            run = CliRunner().invoke(cli.app, words)
            assert run.exit_code == 0, f"{line}\n{run.output}"


@pytest.mark.skipif(BENCH is None, reason="lrrt_bench is not built")
def test_suite_of_the_benchmark_guide_runs(files, tmp_path):
    (suite,) = blocks(ROOT / "docs" / "guides" / "benchmark.md", "yaml")
    (tmp_path / "my_suite.yaml").write_text(suite)
    words = [str(BENCH), "--suite", "my_suite.yaml", "--json", "office.json"]
    run = subprocess.run(words, capture_output=True, text=True, timeout=250)
    assert run.returncode == 0, run.stderr
    assert CliRunner().invoke(cli.app, ["report", "office.json", "--output", "office.html"]).exit_code == 0


def paragraphs(code: str) -> list[str]:
    """Pieces between empty lines, without indentation and comments at the end."""
    lines = [re.sub(r"\s+//.*", "", line).strip() for line in code.splitlines()]
    return [piece.strip() for piece in re.split(r"\n{2,}", "\n".join(lines)) if piece.strip()]


@pytest.mark.parametrize("page", pages_with("cpp"))
def test_cpp_stands_in_an_example(page):
    """Every paragraph of a block is, line by line, part of one program of examples/, which is built and run."""
    programs = {path.name: "\n".join(paragraphs(path.read_text())) for path in (ROOT / "examples").glob("*.cpp")}
    for block in blocks(page, "cpp"):
        holding = [name for name, text in programs.items() if all(piece in text for piece in paragraphs(block))]
        assert holding, f"in no example:\n{block}"


@pytest.mark.parametrize("page", [pytest.param(page, id=page.relative_to(ROOT).as_posix()) for page in PAGES])
def test_links_lead_to_files(page):
    for link in LINK.findall(page.read_text(encoding="utf-8")):
        target = link.partition("#")[0]
        if target and "://" not in target:
            assert (page.parent / target).exists(), f"{page}: {link}"


def test_all_that_is_public_has_a_docstring():
    """Attributes as well; what pybind11 writes about types by itself is no docstring."""
    missing = []
    for name in lrrt.__all__:
        symbol = getattr(lrrt, name)
        members = {f".{k}": v for k, v in vars(symbol).items() if k[0] != "_"} if inspect.isclass(symbol) else {}
        for suffix, value in {"": symbol, **members}.items():
            text = re.sub(r"^\w+\(.*\) -> .*$", "", value.__doc__ or "", flags=re.MULTILINE)
            if not text.strip() and not isinstance(value, str):
                missing.append(name + suffix)
    assert missing == []
