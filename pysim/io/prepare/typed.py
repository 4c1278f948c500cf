"""Steps as words of a command line: `flip:x`, `trim:start=0.5`, `rename:old=new`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, Field, fields
from typing import Any

from pysim.io.prepare.step import Step
from pysim.io.prepare.written import STEPS
from pysim.types import BadInput

_BETWEEN = "+"  # names of a field that is not given one by one


def typed(step: Step) -> str:
    """A step as a word of the command line: what it is, and its fields with commas between them."""
    words: list[str] = []
    for field in fields(step):  # type: ignore[arg-type]
        value = getattr(step, field.name)
        if value == field.default:
            continue
        if isinstance(value, Mapping):
            words += [f"{old}={new}" for old, new in value.items()]
        elif field.name == step.star:
            words += value
        else:
            text = _BETWEEN.join(value) if isinstance(value, tuple) else _text(value)
            words.append(text if field.default is MISSING else f"{field.name}={text}")
    return ":".join([step.word, ",".join(words)] if words else [step.word])


def step_typed(text: str) -> Step:
    """The step that such a word means.

    Raises:
        BadInput: a word, field or number that is not known.
    """
    word, _, rest = text.partition(":")
    kind = STEPS.get(word)
    if kind is None:
        raise BadInput(f"{text!r}: there is no step {word!r}; use one of {', '.join(STEPS)}")
    own = {field.name: field for field in fields(kind)}
    given: dict[str, Any] = {}
    ahead = [name for name in own if name != kind.star and own[name].default is MISSING]
    for part in rest.split(",") if rest else []:
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if equals and "names" in own:
            given.setdefault("names", {})[name] = value
        elif equals and name in own:
            given[name] = _value(own[name], value, text)
        elif equals or not (ahead or kind.star):
            raise BadInput(f"{text!r}: {word} has no {part.strip()!r}; its fields are {', '.join(own)}")
        elif ahead:
            first = ahead.pop(0)
            given[first] = _value(own[first], part.strip(), text)
        else:
            given[kind.star] = (*given.get(kind.star, ()), part.strip())
    missing = [name for name, field in own.items() if field.default is MISSING and name not in given]
    if missing:
        raise BadInput(f"{text!r}: {word} needs {', '.join(missing)}; write {word}:{','.join(missing).upper()}")
    step: Step = kind(**given)
    return step


def _value(field: Field[Any], text: str, whole: str) -> Any:
    if field.type == "str":
        return text
    if str(field.type).startswith("tuple"):
        return tuple(text.split(_BETWEEN))
    try:
        return int(text) if field.type == "int" else float(text)
    except ValueError:
        raise BadInput(f"{whole!r}: {field.name} = {text!r} is no number; write one with a point") from None


def _text(value: object) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)
