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
from lrrt.report.tables import Table, group_tables, hard_table, predict_table, settings_table

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
    prefixes = [f"{slug(results.head.name)}-" if len(files) > 1 else "" for results in files]
    taken: set[str] = set()
    return [_renamed(chapter, prefix, taken) for chapter, prefix in zip(made, prefixes)]


def _chapter(results: PlanResults | PredictResults, all_looks: dict[str, Look]) -> Chapter:
    command = results.head.command or replay_command(results.head.path.name)
    facts = facts_of(results)
    if isinstance(results, PredictResults):
        pictures, tables = predict_pictures(results), [predict_table(results)]
        return Chapter(results.head.title, facts, command, None, [Section("Predictions", pictures, tables)])
    overview = overview_pictures(results, all_looks)
    sections = [
        Section(group, group_pictures(results, group, all_looks), group_tables(results, group))
        for group in results.groups()
    ]
    if len(sections) == 1:
        sections = [replace(sections[0], pictures=overview + sections[0].pictures)]
    else:
        hard = hard_table(results, results.groups())
        sections.insert(0, Section("All groups", overview, [hard] if hard is not None else []))
    return Chapter(results.head.title, facts, command, settings_table(results), sections)


def facts_of(results: PlanResults | PredictResults) -> list[tuple[str, str]]:
    """Where, with what, when and how much was measured: names and values."""
    facts = _facts(results.head)
    if isinstance(results, PlanResults):
        return [*facts, ("Measured", _extent(results)), ("Baseline", results.baseline)]
    runs = f"{counted(len(results.rows), 'setting', 'settings')}, {len(results.rows[0].times)} predictions each"
    return [*facts, ("Measured", runs)]


def replay_command(file: str, program: str = "lrrt_bench") -> str:
    """The command that runs a result again; the program reads what is gzipped through a pipe."""
    name = shlex.quote(file)
    return f"zcat {name} | {program} --replay /dev/stdin" if file.endswith(".gz") else f"{program} --replay {name}"


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
    limits = {setting.time_limit for setting in results.settings.values()}
    each = f", at most {limits.pop():g} s each" if len(limits) == 1 else ""
    planners = counted(len(results.planners()), "planner", "planners")
    return (
        f"{counted(len(results.runs), 'run', 'runs')}: {planners} on {counted(len(queries), 'query', 'queries')} in "
        f"{counted(len(results.groups()), 'group', 'groups')} of maps{each}"
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
