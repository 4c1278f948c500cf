"""Which native function serves which family of methods; resolved when the loop is compiled."""

from __future__ import annotations

from typing import Any

from numba.extending import overload

from pysim.simulate._explicit import ExplicitMethod, attempt_explicit, explicit_dense

_ATTEMPT = {ExplicitMethod: attempt_explicit}
_DENSE = {ExplicitMethod: explicit_dense}


def attempt_step(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any, h: float) -> tuple[int, float]:
    """One step of length h (s) from run.t: fills work.k and work.x_new; the worst status and the error norm."""
    raise NotImplementedError("native only")


def dense_coefficients(method: Any, work: Any, h: float) -> None:
    """Fill work.dense with the interpolant over the step just taken."""
    raise NotImplementedError("native only")


@overload(attempt_step, strict=False)
def _attempt_step(method: Any, control: Any, fmu: Any, inputs: Any, run: Any, work: Any, h: Any) -> Any:
    family = _ATTEMPT[method.instance_class]
    return lambda method, control, fmu, inputs, run, work, h: family(method, control, fmu, inputs, run, work, h)


@overload(dense_coefficients, strict=False)
def _dense_coefficients(method: Any, work: Any, h: Any) -> Any:
    family = _DENSE[method.instance_class]
    return lambda method, work, h: family(method, work, h)
