"""One HTML page that needs nothing else: text, tables and pictures in a single file."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

from fmu_build.version import DISTRIBUTION, version

if TYPE_CHECKING:
    from pysim.present.render import Drawing

_STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --quiet: #5c5c5c; --paper: #fff; --line: #d7d7d7; --fail: #b3261e;
  --pass: #14663a; --mark: #fbe9e7; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e8e8; --quiet: #a8a8a8; --paper: #16181b; --line: #3a3d42;
  --fail: #ff8a80; --pass: #7bd6a2; --mark: #3b2321; } }
body { margin: 0 auto; max-width: 66rem; padding: 1.5rem 1rem 4rem; background: var(--paper); color: var(--ink);
  font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0 .25rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .5rem; border-bottom: 1px solid var(--line); padding-bottom: .2rem; }
p, li { max-width: 46rem; } .lead { color: var(--quiet); margin-top: 0; }
.note { border-left: 4px solid #d08700; padding: .1rem 0 .1rem .9rem; margin: 1rem 0; }
.statement { font-size: 1.15rem; border-left: 4px solid #0072b2; padding: .2rem 0 .2rem .9rem; margin: 1.2rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .86rem; margin: .8rem 0; }
caption { text-align: left; color: var(--quiet); padding-bottom: .3rem; }
th, td { padding: .18rem .45rem; text-align: right; border-bottom: 1px solid var(--line); }
td { white-space: nowrap; } th { font-weight: 600; vertical-align: bottom; min-width: 2.6rem; }
td.beyond { background: var(--mark); color: var(--fail); }
td.fail { color: var(--fail); font-weight: 600; } td.pass { color: var(--pass); }
td.words { white-space: normal; text-align: left; } th.words { text-align: left; } td.differs { font-weight: 600; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; height: auto; background: #fff; border-radius: 4px; }
figcaption { color: var(--quiet); font-size: .9rem; }
pre { background: color-mix(in srgb, var(--line) 40%, transparent); padding: .7rem .9rem; overflow-x: auto; }
@media print { :root { --ink: #000; --quiet: #444; --paper: #fff; --line: #bbb; --fail: #a00; --pass: #060;
    --mark: #eee; }
  body { max-width: none; font-size: 10pt; padding: 0; } h2 { break-after: avoid; }
  figure, table { break-inside: avoid; } .scroll { overflow: visible; } }
"""


def page(title: str, lead: str, parts: Iterable[str], redo: str = "") -> str:
    """The whole page.

    Args:
        title, lead: plain text.
        parts: HTML made by the other functions of this module.
        redo: the lines that make it again, for the end; "" for none.
    """
    body = "\n".join([*parts, *([heading("Do it again"), commands(redo)] if redo else [])])
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f'<h1>{escape(title)}</h1>\n<p class="lead">{escape(lead)}</p>\n{body}\n'
        f'<p class="lead">Written by {DISTRIBUTION} {version()}.</p>\n</body>\n</html>\n'
    )


def heading(text: str) -> str:
    """A section's title."""
    return f"<h2>{escape(text)}</h2>"


def paragraph(text: str, *, note: bool = False) -> str:
    """Plain text; a note stands out."""
    return f'<p class="note">{escape(text)}</p>' if note else f"<p>{escape(text)}</p>"


def statement(text: str) -> str:
    """What the page has to say, in a sentence or two."""
    return f'<p class="statement">{escape(text)}</p>'


def items(texts: Iterable[str]) -> str:
    """A list of plain texts."""
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>"


def commands(text: str) -> str:
    """Lines to type."""
    return f"<pre>{escape(text)}</pre>"


class Cell(str):
    """The HTML of one cell, as `cell` makes it."""

    __slots__ = ()


def cell(text: str, kind: str = "") -> Cell:
    """One cell; kind is "", "pass", "fail", "beyond", "differs" or "words", which may break into lines."""
    return Cell(f'<td class="{kind}">{escape(text)}</td>' if kind else f"<td>{escape(text)}</td>")


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]], *, words: Sequence[int] = ()) -> str:
    """A table; a column's head stands as the words below it do.

    Args:
        rows: of plain texts, and of cells where a text is more than that.
        words: columns whose texts are words.
    """
    made = [
        [one if isinstance(one, Cell) else cell(one, "words" if k in words else "") for k, one in enumerate(row)]
        for row in rows
    ]
    left = {k for k, one in enumerate(made[0]) if one.startswith('<td class="words"')} if made else set()
    top = "".join(
        f'<th class="words">{escape(name)}</th>' if k in left else f"<th>{escape(name)}</th>"
        for k, name in enumerate(head)
    )
    body = "\n".join(f"<tr>{''.join(row)}</tr>" for row in made)
    return (
        f'<div class="scroll"><table><caption>{escape(caption)}</caption>\n'
        f"<thead><tr>{top}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>"
    )


def picture(svg: bytes, caption: str) -> str:
    """A drawing inside the page; the caption also serves readers who cannot see it."""
    data = base64.b64encode(svg).decode("ascii")
    return (
        f'<figure><img alt="{escape(caption, quote=True)}" src="data:image/svg+xml;base64,{data}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def pictures(drawings: Iterable[Drawing]) -> list[str]:
    """All drawings inside the page, each with its caption."""
    return [picture(one.svg, one.caption) for one in drawings]
