# SPDX-License-Identifier: BSD-3-Clause
"""The site: the repository's Markdown pages and the references of C++ and Python. ``make docs`` builds it.

Sphinx reads the pages where they are, from the top of the repository, so that links lead to the same places here and
when the files are read by themselves.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs" / "theme"))

project = "lrrt"
author = "the lrrt authors"
project_copyright = author
version = release = re.search(r"project\(lrrt VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser", "sphinx.ext.autodoc", "breathe", "sphinx_copybutton", "docstrings", "headers"]
root_doc = "docs/index"
include_patterns = [
    "docs/**",
    "models/README.md",
    "training/README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
]
exclude_patterns = [".*", "build", "bench", "dist", "examples", "include", "python", "src", "tests", "shared"]

myst_heading_anchors = 3
default_role = "code"  # what docstrings put between single backticks

breathe_projects = {"lrrt": str(ROOT / "build" / "docs" / "doxygen" / "xml")}
breathe_default_project = "lrrt"
primary_domain = "cpp"
highlight_language = "cpp"

autoclass_content = "both"
autodoc_member_order = "groupwise"
toc_object_entries_show_parents = "hide"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = f"lrrt {version}"
html_show_copyright = False
templates_path = ["theme"]
html_static_path = ["theme/static"]
html_css_files = ["site.css"]
html_additional_pages = {"index": "to_front_page.html"}  # the front page is docs/index.html
html_show_sourcelink = False
