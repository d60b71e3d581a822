# SPDX-License-Identifier: BSD-3-Clause
"""Fills docs/benchmarks.md with what the results in docs/results say; ``--help`` tells how."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from lrrt.report import PlanResults, PredictResults, ResultError, load
from lrrt.report.content import chapters, facts_of, replay_command
from lrrt.report.markdown import code, escaped, picture_lines, table_lines
from lrrt.report.results import stem
from lrrt.report.slimming import store
from lrrt.report.style import Picture, svg_file
from lrrt.report.views import VIEWS, kind_of, table_of
from lrrt.report.writing import made_folder, write_file

DOCS = Path(__file__).parent
PAGE, RESULTS, IMAGES = "benchmarks.md", "results", "images"  #: in the folder of the documents
ENDING, PREFIX = ".json.gz", "bench-"  #: of stored results; of the figures that this program makes
BARE = {"plan": ["first-path", "facts"], "predict": ["predict", "facts"]}  #: what a mark without views shows
EXIT_DIFFERS, EXIT_BAD_INPUT = 1, 2

_BEGIN = re.compile(r"<!-- results: *(.*?) *-->")
_END = "<!-- end of results -->"

_HELP = """Fills docs/benchmarks.md with what the results in docs/results say.

Example: [bold]python docs/make_benchmarks.py add paper.json[/bold] stores what lrrt_bench --json wrote.

Example: [bold]python docs/make_benchmarks.py[/bold] writes tables and figures anew.

Example: [bold]python docs/make_benchmarks.py --check[/bold] writes nothing and exits with 1 where the text differs.

What it writes stands between two marks, each a line of its own; all around them is written by hand:

[bold]<!-- results: NAME VIEW VIEW … -->[/bold]

[bold]<!-- end of results -->[/bold]

NAME is that of a stored result. VIEWs, shown one below the other, are:

{views}

Without a VIEW: {bare}. In tables of planners the best of a group is bold: the best number among those that speak for
the most runs.

Exit codes: 0 done, 1 --check found differences, 2 bad input."""


@dataclass(frozen=True)
class Block:
    """A pair of marks."""

    line: int  #: of the first mark, from 1
    mark: str
    name: str  #: of the result
    views: list[str]


@dataclass
class Folder:
    """The documents: the page, the results and what they look like."""

    path: Path
    _loaded: dict[str, PlanResults | PredictResults] = field(default_factory=dict)
    _pictures: dict[str, dict[str, Picture]] = field(default_factory=dict)

    def results(self, name: str) -> PlanResults | PredictResults:
        """A stored result by its name."""
        if name not in self._loaded:
            folder = self.path / RESULTS
            known = sorted(file.name.removesuffix(ENDING) for file in folder.glob("*" + ENDING))
            if name not in known:
                expected = ", ".join(known) or "none: add one first, see --help"
                raise ResultError(f"{folder} has no result '{name}'; expected one of {expected}")
            self._loaded[name] = load(folder / (name + ENDING))
        return self._loaded[name]

    def picture(self, name: str, picture: str) -> Picture:
        """A figure of a result's report by its name."""
        if name not in self._pictures:
            (chapter,) = chapters([self.results(name)])
            self._pictures[name] = {p.name: p for section in chapter.sections for p in section.pictures}
        if picture not in self._pictures[name]:
            known = ", ".join(f"figure:{p}" for p in self._pictures[name]) or "none"
            raise ResultError(f"result '{name}' has no figure '{picture}'; expected one of {known}")
        return self._pictures[name][picture]


def parts_of(page: Path) -> list[str | Block]:
    """The page in pieces: text and blocks.

    Raises:
        ResultError: the page cannot be read, or its marks do not pair.
    """
    try:
        lines = page.read_text(encoding="utf-8").splitlines(keepends=True)
    except OSError as error:
        raise ResultError(f"{page}: cannot be read ({error.strerror or error}); expected the page") from error
    parts: list[str | Block] = []
    begun, kept = 0, ""  # line of a mark that has no end yet; what was read since
    for number, line in enumerate([*lines, ""], 1):
        begins, ends = _BEGIN.fullmatch(line.strip()) is not None, line.strip() == _END
        if (begins or not line) if begun else ends:
            raise ResultError(f"{page}:{begun or number}: a mark stands alone; expected a mark, then {_END}")
        if begins:
            parts.append(kept)
            begun, kept = number, ""
        elif ends:
            parts.append(_block(f"{page}:{begun}", begun, lines[begun - 1].strip()))
            begun, kept = 0, ""  # what stood between them is made anew
        else:
            kept += line
    return [*parts, kept]


def _block(place: str, line: int, mark: str) -> Block:
    begin = _BEGIN.fullmatch(mark)
    words = begin[1].split() if begin else []
    if not words:
        raise ResultError(f"{place}: {mark} names no result; expected <!-- results: NAME VIEW … -->")
    return Block(line, mark, words[0], words[1:])


def body_of(folder: Folder, block: Block) -> str:
    """What a block has to say, in Markdown.

    Raises:
        ResultError: no such result or view; names those that there are.
    """
    results = folder.results(block.name)
    views = block.views or BARE[kind_of(results)]
    return "\n\n".join(_view_text(folder, results, block.name, view) for view in views) + "\n"


