"""The other process: one member, which receives its orders through its standard input. Begun by `Isolated`."""

from __future__ import annotations

import os
import pickle
import signal
import sys
from typing import Any, BinaryIO

import numpy as np

from pysim.cosim.member import Member, MemberFailed, Setup
from pysim.types import BadInput

DONE, FAILED, REFUSED, UNREADABLE = "done", "failed", "refused", "unreadable"


class Worker:
    """Carries out one call after the other; states stay here, the other side holds their numbers."""

    def __init__(self, member: Member) -> None:
        self._member = member
        self._setup: Setup | None = None
        self._states: dict[int, Any] = {}

    def call(self, name: str, inputs: bytes, arguments: tuple[Any, ...]) -> tuple[Any, bytes, bool]:
        """What the call returns, all outputs, and whether there is an event.

        Args:
            inputs: the inputs and their rates, as they lie in memory.
        """
        if name == "start":
            self._start(*arguments)
        setup = self._setup
        assert setup is not None
        n = setup.inputs.size
        both = np.frombuffer(inputs)
        setup.inputs[:], setup.rates[:] = both[:n], both[n:]
        result = None
        if name == "start":
            self._member.start(setup)
        else:
            result = getattr(self, f"_{name}")(*arguments)
        return result, setup.outputs.tobytes(), self._member.event

    def _start(self, time: float, stop: float, step: float, overrides: dict[str, float]) -> None:
        n, m = len(self._member.inputs), len(self._member.outputs)
        self._states.clear()
        self._setup = Setup(time, stop, step, np.zeros(n), np.zeros(n), np.zeros(m), overrides)

    def _begin(self) -> None:
        self._member.begin()

    def _update(self) -> None:
        self._member.update()

    def _step(self, time: float, end: float) -> float:
        return self._member.step(time, end)

    def _save(self, number: int, unused: tuple[int, ...]) -> None:
        into = self._states.pop(number, None)
        for other in unused:
            self._states.pop(other, None)
        self._states[number] = self._member.save(into)

    def _restore(self, number: int) -> None:
        self._member.restore(self._states[number])

    def _close(self) -> None:
        self._member.close()


def serve(source: BinaryIO, target: BinaryIO) -> None:
    """Answer until the other side goes away. An answer is (kind, what, outputs, event)."""
    try:
        worker = Worker(pickle.load(source))
    except EOFError:
        return
    except Exception as error:  # whatever its module raises where it is imported
        _answer(target, (UNREADABLE, str(error), b"", False))
        return
    while True:
        try:
            name, inputs, arguments = pickle.load(source)
        except EOFError:
            return
        try:
            answer = (DONE, *worker.call(name, inputs, arguments))
        except MemberFailed as error:
            answer = (FAILED, (str(error), error.outcome), b"", False)
        except BadInput as error:
            answer = (REFUSED, str(error), b"", False)
        except Exception as error:
            answer = (FAILED, (f"{type(error).__name__}: {error}", None), b"", False)
        _answer(target, answer)


def _answer(target: BinaryIO, answer: tuple[str, Any, bytes, bool]) -> None:
    pickle.dump(answer, target, protocol=pickle.HIGHEST_PROTOCOL)
    target.flush()


def main() -> None:
    """Keep the way back for answers alone: whatever the member prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the other side stops, and then so do we
    serve(sys.stdin.buffer, answers)
