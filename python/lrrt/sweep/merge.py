# SPDX-License-Identifier: BSD-3-Clause
"""The results of all shards as the result of one run."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from lrrt.report.fields import Fields, ResultError
from lrrt.report.results import FORMAT
from lrrt.sweep.errors import SweepError

Document = dict[str, Any]  #: a result file of lrrt_bench
_MOST_SHARDS = 999_999  # of lrrt sweep
_ALIKE = ("suite", "inputs", "versions")  #: what rows must share to be compared


def merge(shards: Mapping[str, Document]) -> Document:
    """One document of the results of all shards of a suite, its rows in the order of a run that is not sharded.

    The field ``shards`` tells the machine of each; ``machine`` what all machines have in common.

    Args:
        shards: documents by name, in any order; the names are for errors.

    Raises:
        SweepError: a shard is missing, there twice, incomplete, or of another suite, version or map; names it.
    """
    if not shards:
        raise SweepError("no shards to merge; expected results of lrrt_bench --shard K/N --json")
    names = _in_order(shards)
    documents = [shards[name] for name in names]
    for name in names[1:]:
        check_alike(names[0], documents[0], name, shards[name])
    first = documents[0]
    head = {key: first[key] for key in ("format", "suite", "folder", "inputs", "versions") if key in first}
    return head | {
        "machine": _common_machine([document["machine"] for document in documents]),
        "started": min(document["started"] for document in documents),
        "shards": [
            {"number": number, "machine": document["machine"], "started": document["started"]}
            for number, document in enumerate(documents, 1)
        ],
        "rows": [row for pair in _dealt(names, documents) for row in pair],
    }


def check_alike(name: str, document: Document, other_name: str, other: Document) -> None:
    """Raises SweepError unless two shards have the same suite, inputs and versions; names what differs."""
    for key in _ALIKE:
        try:
            difference = _difference(document[key], other[key], key)
        except RecursionError:
            difference = f"{key} is nested too deeply"
        if difference:
            raise SweepError(
                f"{other_name}: is no shard of the same run as {name}: {difference}; expected the same {key} in both: "
                "run one of them again"
            )


def check_document(name: str, document: object) -> Document:
    """The document itself. Raises SweepError where it is no result of lrrt_bench; names the file and the field."""
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise SweepError(f"{name}: is no result file; expected one that lrrt_bench --json wrote ('format': '{FORMAT}')")
    try:
        _check_fields(Fields(document, name))
    except ResultError as error:
        raise SweepError(f"{error}, in a file that lrrt_bench --json wrote") from error
    return document


def _check_fields(document: Fields) -> None:
    """Raises ResultError unless everything that is merged is there, and what it should be."""
    for key in ("inputs", "versions", "machine"):
        document.child(key)
    document.text("started")
    if "shard" in document:
        _check_shard(document.child("shard"))
    suite = document.child("suite")
    rows = document.children("rows", "a list of runs", or_none=True)  # there may be more shards than runs
    if suite.text("kind") == "plan":
        for planner in suite.children("planners", "a list of planners"):
            planner.text("name")
        for row in rows:
            row.whole("seed")
            for key in ("map", "query", "planner"):
                row.text(key)


def _check_shard(shard: Fields) -> None:
    if not 1 <= shard.whole("of") <= _MOST_SHARDS:
        raise shard.refuse("of", f"1 to {_MOST_SHARDS}")
    if not 1 <= shard.whole("number") <= shard.whole("of"):
        raise shard.refuse("number", f"1 to {shard.whole('of')}")


def _in_order(shards: Mapping[str, Document]) -> list[str]:
    """The names by the numbers of their shards: all that there are, each once."""
    by_number: dict[int, str] = {}
    of = 0
    for name, document in shards.items():
        shard = check_document(name, document).get("shard") or {"number": 1, "of": 1}  # a whole run has none
        number, parts = shard["number"], shard["of"]
        if of not in (0, parts):
            raise SweepError(f"{name}: is shard {number} of {parts}; expected one of {of}, as the others")
        if number in by_number:
            raise SweepError(f"{name}: is shard {number} of {parts}, as is {by_number[number]}; expected each once")
        by_number[number], of = name, parts
    missing = [str(number) for number in range(1, of + 1) if number not in by_number]
    if missing:
        raise SweepError(f"shard {', '.join(missing)} of {of} is missing; there is {', '.join(shards)}")
    return [by_number[number] for number in range(1, of + 1)]


def _dealt(names: list[str], documents: list[Document]) -> Iterator[list[Document]]:
    """Pairs in the order of the whole: they were dealt to the shards like cards, one at a time."""
    hands = [_pairs(name, document) for name, document in zip(names, documents)]
    total = sum(map(len, hands))
    for i, (name, hand) in enumerate(zip(names, hands)):
        expected = (total - i + len(hands) - 1) // len(hands)
        if len(hand) != expected:
            raise SweepError(
                f"{name}: holds {len(hand)} of {total} pairs of runs; expected {expected}: rows are missing"
            )
    return (hands[pair % len(hands)][pair // len(hands)] for pair in range(total))


def _pairs(name: str, document: Document) -> list[list[Document]]:
    """Rows that are compared with one another: those of all planners on one problem with one seed."""
    rows, suite = document["rows"], document["suite"]
    if suite["kind"] != "plan":
        return [[row] for row in rows]
    planners = [planner["name"] for planner in suite["planners"]]
    pairs = [rows[i : i + len(planners)] for i in range(0, len(rows), len(planners))]
    for i, pair in enumerate(pairs):
        problems = {(row["map"], row["query"], row["seed"]) for row in pair}
        if [row["planner"] for row in pair] != planners or len(problems) != 1:
            place = f"rows[{i * len(planners)}] and what follows"
            raise SweepError(f"{name}: {place}: expected one problem and seed with each of {', '.join(planners)}")
    return pairs


def _common_machine(machines: list[Document]) -> Document:
    """What the machines have in common; the processors of all."""
    common = {key: value for key, value in machines[0].items() if all(m.get(key) == value for m in machines)}
    processors = dict.fromkeys(str(machine.get("processor", "unknown")) for machine in machines)
    return {"processor": " and ".join(processors)} | {key: common[key] for key in common if key != "processor"}


def _difference(a: object, b: object, place: str) -> str:
    """The first place where two values differ, with both; empty where they do not."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in dict.fromkeys([*a, *b]):
            found = _difference(a.get(key), b.get(key), f"{place}.{key}")
            if found:
                return found
        return ""
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        return next(filter(None, (_difference(x, y, f"{place}[{i}]") for i, (x, y) in enumerate(zip(a, b)))), "")
    return "" if a == b else f"{place} is {_shown(b)}, there {_shown(a)}"


def _shown(value: object) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 60 else text[:57] + "…"
