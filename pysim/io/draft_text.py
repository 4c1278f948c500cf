"""The dataset.toml of a draft."""

from __future__ import annotations

import textwrap

from pysim.io.draft_dataset import OPEN, Draft
from pysim.io.toml_text import toml_key, toml_value
from pysim.types import SYNONYMS, UNITS
from pysim.types.record_kind import LOGS, OTHER, STEPPED_SINE


def draft_text(found: Draft) -> str:
    """The dataset.toml, with comments on what to fill in and to look at."""
    known = ", ".join(unit for unit in UNITS if unit not in SYNONYMS)
    head = [
        "# A draft. Look at every line; what is behind a # is not read.",
        *textwrap.wrap(f"Units: {known}", 100, initial_indent="# ", subsequent_indent="#   "),
        "",
        "[dataset]",
        f"name = {toml_value(found.folder.resolve().name)}",
        '# description = "what was tested, and on which bench"',
    ]
    time_unit = f"time_unit = {toml_value(found.time_unit)}"
    head += [time_unit] if found.time_unit != "s" else ['# time_unit = "ms"    # where the times are not in s']
    parts = ["\n".join(head), *(_signal(found, name) for name in found.roles)]
    parts += [_record(found, source, first=not k) for k, source in enumerate(found.columns)]
    return "\n\n".join(parts) + "\n"


def _signal(found: Draft, name: str) -> str:
    unit = found.units[name]
    fill = "    # FILL IN: a unit of the list above" if unit == OPEN else ""
    lines = [
        f"[signals.{toml_key(name)}]",
        f'role = "{found.roles[name]}"    # input: what drives the plant | output: what answers',
        f"unit = {toml_value(unit)}{fill}",
        '# variable = "..."    # where the model calls it otherwise',
    ]
    lines += ["# noise = 0.1         # standard deviation of the sensor's noise, in the unit above"]
    return "\n".join(lines)


def _record(found: Draft, source: str, *, first: bool) -> str:
    """A log; the first says what else it may be."""
    lines = ["[[records]]", f"file = {toml_value(source)}", f"columns = {toml_value(found.columns[source])}"]
    if source in found.called:
        lines.append(f"time = {toml_value(found.called[source])}" + "    # what this log calls it" * first)
    sine = found.sines.get(source)
    if sine is None:
        others = " | ".join(kind.name for kind in reversed(LOGS) if kind is not OTHER)
        lines.append(f'kind = "{OTHER.name}"' + f"    # {others}; the last two say more" * first)
    else:
        lines.append(f'kind = "{STEPPED_SINE.name}"')
        lines += [f"{key} = {getattr(sine, key)!r}" for key in ("offset", "amplitude", "frequency")]
        command = next(name for name, role in found.roles.items() if role == "input")
        lines[-3] += f"    # of {command}, in its unit" if first else ""
    lines.append('use = "fit"' + '    # "validate" keeps it apart, to try the fitted model on' * first)
    return "\n".join(lines)
