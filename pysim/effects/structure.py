"""How the parts of a model hang together, read from its class: what a drawing of its signal flow shows."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from fmu_build.text import ClassText, Declaration, Libraries
from fmu_build.text.declarations import Kind
from pysim.effects._text import as_bad_input, known_class

SLOT, PART, INPUT, OUTPUT, PORT, TERM = "slot", "part", "input", "output", "port", "term"
TO, BOTH, JOINT = "to", "both", "joint"  # one way, both ways, a connection of ports that has no direction
_MOST_TERMS = 14  # own variables that are drawn; more of them are drawn as one
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\[[^\]]*\])?(?:\s*\.\s*[A-Za-z_]\w*(?:\[[^\]]*\])?)*(?!\s*\()")


@dataclass(frozen=True)
class Node:
    """A place of the drawing.

    Args:
        name: of the component, or of the class for all that stands in its own equations.
        kind: SLOT, PART, INPUT, OUTPUT, PORT, or TERM for a variable with an equation of the class itself.
        about: description.
    """

    name: str
    kind: str
    about: str = ""


@dataclass(frozen=True)
class Link:
    """Two nodes that depend on each other.

    Args:
        kind: TO (the target depends on the source), BOTH or JOINT.
    """

    source: str
    target: str
    kind: str


@dataclass(frozen=True)
class Structure:
    """Nodes in the order of their declarations, and what links them."""

    nodes: tuple[Node, ...]
    links: tuple[Link, ...]


def structure(class_name: str, libraries: Sequence[Path]) -> Structure:
    """The parts of a class, its inputs and outputs, and the variables of its own equations.

    A variable that only passes another one on, or that nothing depends on, is left out.

    Args:
        class_name: full name.
        libraries: where it and its parts are.
    Raises:
        BadInput: no such class.
    """
    library = Libraries(libraries)
    reader = _Reader(library, {})
    with as_bad_input():
        texts = list(library.ancestry(known_class(class_name, library)))
        for text in texts:
            for declaration in text.of_kind(Kind.COMPONENT):
                reader.declare(declaration, text)
        arrows = [arrow for text in texts for arrow in reader.arrows(text)]
    return _drawn([node for node, _ in reader.known.values()], arrows, reader.states, class_name)


@dataclass(frozen=True)
class _Arrow:
    source: str
    target: str
    is_joint: bool = False  # ports that are connected


class _Reader:
    """What the class' declarations and equations say.

    Args:
        known: name -> node, and the class of a part; None for what is no part.
    """

    def __init__(self, library: Libraries, known: dict[str, tuple[Node, ClassText | None]]) -> None:
        self._library, self.known = library, known
        self.states: set[str] = set()

    def declare(self, declaration: Declaration, owner: ClassText) -> None:
        """Take a declaration that the drawing shows."""
        kind, of = _kind(declaration, owner, self._library)
        if kind:
            about = " ".join(declaration.description.split())
            node = Node(declaration.name, kind, about)
            self.known.setdefault(declaration.name, (node, of))

    def arrows(self, text: ClassText) -> Iterator[_Arrow]:
        """What depends on what, by equations, connections, and values of declarations."""
        for declaration in text.of_kind(Kind.COMPONENT):
            if declaration.value and declaration.name in self.known:
                yield from self._equation(declaration.name, declaration.text(declaration.value))
        for statement in (one for outer in text.equations for one in (outer, *outer.inside()) if not one.branches):
            words = re.sub(r'"[^"]*"', "", text.text(statement.tokens)).strip().rstrip(";")
            connected = re.fullmatch(r"connect\s*\(([^,]*),([^,]*)\)", words, re.S)
            if connected:
                yield from self._connection(connected[1].strip(), connected[2].strip())
            elif "=" in words:
                left, right = _sides(words)
                yield from self._equation(left, right)

    def _connection(self, first: str, second: str) -> Iterator[_Arrow]:
        ways = self._way(first), self._way(second)
        one, other = first.partition(".")[0], second.partition(".")[0]
        if one not in self.known or other not in self.known:
            return
        if ways[0] < ways[1]:
            one, other = other, one
        yield _Arrow(one, other, ways[0] == ways[1])

    def _way(self, name: str) -> int:
        """1 for what gives a signal, -1 for what takes one, 0 for a port."""
        head, _, inner = name.partition(".")
        node, of = self.known.get(head, (Node(head, PORT), None))
        if not inner:
            return {INPUT: 1, OUTPUT: -1}.get(node.kind, 0)
        for text in self._library.ancestry(of) if of is not None else ():
            for declaration in text.of_kind(Kind.COMPONENT):
                if declaration.name == inner.partition(".")[0]:
                    return {INPUT: -1, OUTPUT: 1}.get(_signal(declaration), 0)
        return 0

    def _equation(self, left: str, right: str) -> Iterator[_Arrow]:
        """The first variable of the left side, or the one whose derivative it has, from all the others."""
        derived = re.search(r"\bder\s*\(\s*(\w+)", f"{left} = {right}")
        names = [name.partition(".")[0].partition("[")[0].strip() for name in _NAME.findall(f"{left} = {right}")]
        own = [name for name in names if name in self.known]
        target = derived[1] if derived else next(iter(own), "")
        if derived:
            self.states.add(derived[1])
        if target in self.known:
            yield from (_Arrow(source, target) for source in own if source != target)


def _sides(words: str) -> tuple[str, str]:
    """Left and right of an equation; what an `if` or `for` around it says stands left of it."""
    at = re.search(r"(?<![<>=:])=(?!=)", words)
    if at is None:
        return words, ""
    left, right = words[: at.start()], words[at.end() :]
    return re.split(r"\b(?:then|else|loop)\b", left)[-1], right


def _kind(declaration: Declaration, owner: ClassText, library: Libraries) -> tuple[str, ClassText | None]:
    """What a component is in the drawing ("" for nothing), and its class where it is a part."""
    if declaration.prefixes & {"parameter", "constant", "outer"}:
        return "", None
    if signal := _signal(declaration):
        return signal, None
    of = library.resolve(declaration.class_name, owner)
    if of is None:
        return {"Real": TERM, "Integer": "", "Boolean": "", "String": ""}.get(declaration.class_name, PART), None
    if of.kind in ("model", "block", "class"):
        return SLOT if "replaceable" in declaration.prefixes else PART, of
    return {"type": TERM, "connector": PORT}.get(of.kind, ""), None


def _signal(declaration: Declaration) -> str:
    """INPUT, OUTPUT, or "" for anything else."""
    for kind in (INPUT, OUTPUT):
        if kind in declaration.prefixes or declaration.class_name.endswith(f"Real{kind.capitalize()}"):
            return kind
    return ""


def _drawn(nodes: Sequence[Node], arrows: Sequence[_Arrow], states: set[str], class_name: str) -> Structure:
    """Without what only passes on, and without what leads nowhere."""
    terms = {node.name for node in nodes if node.kind == TERM}
    found = _shortened(list(dict.fromkeys(arrows)), terms, states)
    left = [n for n in nodes if n.kind != TERM or any(n.name in (a.source, a.target) for a in found)]
    if sum(n.kind == TERM for n in left) > _MOST_TERMS:
        left, found = _together(left, found, class_name.rpartition(".")[2])
    return Structure(tuple(left), tuple(_links(found)))


def _shortened(arrows: list[_Arrow], terms: set[str], states: set[str]) -> list[_Arrow]:
    """Own variables are taken out that nothing depends on, that depend on nothing, or that pass one thing on."""
    for name in [name for name in terms if name in states] + [name for name in terms if name not in states]:
        if name in states and any(arrow.source == name for arrow in arrows):
            continue
        into = [arrow for arrow in arrows if arrow.target == name]
        out = [arrow for arrow in arrows if arrow.source == name]
        if len(into) <= 1 or not out:
            passed = [replace(o, source=i.source) for i in into for o in out if i.source != o.target]
            arrows = [a for a in arrows if name not in (a.source, a.target)] + passed
            return _shortened(list(dict.fromkeys(arrows)), terms - {name}, states)
    return arrows


def _together(nodes: list[Node], arrows: list[_Arrow], name: str) -> tuple[list[Node], list[_Arrow]]:
    """All own variables as one node."""
    terms = {node.name for node in nodes if node.kind == TERM}
    moved = [
        replace(a, source=name if a.source in terms else a.source, target=name if a.target in terms else a.target)
        for a in arrows
    ]
    return [n for n in nodes if n.kind != TERM] + [Node(name, TERM, "its own equations")], moved


def _links(arrows: Sequence[_Arrow]) -> Iterator[Link]:
    """One per pair of nodes."""
    pairs: dict[frozenset[str], list[_Arrow]] = {}
    for arrow in arrows:
        if arrow.source != arrow.target:
            pairs.setdefault(frozenset((arrow.source, arrow.target)), []).append(arrow)
    for own in pairs.values():
        first = own[0]
        both = any(arrow.source != first.source for arrow in own)
        is_joint = any(arrow.is_joint for arrow in own)
        yield Link(first.source, first.target, JOINT if is_joint else BOTH if both else TO)
