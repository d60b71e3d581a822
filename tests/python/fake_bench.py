# SPDX-License-Identifier: BSD-3-Clause
"""Stands in for lrrt_bench where a test is about shards: makes a shard of a whole result that lies beside it.

Files beside it tell what happens to shard K on the way: ``kill-K`` (its worker is killed), ``stop-K`` (the program is
ended), ``fail-K`` (it fails and says so), ``wait-K`` (it waits until the file is gone). ``log`` has a line for each
call.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent


def shard_of(document: dict, number: int, of: int, planners: int) -> dict:
    """The rows of one shard, dealt as lrrt_bench deals them."""
    rows = [row for i, row in enumerate(document["rows"]) if i // planners % of == number - 1]
    shard = {} if of == 1 else {"shard": {"number": number, "of": of}}
    return {**document, **shard, "rows": rows}


def once(name: str) -> bool:
    """Whether there is such a file; it is gone afterwards."""
    found = (HERE / name).exists()
    (HERE / name).unlink(missing_ok=True)
    return found


def main() -> None:
    """Does what the files say, then writes the shard."""
    options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
    number, of = map(int, options["--shard"].split("/"))
    with (HERE / "log").open("a") as log:
        log.write(f"{number}\n")
    if once(f"kill-{number}"):
        os.kill(os.getppid(), signal.SIGKILL)
        time.sleep(1)
        (HERE / "outlived").touch()
    if once(f"stop-{number}"):
        sys.exit(130)
    if once(f"fail-{number}"):
        sys.exit("note: busy\nerror: no such map")
    while (HERE / f"wait-{number}").exists():
        time.sleep(0.02)
    document = json.loads((HERE / "whole.json").read_text(encoding="utf-8"))
    shard = shard_of(document, number, of, len(document["suite"]["planners"]))
    Path(options["--json"]).write_text(json.dumps(shard), encoding="utf-8")


if __name__ == "__main__":
    main()
