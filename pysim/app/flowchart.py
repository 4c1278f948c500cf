"""A model's parts and what links them as a flowchart of Mermaid, which lays it out."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

_SHAPES = {"input": ("([", "])"), "output": ("([", "])"), "port": ("([", "])"), "term": ("(", ")")}
_FEW = 9  # places that fit beside each other; more go from top to bottom, where a page has room
_LINES = {"to": "-->", "both": "<-->", "joint": "==="}
CONFIG = {
    "startOnLoad": False, "securityLevel": "strict", "theme": "base", "fontFamily": "inherit", "htmlLabels": False,
    "flowchart": {"htmlLabels": False, "nodeSpacing": 28, "rankSpacing": 42},
}  # fmt: skip


def flowchart(nodes: Sequence[Mapping[str, Any]], links: Sequence[Mapping[str, Any]]) -> str:
    """The text of the flowchart; its node n3 is the fourth of the nodes.

    Args:
        nodes: `name`, `kind`, whose first word gives the shape, and `rows`: what is written in its box, a row each.
        links: `source` and `target`, names of nodes, and `kind`: "to", "both" or "joint".
    """
    number = {str(node["name"]): k for k, node in enumerate(nodes)}
    lines = [f"flowchart {'LR' if len(nodes) <= _FEW else 'TB'}"]
    for k, node in enumerate(nodes):
        begin, end = _SHAPES.get(str(node["kind"]).partition(" ")[0], ("[", "]"))
        lines.append(f'  n{k}{begin}"{"<br/>".join(_plain(str(row)) for row in node["rows"])}"{end}')
    for link in links:
        source, target = number[str(link["source"])], number[str(link["target"])]
        lines.append(f"  n{source} {_LINES[str(link['kind'])]} n{target}")
    return "\n".join(lines)


def _plain(words: str) -> str:
    """A text in which nothing is markup: a dot stands for each sign that could be."""
    return re.sub(r"[^\w .%+-]|%(?=%)", "\N{MIDDLE DOT}", words)