def _view_text(folder: Folder, results: PlanResults | PredictResults, name: str, view: str) -> str:
    if view == "facts":
        facts = " · ".join(f"{key}: {escaped(value)}" for key, value in facts_of(results))
        command = replay_command(f"docs/{RESULTS}/{name}{ENDING}", "build/release/bench/lrrt_bench")
        return f"{facts} · Run it again: {code(command)}"
    if view.startswith("figure:"):
        picture = view.removeprefix("figure:")
        return picture_lines(folder.picture(name, picture), f"{IMAGES}/{file_name(name, picture)}")
    return table_lines(table_of(results, view, also=("facts", "figure:NAME")))


def file_name(name: str, picture: str) -> str:
    """The file of a figure."""
    return f"{PREFIX}{name}-{picture}.svg"


def made_text(folder: Folder, parts: list[str | Block]) -> str:
    """The page as the results give it; errors name the line of the mark."""
    text = ""
    for part in parts:
        if isinstance(part, str):
            text += part
            continue
        try:
            text += f"{part.mark}\n{body_of(folder, part)}{_END}\n"
        except ResultError as error:
            raise ResultError(f"{folder.path / PAGE}:{part.line}: {error}") from error
    return text


def figures_of(folder: Folder, parts: list[str | Block]) -> dict[str, Picture]:
    """The figures that the page shows, by file name."""
    words = [
        (part.name, view.removeprefix("figure:"))
        for part in parts
        if isinstance(part, Block)
        for view in part.views
        if view.startswith("figure:")
    ]
    return {file_name(*word): folder.picture(*word) for word in words}


def view_lines() -> str:
    """The views and what they tell, for the help."""
    lines = []
    for name, view in VIEWS.items():
        others = ", ".join(f"{name}:{choice}" for choice in view.choices[1:])
        lines.append(f"[bold]{name}[/bold]: {view.says}" + (f"; also {others}" if others else ""))
    lines.append("[bold]facts[/bold]: machine, software, date, how many runs, and the command that runs it again")
    lines.append("[bold]figure:NAME[/bold]: a figure of the report; a wrong name is answered with those that there are")
    return "\n\n".join(lines)


_BARE_WORDS = ", or ".join(f"{' '.join(views)} (kind {kind})" for kind, views in BARE.items())
app = typer.Typer(add_completion=False, rich_markup_mode="rich")


@app.callback(invoke_without_command=True, help=_HELP.format(views=view_lines(), bare=_BARE_WORDS))
def main(
    context: typer.Context,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; exit 1 where the text differs.")] = False,
    docs: Annotated[Path, typer.Option(metavar="FOLDER", help=f"Where {PAGE} and its folders are.")] = DOCS,
) -> None:
    """Writes the page and its figures, or compares the page."""
    context.obj = docs
    if context.invoked_subcommand is not None:
        if check:
            raise typer.BadParameter("goes without a command", param_hint="--check")
        return
    folder = Folder(docs)
    try:
        parts = parts_of(docs / PAGE)
        text, figures = made_text(folder, parts), figures_of(folder, parts)
        if check:
            _compare(docs, text, figures)
        else:
            _write(docs, text, figures)
    except ResultError as error:
        _fail(error)


@app.command("add")
def add_command(
    context: typer.Context,
    result: Annotated[Path, typer.Argument(metavar="RESULT.json", help="File that lrrt_bench --json wrote.")],
    name: Annotated[str, typer.Option(metavar="NAME", help="What marks call it; the file's name by default.")] = "",
) -> None:
    """Store a result for the page: gzipped, without the steps of cost histories that no figure shows.

    A result of that name is replaced. The page stays as it is until it is made anew.
    """
    name = name or stem(result)
    try:
        if not re.fullmatch(r"[a-z0-9][a-z0-9_-]*", name):
            raise ResultError(f"name '{name}': expected small letters, digits, - and _; give one with --name")
        target = made_folder(context.obj / RESULTS) / (name + ENDING)
        before, after = store(result, target)
    except ResultError as error:
        _fail(error)
    typer.echo(f"{target}: {after:,d} bytes ({result} has {before:,d})")


def _write(docs: Path, text: str, figures: dict[str, Picture]) -> None:
    made = [write_file(made_folder(docs / IMAGES) / name, svg_file(picture)) for name, picture in figures.items()]
    for path in [write_file(docs / PAGE, text), *made]:
        typer.echo(f"{path}: {path.stat().st_size:,d} bytes")
    for path in sorted(set((docs / IMAGES).glob(PREFIX + "*")) - set(made)):
        path.unlink()
        typer.echo(f"{path}: removed, the page does not show it any more")


def _compare(docs: Path, text: str, figures: dict[str, Picture]) -> None:
    page = docs / PAGE
    old, new = page.read_text(encoding="utf-8").splitlines(), text.splitlines()
    lines = list(difflib.unified_diff(old, new, str(page), "what the results give", lineterm="", n=0))
    lines += [f"{docs / IMAGES / name}: is missing" for name in figures if not (docs / IMAGES / name).is_file()]
    if lines:
        typer.echo("\n".join([*lines, "", f"{page} is not what the results give; to write it anew: python {__file__}"]))
        raise typer.Exit(EXIT_DIFFERS)
    typer.echo(f"{page} is what the results give")


def _fail(error: Exception) -> NoReturn:
    typer.echo(f"error: {error}", err=True)
    raise typer.Exit(EXIT_BAD_INPUT) from error


if __name__ == "__main__":
    app()
