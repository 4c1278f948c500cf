"""The state of a run that all orders of stepping work on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.cosim._balance import Balance
from pysim.cosim._exchange import Exchange
from pysim.cosim._fault import fault
from pysim.cosim._layout import Layout, Row
from pysim.cosim._sampler import Sampler
from pysim.cosim._signals import Signals
from pysim.cosim.member import Array, Member
from pysim.cosim.system import System


class Core:
    """Row, members and what is done at a point.

    Attributes:
        scale: (n_out) largest magnitude that each output of a member has had; kept up by those who need it.
        counts: steps, iterations, events, rejected, loop_evaluations.
    """

    def __init__(
        self, system: System, layout: Layout, row: Row, samplers: Mapping[str, Sampler], signals: Signals
    ) -> None:
        self.system, self.layout, self.row, self.samplers, self.signals = system, layout, row, samplers, signals
        self.exchange = Exchange(system, layout, row, list(samplers.values()), signals)
        self.sources: Array = row.part(layout.sources)
        self.outputs: Array = row.part(layout.member_outputs)
        self.scale: Array = np.zeros(self.outputs.size)
        self.counts = self.exchange.counts
        self.balance = Balance(system, layout, row) if system.bonds else None

    def enlarge_scale(self) -> None:
        """Take the present outputs into account."""
        np.maximum(self.scale, np.abs(self.outputs), out=self.scale)

    def save(self, into: list[Any] | None = None) -> list[Any]:
        """States of all members."""
        old = [None] * len(self.layout.members) if into is None else into
        return [save(member, state) for member, state in zip(self.layout.members, old, strict=True)]

    def restore(self, states: list[Any]) -> None:
        """Put all members back."""
        for member, state in zip(self.layout.members, states, strict=True):
            restore(member, state)


def save(member: Member, into: Any = None) -> Any:
    """A member's state.

    Raises:
        Fault: it could not be saved.
    """
    try:
        return member.save(into)
    except Exception as error:
        raise fault(member.name, error) from error


def restore(member: Member, state: Any) -> None:
    """Put a member back.

    Raises:
        Fault: it could not.
    """
    try:
        member.restore(state)
    except Exception as error:
        raise fault(member.name, error) from error
