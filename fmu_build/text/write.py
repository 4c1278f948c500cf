"""Writes a class from its parts."""

from collections.abc import Sequence


def class_text(
    name: str, *, kind: str = "model", description: str = "", comment: str = "", classes: Sequence[str] = (),
    extends: Sequence[tuple[str, Sequence[str]]] = (), declarations: Sequence[str] = (),
    protected: Sequence[str] = (), initial: Sequence[str] = (), equations: Sequence[str] = (), annotation: str = "",
) -> str:  # fmt: skip
    """A class as Modelica text, a line for each part.

    Args:
        name: of the class, without those of packages around it.
        kind: such as "model" or "partial model".
        description: in words; quotes in it are escaped.
        comment: lines ahead of the class, without the slashes.
        classes: texts of classes inside.
        extends: a base and its modifications, each: ("Lib.Axis", ["m=3", "redeclare Lib.Dry friction"]).
        declarations: without semicolons: "parameter Real F(unit=\\"N\\") = 0".
        protected: declarations that only the class itself uses.
        initial: equations of the initial section, without semicolons.
        equations: without semicolons.
        annotation: what stands in its brackets; "" for none.
    """
    lines = [f"// {line}".rstrip() for line in comment.splitlines()]
    lines.append(f"{kind} {name} {quoted(description)}" if description else f"{kind} {name}")
    for inner in classes:
        lines += [f"  {line}" for line in inner.splitlines()]
    for base, modifications in extends:
        bracket = "(\n    " + ",\n    ".join(modifications) + ")" if modifications else ""
        lines.append(f"  extends {base}{bracket};")
    lines += [f"  {declaration};" for declaration in declarations]
    if protected:
        lines += ["protected", *(f"  {declaration};" for declaration in protected)]
    if initial:
        lines += ["initial equation", *(f"  {equation};" for equation in initial)]
    if equations:
        lines += ["equation", *(f"  {equation};" for equation in equations)]
    if annotation:
        lines.append(f"  annotation({annotation});")
    return "\n".join([*lines, f"end {name};", ""])


def quoted(text: str) -> str:
    """A text as a Modelica string."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
