"""A digest of any content, exact to the last bit; what is printed loses digits."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from numbers import Real

import numpy as np

# What a record says of itself, which no residual depends on.
_SAID = ("origin", "message", "statistics")


def digest(content: object) -> str:
    """What only the same content has, to the last bit: dataclasses, mappings, rows, arrays, numbers and texts.

    Raises:
        TypeError: something else is among it.
    """
    found = hashlib.sha256()
    for part in _exact(content):
        found.update(part)
    return found.hexdigest()


def _exact(content: object) -> Iterator[bytes]:
    """Every value behind its kind and size, so that nothing else reads the same."""
    if isinstance(content, np.ndarray):
        yield f"array {content.dtype.str} {content.shape}\n".encode()
        yield content.tobytes()
    elif is_dataclass(content):
        names = [one.name for one in fields(content) if one.init and one.name not in _SAID]
        yield f"{type(content).__name__} {names}\n".encode()
        for name in names:
            yield from _exact(getattr(content, name))
    elif isinstance(content, Mapping):
        yield f"mapping {sorted(content)}\n".encode()
        for name in sorted(content):
            yield from _exact(content[name])
    elif isinstance(content, tuple | list):
        yield f"row {len(content)}\n".encode()
        for one in content:
            yield from _exact(one)
    elif isinstance(content, Real):
        yield f"{float(content).hex()}\n".encode()
    elif content is None or isinstance(content, str | Enum):
        yield f"{content!r}\n".encode()
    else:
        raise TypeError(f"{type(content).__name__} has no digest; add its exact form here")
