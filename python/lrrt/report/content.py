# SPDX-License-Identifier: BSD-3-Clause
"""What a report says, in order; ``html`` and ``markdown`` only set it."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from lrrt.report.figures import group_pictures, overview_pictures, predict_pictures
from lrrt.report.formatting import counted, slug
from lrrt.report.results import Head, PlanResults, PredictResults
from lrrt.report.style import Look, Picture, looks
from lrrt.report.tables import Table, group_tables, predict_table, settings_table

_VERSIONS = {"lrrt": "lrrt", "ompl": "OMPL", "onnxruntime": "ONNX Runtime", "compiler": "", "build": "build"}


@dataclass(frozen=True)
class Section:
    """A heading with pictures and tables."""

    title: str
    pictures: list[Picture]
    tables: list[Table]


@dataclass(frozen=True)
class Chapter:
    """One result file."""

    title: str
    facts: list[tuple[str, str]]  #: name and value
    command: str  #: runs it again
    settings: Table | None
    sections: list[Section] = field(default_factory=list)


def chapters(files: Sequence[PlanResults | PredictResults]) -> list[Chapter]:
    """A chapter for each file. A planner looks the same in all of them, and no two figures have the same name."""
    plans = [results for results in files if isinstance(results, PlanResults)]
    names = [name for results in plans for name in results.planners()]
    all_looks = looks(names, plans[0].baseline) if plans else {}
    made = [_chapter(results, all_looks) for results in files]
    prefixes = [f"{slug(results.head.path.stem)}-" if len(files) > 1 else "" for results in files]
    taken: set[str] = set()
    return [_renamed(chapter, prefix, taken) for chapter, prefix in zip(made, prefixes)]


def _chapter(results: PlanResults | PredictResults, all_looks: dict[str, Look]) -> Chapter:
    command = results.head.command or f"lrrt_bench --replay {shlex.quote(results.head.path.name)}"
    if isinstance(results, PredictResults):
        pictures, tables = predict_pictures(results), [predict_table(results)]
        runs = f"{counted(len(results.rows), 'setting', 'settings')}, {len(results.rows[0].times)} predictions each"
        facts = [*_facts(results.head), ("Measured", runs)]
        return Chapter(results.head.title, facts, command, None, [Section("Predictions", pictures, tables)])
    facts = [*_facts(results.head), ("Measured", _extent(results)), ("Baseline", results.baseline)]
    overview = overview_pictures(results, all_looks)
    sections = [
        Section(group, group_pictures(results, group, all_looks), group_tables(results, group))
        for group in results.groups()
    ]
    if len(sections) == 1:
        sections = [replace(sections[0], pictures=overview + sections[0].pictures)]
    else:
        sections.insert(0, Section("All groups", overview, []))
    return Chapter(results.head.title, facts, command, settings_table(results), sections)


def _facts(head: Head) -> list[tuple[str, str]]:
    cores = counted(int(head.machine["cores"]), "core", "cores") if "cores" in head.machine else ""
    machine = [head.machine.get("processor", ""), cores, head.machine.get("system", "")]
    software = [f"{_VERSIONS.get(name, name)} {version}".strip() for name, version in head.versions.items()]
    return [
        ("Machine", ", ".join(part for part in machine if part) or "unknown"),
        ("Software", ", ".join(software) or "unknown"),
        ("Started", f"{head.started} UTC" if head.started else "unknown"),
    ]


def _extent(results: PlanResults) -> str:
    queries = {(run.group, run.map, run.query) for run in results.runs}
    return (
        f"{counted(len(results.runs), 'run', 'runs')}: {counted(len(results.planners()), 'planner', 'planners')} on "
        f"{counted(len(queries), 'query', 'queries')} in {counted(len(results.groups()), 'group', 'groups')} of maps"
    )


def _renamed(chapter: Chapter, prefix: str, taken: set[str]) -> Chapter:
    def unique(picture: Picture) -> Picture:
        name, number = prefix + picture.name, 1
        while name in taken:
            number += 1
            name = f"{prefix}{picture.name}-{number}"
        taken.add(name)
        return replace(picture, name=name)

    sections = [replace(section, pictures=[unique(p) for p in section.pictures]) for section in chapter.sections]
    return replace(chapter, sections=sections)
