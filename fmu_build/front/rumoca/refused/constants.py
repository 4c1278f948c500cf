"""Refuses packages whose constants rumoca 0.10.2 would mix up without a word.

`package Water = Oil(rho = 1000)`, or `extends Oil(rho = 1000)` in it, also changes Oil.rho itself as soon as Water is
used anywhere in the model, and what a second extends clause on the way changes again keeps the value of the first.
Packages that each give a constant of a common base its value do not disturb each other.

Where a package is redeclared in an extends clause, a function that the new package inherits keeps the constants of
the package it is written in.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Declaration, Kind
from fmu_build.text.lookup import Libraries
from fmu_build.text.modify import redeclarations
from fmu_build.text.tokens import is_name, split_name

_Constant = tuple[str, str]  # the package that declares it, and its name


@dataclass(frozen=True)
class _Package:
    """`changed` gives the packages that change a constant, from the outermost to the one nearest its declaration."""

    found: ClassText
    bases: frozenset[str]  # with itself
    changed: Mapping[_Constant, tuple[str, ...]]


@dataclass(frozen=True)
class _Use:
    package: _Package
    here: ClassText
    offset: int


_Packages = Mapping[str, _Package]  # what the replaceable packages of a class are


def refuse_mixed_constants(source: ClassText, classes: Libraries) -> None:
    """Look through the class and all classes that it uses.

    Raises:
        BuildError: a constant would have the value of another package; says where that package is used.
    """
    _check_together(_Walk(classes).uses(source))


def _check_together(uses: Mapping[str, _Use]) -> None:
    for name, use in uses.items():
        for (owner, constant), changes in use.package.changed.items():
            if len(changes) > 1:
                raise use.here.error(
                    f"{constant} of {name} is changed twice, in {changes[0]} and in {changes[1]}, of which the "
                    f"compiler takes the wrong one; let {changes[0]} extend a package that does not change it",
                    use.offset,
                )
            for other, kept in uses.items():
                if owner in kept.package.bases and (owner, constant) not in kept.package.changed:
                    raise use.here.error(
                        f"{name} changes {constant} of {owner}, and the compiler would change it in {other} too, which "
                        f"is used in {kept.here.full_name}; let both extend a package in which {constant} has no value",
                        use.offset,
                    )


class _Walk:
    """From class to class; a class is looked at once for each choice of its packages."""

    def __init__(self, classes: Libraries) -> None:
        self._classes = classes
        self._packages: dict[str, _Package] = {}
        self._uses: dict[str, _Use] = {}
        self._waiting: list[tuple[ClassText, _Packages]] = []

    def uses(self, source: ClassText) -> Mapping[str, _Use]:
        """The packages used, by full name."""
        for enclosing in self._on_the_way(source.full_name, source, {}):
            if enclosing.kind == "package":
                self._use(self._package(enclosing), source, source.start)
        seen = set()
        self._waiting = [(source, {})]
        while self._waiting:
            here, given = self._waiting.pop()
            key = here.full_name, tuple(sorted((part, package.found.full_name) for part, package in given.items()))
            if key not in seen:
                seen.add(key)
                self._look_through(here, self._bound(here, given, set()))
        return self._uses

    def _look_through(self, here: ClassText, bound: _Packages) -> None:
        for declaration in here.declarations:
            if declaration.kind in (Kind.EXTENDS, Kind.COMPONENT):
                self._follow(declaration, here, bound)
            elif "redeclare" in declaration.prefixes and declaration.class_name in bound:
                package = bound[declaration.class_name]
                self._use(package, here, declaration.start)
                self._refuse_inherited_functions({declaration.class_name: package}, here, declaration.start)
        for name in names_used(here.words):
            last = self._last(name, here, bound, here.start)
            if last is not None and last.kind in ("function", "record"):
                self._waiting.append((last, {}))

    def _follow(self, declaration: Declaration, here: ClassText, bound: _Packages) -> None:
        chosen = self._chosen(declaration, here, bound)
        if declaration.kind is Kind.EXTENDS:
            self._refuse_inherited_functions(chosen, here, declaration.start)
            chosen = {**chosen, **bound}
        self._visit(declaration.class_name, here, bound, chosen, declaration.start)
        for found in redeclarations(declaration.modification):
            self._visit(found.class_name, here, bound, {}, found.start)

    def _visit(self, name: str, here: ClassText, bound: _Packages, given: _Packages, offset: int) -> None:
        last = self._last(name, here, bound, offset)
        if last is not None:
            self._waiting.append((last, given))

    def _last(self, name: str, here: ClassText, bound: _Packages, offset: int) -> ClassText | None:
        """Note the packages in a dotted name; the class behind them, if it names one."""
        for found in self._on_the_way(name, here, bound):
            if found.kind != "package":
                return found
            self._use(self._package(found), here, offset)
        return None

    def _on_the_way(self, name: str, here: ClassText, bound: _Packages) -> Iterator[ClassText]:
        """`A.B.C` -> the classes A, A.B and A.B.C, as far as they are classes."""
        dot = "." if name.startswith(".") else ""
        parts = split_name(name.removeprefix("."))
        first = 1
        if not dot and parts[0] in bound:
            meant = split_name(bound[parts[0]].found.full_name)
            dot, parts, first = ".", [*meant, *parts[1:]], len(meant)
        for count in range(first, len(parts) + 1):
            found = self._classes.resolve(dot + ".".join(parts[:count]), here)
            if found is None:
                return
            yield found

    def _use(self, package: _Package, here: ClassText, offset: int) -> None:
        self._uses.setdefault(package.found.full_name, _Use(package, here, offset))

    def _bound(self, here: ClassText, given: _Packages, inside: set[str]) -> _Packages:
        """The replaceable packages of a class and its bases: as given, as redeclared on the way, or their own."""
        bound = dict(given)
        if here.full_name in inside:
            return bound
        for declaration in here.declarations:
            name = declaration.name if declaration.kind is Kind.CLASS else ""
            own = here.classes.get(name)
            if own is not None and own.kind == "package" and {"replaceable", "redeclare"} & declaration.prefixes:
                found = self._classes.full(f"{here.full_name}.{name}")
                if found is not None:
                    bound.setdefault(name, self._meant(found))
        for declaration in here.of_kind(Kind.EXTENDS):
            base = self._classes.resolve(declaration.class_name, here)
            if base is not None:
                chosen = self._chosen(declaration, here, bound)
                bound = dict(self._bound(base, {**chosen, **bound}, inside | {here.full_name}))
        return bound

    def _chosen(self, declaration: Declaration, here: ClassText, bound: _Packages) -> dict[str, _Package]:
        """The packages that a modification redeclares."""
        chosen = {}
        for found in redeclarations(declaration.modification):
            *_, last = [None, *self._on_the_way(found.class_name, here, bound)]
            if found.kind == "package" and last is not None:
                chosen[found.part] = self._meant(last)
        return chosen

    def _meant(self, found: ClassText) -> _Package:
        """Of `package Medium = Oil` without modification it is Oil."""
        bases = list(found.of_kind(Kind.EXTENDS))
        if len(found.declarations) == len(bases) == 1 and not bases[0].modification:
            base = self._classes.resolve(bases[0].class_name, found)
            if base is not None and base.full_name != found.full_name:
                return self._meant(base)
        return self._package(found)

    def _package(self, found: ClassText) -> _Package:
        if found.full_name not in self._packages:
            self._packages[found.full_name] = _Package(found, frozenset((found.full_name,)), {})  # ends a cycle
            bases = {found.full_name}
            changed: dict[_Constant, tuple[str, ...]] = {}
            for declaration in found.of_kind(Kind.EXTENDS):
                base = self._classes.resolve(declaration.class_name, found)
                if base is None or base.kind != "package":
                    continue
                package = self._package(base)
                bases |= package.bases
                changed |= package.changed
                for name in _modified(declaration):
                    constant = self._owner(name, base), name
                    changed[constant] = (found.full_name, *changed.get(constant, ()))
            self._packages[found.full_name] = _Package(found, frozenset(bases), changed)
        return self._packages[found.full_name]

    def _owner(self, constant: str, package: ClassText) -> str:
        for name in sorted(self._package(package).bases):
            found = self._classes.full(name)
            if found is not None and any(constant == d.name for d in found.of_kind(Kind.COMPONENT)):
                return name
        return package.full_name

    def _refuse_inherited_functions(self, chosen: _Packages, here: ClassText, offset: int) -> None:
        for part, package in chosen.items():
            function = self._inherited_function(package)
            if package.changed and function:
                raise here.error(
                    f"the compiler may leave {function}, which {package.found.full_name} inherits, with the constants "
                    f"it has there; redeclare {part} at a component, or write the function in that package itself",
                    offset,
                )

    def _inherited_function(self, package: _Package) -> str:
        own = package.found.classes
        for name in sorted(package.bases - {package.found.full_name}):
            base = self._classes.full(name)
            for function in base.classes.values() if base is not None else ():
                if function.kind == "function" and function.name not in own:
                    return f"{name}.{function.name}"
        return ""


def names_used(words: tuple[str, ...]) -> set[str]:
    """Dotted names, and single ones that are called; not those that only say what a package is unless redeclared."""
    names = set()
    at = 0
    while at < len(words):
        begin = at
        while at < len(words) and is_name(words[at]):
            at += 1
            if at + 1 >= len(words) or words[at] != "." or not is_name(words[at + 1]):
                break
            at += 1
        before = words[max(begin - 3, 0) : begin]
        is_definition = before[-1:] in (("extends",), ("constrainedby",)) or before[::2] == ("package", "=")
        is_used = at - begin > 1 or (at > begin and words[at : at + 1] == ("(",))
        if is_used and not is_definition:
            names.add("".join(words[begin:at]))
        at = max(at, begin + 1)
    return names


def _modified(declaration: Declaration) -> list[str]:
    """`(a = 1, final b(min = 0) = 2, redeclare package M = N)` -> a, b."""
    redeclared = {found.part for found in redeclarations(declaration.modification) if not found.is_nested}
    return [name for name in declaration.modifiers if name not in redeclared]
