"""Whether what a system is made of has the right form: rows, members, names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from inspect import getattr_static

from pysim.cosim.member import Member
from pysim.cosim.sampled import Sampled
from pysim.types import BadInput

_NOTHING = object()
_MEMBER = tuple(name for name in vars(Member) if not name.startswith("_"))


def row_of(name: str, given: object, kind: type) -> tuple[object, ...]:
    """What was given as a tuple.

    Raises:
        BadInput: no row, or something in it is not of that kind.
    """
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise BadInput(f"system: {name} is {given!r}; give a row of them, as ({name[:-1]},)")
    row = tuple(given)
    for item in row:
        if not isinstance(item, kind):
            raise BadInput(f"system: {item!r} among its {name} is no {kind.__name__}; give {kind.__name__}(...)")
    return row


def check_member(member: object) -> None:
    """Raises: BadInput for what is no member, has no proper name, or names ports it does not have."""
    needed = () if isinstance(member, Sampled) else _MEMBER
    # Not `hasattr`: it would ask a member that is not at work for its event.
    missing = [name for name in needed if getattr_static(member, name, _NOTHING) is _NOTHING]
    if missing:
        raise BadInput(
            f"system: {member!r} has no {missing[0]!r}; give an FMU, or a controller as Sampled(name, block, every=...)"
        )
    name = member.name  # type: ignore[attr-defined]
    if not isinstance(name, str) or not name or "." in name:
        raise BadInput(f"system: a member is called {name!r}; give a name without a dot")
    for side in ("inputs", "outputs"):
        check_unique(f"{side} of {name}", [port.name for port in getattr(member, side)])
    _check_feedthrough(name, member)


def _check_feedthrough(name: str, member: object) -> None:
    ports = {side: [port.name for port in getattr(member, side)] for side in ("inputs", "outputs")}
    for output, needs in member.feedthrough.items():  # type: ignore[attr-defined]
        wrong = sorted({output} - set(ports["outputs"])) + sorted(set(needs) - set(ports["inputs"]))
        if wrong:
            raise BadInput(f"system: the feedthrough of {name} names {wrong[0]!r}, which it does not have; correct it")


def check_unique(what: str, names: list[str]) -> None:
    """Raises: BadInput for a name that is there twice."""
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    if twice:
        raise BadInput(f"system: {what}: {twice[0]!r} is there twice; give each its own name")
