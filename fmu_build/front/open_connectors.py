"""Connectors of a class that nothing is connected to: an FMU has signals alone, so its equations are too few."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from fmu_build.errors import WrongCall
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Kind
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import TextError

_MOST = 3  # classes to name


def refuse_open_connectors(class_name: str, places: Sequence[Path]) -> None:
    """For a class that has not compiled: say which of its connectors are open, and which class to build instead.

    Raises:
        WrongCall: it has connectors with a flow, such as a port or a flange.
    """
    try:
        classes = Libraries(places)
        here = classes.find(class_name)
        found = list(_open(here, classes))
        if not found:
            return
        others = _users(here, classes)
    except TextError:  # the compiler's own words say more
        return
    cure = f"build {' or '.join(others)}" if others else "connect them in a model of yours, and build that one"
    file, line = here.place(here.start)
    raise WrongCall(
        f"{class_name} has open connectors, {', '.join(found)}: nothing says what flows there or is applied; {cure}",
        file,
        line,
    )


def _open(here: ClassText, classes: Libraries) -> Iterator[str]:
    """Names of the connectors that have a flow."""
    for owner in classes.ancestry(here):
        for part in owner.of_kind(Kind.COMPONENT):
            used = classes.resolve(part.class_name, owner)
            if used is not None and used.kind == "connector" and _has_flow(used, classes):
                yield part.name


def _has_flow(connector: ClassText, classes: Libraries) -> bool:
    return any("flow" in part.prefixes for one in classes.ancestry(connector) for part in one.declarations)


def _users(here: ClassText, classes: Libraries) -> list[str]:
    """Classes that have it as a part and no open connectors themselves, those of its own package first."""
    package = here.full_name.rpartition(".")[0]
    found = [
        one.full_name
        for one in classes.classes(here.name)
        if "partial" not in one.prefixes
        and any(classes.resolve(part.class_name, one) is here for part in one.of_kind(Kind.COMPONENT))
        and not any(_open(one, classes))
    ]
    return sorted(found, key=lambda name: (name.rpartition(".")[0] != package, name))[:_MOST]
