"""Settings of a run that an SSP package does not carry, in words: whoever reads it takes their usual values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from pysim.cosim.gauss_seidel import GaussSeidel
from pysim.cosim.iterated import Iterated
from pysim.cosim.members import Fmu
from pysim.cosim.system_file import SystemFile


def lost_settings(file: SystemFile, fmus: Mapping[str, Fmu]) -> Iterator[str]:
    """A phrase each, where the run with the usual values is another one."""
    if file.doubling is not None:
        yield "the doubling of steps"
    if isinstance(file.order, GaussSeidel) and file.order.order:
        yield f"the sequence {', '.join(file.order.order)}"
    if isinstance(file.order, Iterated) and file.order != Iterated():
        yield "the limits of the iteration"
    for name, fmu in fmus.items():
        usual = Fmu(name, fmu.model, parameters=fmu.parameters, record=fmu.record, interface=fmu.interface)
        if fmu.interface == "model-exchange" and fmu.solver != usual.solver:
            yield f"the solver of {name}"
        if fmu.may_return_early != usual.may_return_early:
            yield f"that {name} handles its events alone"
        if fmu.feedthrough != usual.feedthrough:
            yield f"the feedthrough of {name}"
