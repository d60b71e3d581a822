# SPDX-License-Identifier: BSD-3-Clause
"""A report as one HTML file that needs nothing else."""

from __future__ import annotations

from html import escape

from lrrt.report.content import Chapter, Section
from lrrt.report.style import Picture, svg_element
from lrrt.report.tables import Table

_STYLE = """
:root { color-scheme: light dark; --text: #24292f; --quiet: #59636e; --ground: #ffffff;
  --line: #d6dbe1; --soft: #f4f6f8; }
@media (prefers-color-scheme: dark) {
  :root { --text: #e4e8ec; --quiet: #9aa4af; --ground: #14181d; --line: #343b44; --soft: #1d2229; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 72rem; color: var(--text); background: var(--ground);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1, h2, h3 { line-height: 1.25; margin: 2.6rem 0 .8rem; overflow-wrap: anywhere; }
h1 { font-size: 1.9rem; margin-top: 0; }
h2 { font-size: 1.4rem; padding-top: 1.2rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.15rem; }
a { color: inherit; }
nav ul { padding-left: 1.2rem; margin: .5rem 0; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1.2rem; margin: 1rem 0; }
dt, .note, figcaption { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; }
code { font: .92em ui-monospace, "Cascadia Mono", Menlo, Consolas, monospace; background: var(--soft);
  padding: .1em .4em; border-radius: 4px; }
figure { margin: 1.8rem 0; overflow-x: auto; }
figure svg { display: block; max-width: 100%; min-width: 36rem; height: auto; }
figcaption, .note { font-size: .88rem; max-width: 52rem; margin: .4rem 0 0; }
figcaption b, caption { color: var(--text); font-weight: 600; }
.wide { overflow-x: auto; margin: 1.8rem 0 0; }
table { border-collapse: collapse; font-size: .86rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-size: .95rem; padding-bottom: .4rem; }
th, td { padding: .28rem .8rem .28rem 0; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; }
thead th { color: var(--quiet); font-weight: 500; vertical-align: bottom; border-bottom-width: 2px; }
tbody th { font-weight: 500; }
td small { display: block; color: var(--quiet); font-size: .86em; line-height: 1.2; }
tbody tr:hover { background: var(--soft); }
details { margin: 1rem 0; }
summary { cursor: pointer; }
"""


def page(chapters: list[Chapter]) -> str:
    """The whole page."""
    title = chapters[0].title if len(chapters) == 1 else "Benchmark report"
    body = [f"<h1>{escape(title)}</h1>"]
    if len(chapters) == 1:
        body += [_head(chapters[0]), _contents(chapters), _sections(chapters[0], "1", 2)]
    else:
        body.append(_contents(chapters))
        for number, chapter in enumerate(chapters, 1):
            heading = f'<h2 id="s{number}">{escape(chapter.title)}</h2>'
            body += [heading, _head(chapter), _sections(chapter, str(number), 3)]
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        + "\n".join(part for part in body if part)
        + "\n</body>\n</html>\n"
    )


def _contents(chapters: list[Chapter]) -> str:
    """Links to everything, where there is more than one thing."""
    items = []
    for number, chapter in enumerate(chapters, 1):
        links = "".join(
            f'<li><a href="#s{number}-{i}">{escape(section.title)}</a></li>'
            for i, section in enumerate(chapter.sections, 1)
        )
        if len(chapters) == 1:
            items.append(links)
        else:
            items.append(f'<li><a href="#s{number}">{escape(chapter.title)}</a><ul>{links}</ul></li>')
    if len(chapters) == 1 and len(chapters[0].sections) == 1:
        return ""
    return f'<nav aria-label="Contents"><ul>{"".join(items)}</ul></nav>'


def _head(chapter: Chapter) -> str:
    facts = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in chapter.facts)
    again = f"<dt>Run it again</dt><dd><code>{escape(chapter.command)}</code></dd>"
    settings = ""
    if chapter.settings is not None:
        settings = f"<details><summary>How the planners were set</summary>{_table(chapter.settings)}</details>"
    return f"<dl>{facts}{again}</dl>{settings}"


def _sections(chapter: Chapter, number: str, level: int) -> str:
    return "\n".join(_section(section, f"s{number}-{i}", level) for i, section in enumerate(chapter.sections, 1))


def _section(section: Section, name: str, level: int) -> str:
    pictures = [_picture(picture, f"{name}-{i}") for i, picture in enumerate(section.pictures, 1)]
    tables = [_table(table) for table in section.tables]
    heading = f'<h{level} id="{name}">{escape(section.title)}</h{level}>'
    return "\n".join([f"<section>{heading}", *pictures, *tables, "</section>"])


def _picture(picture: Picture, name: str) -> str:
    svg = svg_element(picture, name).replace("<svg", f'<svg role="img" aria-label="{escape(picture.label)}"', 1)
    return f"<figure>{svg}<figcaption><b>{escape(picture.title)}.</b> {escape(picture.caption)}</figcaption></figure>"


def _table(table: Table) -> str:
    header = "".join(f'<th scope="col">{escape(column)}</th>' for column in table.columns)
    rows = "".join(f"<tr>{_row(row)}</tr>\n" for row in table.rows)
    note = f'<p class="note">{escape(table.note)}</p>' if table.note else ""
    return (
        f'<div class="wide"><table><caption>{escape(table.title)}</caption>\n<thead><tr>{header}</tr></thead>\n'
        f"<tbody>\n{rows}</tbody></table></div>{note}"
    )


def _row(cells: tuple[str, ...]) -> str:
    return f'<th scope="row">{escape(cells[0])}</th>' + "".join(map(_cell, cells[1:]))


def _cell(text: str) -> str:
    """What is in brackets stands small below the number, so that numbers can be compared down the column."""
    number, bracket, rest = text.partition(" [") if " [" in text else text.partition(" (")
    below = f"<small>{escape(bracket.strip() + rest)}</small>" if rest else ""
    return f"<td>{escape(number)}{below}</td>"
