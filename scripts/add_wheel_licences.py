# SPDX-License-Identifier: BSD-3-Clause
"""add_wheel_licences.py WHEEL FOLDER: copies the wheel into FOLDER, with the licences of the libraries in it.

auditwheel put the libraries there; Debian's packages state the licences. One that is not found ends the program.
"""

from __future__ import annotations

import base64
import hashlib
import re
import subprocess
import sys
import zipfile
from pathlib import Path

OWN = {"libGLX.so.0"}  # scripts/no_opengl.c


def original_name(bundled: str) -> str:
    """liblapack-2c60cf7a.so.3 was liblapack.so.3: auditwheel adds a part of the file's checksum."""
    return re.sub(r"-[0-9a-f]{8}(?=\.so)", "", bundled)


def packages_of(library: str) -> set[str]:
    """The Debian packages that have a shared library of this name."""
    answer = subprocess.run(["dpkg-query", "-S", f"*/{library}"], capture_output=True, text=True)
    if answer.returncode != 0:
        raise SystemExit(f"error: no package owns {library}: its licence is unknown, so the wheel must not hold it")
    return {line.split(":")[0] for line in answer.stdout.splitlines()}


def licence_of(package: str) -> bytes:
    return Path("/usr/share/doc", package, "copyright").read_bytes()


def record_line(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def main(wheel: Path, folder: Path) -> None:
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(folder / wheel.name, "w", zipfile.ZIP_DEFLATED) as new:
        names = old.namelist()
        record = next(name for name in names if name.endswith(".dist-info/RECORD"))
        bundled = {original_name(Path(name).name) for name in names if re.match(r"lrrt\.libs/.", name)}
        added = ""
        for package in sorted({package for library in bundled - OWN for package in packages_of(library)}):
            name, content = f"{Path(record).parent}/licenses/{package}-copyright", licence_of(package)
            new.writestr(name, content)
            added += record_line(name, content)
        for item in old.infolist():
            new.writestr(item, old.read(item) + (added.encode() if item.filename == record else b""))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
