"""Which input of a model carries the rate of another."""

from __future__ import annotations

from pysim.types import Model


def rate_input(model: Model, command: str) -> str | None:
    """The input that wants the command's derivative, by the naming of thesis Appendix F (u, u_t, u_tt)."""
    name = f"{command}_t"
    return name if any(v.name == name and v.causality == "input" for v in model.variables) else None
