"""documentation/index.html: what the class says of itself, and the variables one sets and reads."""

import re
from collections.abc import Iterable
from html import escape

from fmu_build.lower.ode_model import OdeModel, Variable

_STYLE = """body { font-family: sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; } th, td { text-align: left; padding: 0.2em 0.8em; border-bottom: 1px solid #ccc; }
td.number { text-align: right; }"""


def documentation_page(model: OdeModel) -> str:
    """A page that needs no other file, of the class' Documentation annotation and tables of variables."""
    title = escape(model.name)
    parts = [
        "<!DOCTYPE html>",
        f'<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style></head><body>',
        f"<h1>{title}</h1>",
        f"<p>{escape(model.description)}</p>",
        _body(model.documentation),
        *_table("Inputs", [v for v in model.variables if v.causality == "input"]),
        *_table("Outputs", [v for v in model.variables if v.causality == "output"]),
        *_table("Parameters", [v for v in model.variables if v.causality == "parameter"]),
        "</body></html>",
    ]
    return "\n".join(part for part in parts if part) + "\n"


def _body(html: str) -> str:
    """The annotation's HTML without its own <html> frame."""
    return re.sub(r"</?(html|body)\b[^>]*>", "", html, flags=re.IGNORECASE).strip()


def _table(title: str, variables: Iterable[Variable]) -> list[str]:
    rows = [_row(variable) for variable in variables]
    if not rows:
        return []
    head = "".join(f"<th>{name}</th>" for name in ("Name", "Start", "Unit", "Min", "Max", "Description"))
    return [f"<h2>{title}</h2>", "<table>", f"<tr>{head}</tr>", *rows, "</table>"]


def _row(variable: Variable) -> str:
    numbers = ["" if value is None else f"{value:.6g}" for value in (variable.start, variable.min, variable.max)]
    cells = [
        f"<td>{escape(variable.name)}</td>",
        f'<td class="number">{numbers[0]}</td>',
        f"<td>{escape(variable.unit or '')}</td>",
        *(f'<td class="number">{text}</td>' for text in numbers[1:]),
        f"<td>{escape(variable.description or '')}</td>",
    ]
    return f"<tr>{''.join(cells)}</tr>"
