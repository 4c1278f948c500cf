"""TOML as it is written; JSON writes texts, numbers and rows of texts as TOML does."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping


def toml_value(value: object) -> str:
    """A text, a number, a truth, a table in a line, or a row of them; tables get a line each."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{toml_key(key)} = {toml_value(own)}' for key, own in value.items())} }}"
    if isinstance(value, list | tuple) and value and all(isinstance(own, Mapping) for own in value):
        return "[\n" + "".join(f"    {toml_value(own)},\n" for own in value) + "]"
    return json.dumps(value, ensure_ascii=False)


def toml_key(name: str) -> str:
    """A name as a key, in quotation marks where it needs them."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_value(name)


def toml_table(header: str, values: Mapping[str, object]) -> str:
    """A header with a line for each value that is not None."""
    lines = [f"{key} = {toml_value(value)}" for key, value in values.items() if value is not None]
    return "\n".join([header, *lines]) + "\n"
