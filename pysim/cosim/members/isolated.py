"""A member in a process of its own, so that its crash is an error message."""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
import weakref
from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.cosim.member import Member, MemberFailed, Setup
from pysim.cosim.members._worker import DONE, FAILED, UNREADABLE
from pysim.types import BadInput, Outcome, Port

_GONE = None
_PATIENCE = 5.0  # s for a process to go once nobody needs it
_WAKING = 120.0  # s for a process to come up, on a machine that is busy


class _Kept:
    """A state that lies in the other process."""

    def __init__(self, number: int) -> None:
        self.number = number


class Isolated:
    """A member whose run takes place in a process of its own; a `Member` itself.

    A step costs some 100 us more. What the other process prints goes to standard error.

    Args:
        member: an Fmu, or another member that can be pickled before it is started.
        time_limit: s that one call may take; then the process is ended, and the member has failed. The first two calls
            have two minutes, because a process has to come up.
    Raises:
        BadInput: a member that cannot be sent to another process, or a limit that is not positive.
    """

    def __init__(self, member: Member, *, time_limit: float = 60.0) -> None:
        if not time_limit > 0:
            raise BadInput(f"{member.name}: the time limit is {time_limit:g} s; give a positive one")
        if type(member).__module__ == "__main__":  # another process has another one
            raise BadInput(_unsendable(member.name, f"{type(member).__name__} is a class of __main__"))
        try:
            self._message = pickle.dumps(member)
        except Exception as error:  # whatever the member's own parts raise
            raise BadInput(_unsendable(member.name, error)) from error
        self._member, self._limit = member, time_limit
        self._process: subprocess.Popen[bytes] | None = None
        self._setup: Setup | None = None
        self._event, self._count = False, 0
        self._unused: list[int] = []

    def __repr__(self) -> str:
        return f"Isolated({self._member!r})"

    @property
    def member(self) -> Member:
        """What is isolated; it is never started here."""
        return self._member

    @property
    def name(self) -> str:
        """That of the member."""
        return self._member.name

    @property
    def inputs(self) -> tuple[Port, ...]:
        """Those of the member."""
        return self._member.inputs

    @property
    def outputs(self) -> tuple[Port, ...]:
        """Those of the member."""
        return self._member.outputs

    @property
    def feedthrough(self) -> Mapping[str, frozenset[str]]:
        """That of the member."""
        return self._member.feedthrough

    @property
    def can_rollback(self) -> bool:
        """As the member."""
        return self._member.can_rollback

    @property
    def can_vary_step(self) -> bool:
        """As the member."""
        return self._member.can_vary_step

    @property
    def takes_rates(self) -> bool:
        """As the member."""
        return self._member.takes_rates

    @property
    def may_return_early(self) -> bool:
        """As the member."""
        return self._member.may_return_early

    @property
    def event(self) -> bool:
        """Whether the step that just ended left an event."""
        return self._event

    def start(self, setup: Setup) -> None:
        """See Member; begins the process."""
        self.close()
        self._setup, self._unused = setup, []
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path or os.getcwd() for path in sys.path)}
        self._process = subprocess.Popen(
            [sys.executable, "-c", "from pysim.cosim.members._worker import main; main()"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        self._answers: queue.SimpleQueue[Any] = queue.SimpleQueue()
        threading.Thread(target=_listen, args=(self._process, self._answers), daemon=True).start()
        self._send(self._message)
        self._call("start", setup.time, setup.stop, setup.step, dict(setup.overrides))

    def begin(self) -> None:
        """See Member."""
        self._call("begin")

    def update(self) -> None:
        """See Member."""
        self._call("update")

    def step(self, time: float, end: float) -> float:
        """See Member."""
        reached: float = self._call("step", time, end)
        return reached

    def save(self, into: Any = None) -> Any:
        """See Member."""
        self._count += 1
        kept = into if into is not None else _Kept(self._count)
        unused, self._unused[:] = tuple(self._unused), []
        self._call("save", kept.number, unused)
        if into is None:
            weakref.finalize(kept, self._unused.append, kept.number).atexit = False
        return kept

    def restore(self, state: Any) -> None:
        """See Member."""
        self._call("restore", state.number)

    def close(self) -> None:
        """See Member; ends the process."""
        process, self._process = self._process, None
        if process is None:
            return
        if process.stdin is not None:
            with contextlib.suppress(OSError):
                process.stdin.close()  # the other side ends at the end of its input
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def _send(self, message: bytes) -> None:
        process = self._process
        if process is None or process.stdin is None:
            raise BadInput(f"{self.name} has not been started; call start first")
        with contextlib.suppress(OSError):  # it is gone: the answer tells how
            process.stdin.write(message)
            process.stdin.flush()

    def _call(self, name: str, *arguments: Any) -> Any:
        setup = self._setup
        assert setup is not None or self._process is None
        inputs = b"" if setup is None else setup.inputs.tobytes() + setup.rates.tobytes()
        self._send(pickle.dumps((name, inputs, arguments), protocol=pickle.HIGHEST_PROTOCOL))
        try:
            limit = max(self._limit, _WAKING) if name in ("start", "begin") else self._limit
            answer = self._answers.get(timeout=limit)
        except queue.Empty:
            self._kill()
            raise MemberFailed(f"its process did not answer within {limit:g} s and was ended") from None
        if answer is _GONE:
            raise MemberFailed(f"its process {self._end()}")
        return self._understand(answer)

    def _understand(self, answer: tuple[str, Any, bytes, bool]) -> Any:
        kind, what, outputs, event = answer
        if kind == DONE:
            assert self._setup is not None
            self._setup.outputs[:] = np.frombuffer(outputs)
            self._event = event
            return what
        if kind == FAILED:
            text, outcome = what
            raise MemberFailed(text, outcome or Outcome.MODEL_ERROR)
        raise BadInput(_unsendable(self.name, what) if kind == UNREADABLE else what)

    def _kill(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()

    def _end(self) -> str:
        """How the process went, as the end of a sentence."""
        process, self._process = self._process, None
        assert process is not None
        return how_it_ended(process.wait())


def how_it_ended(code: int) -> str:
    """The exit status of a process as the end of a sentence; Windows' crashes are known by their hex digits."""
    if code < 0:
        return f"crashed ({signal.Signals(-code).name})"
    return f"ended by itself with code {code:#x}" if code > 255 else f"ended by itself with code {code}"


def _unsendable(name: str, why: object) -> str:
    return f"{name} cannot be sent to another process ({why}); make its class one of a module"


def _listen(process: subprocess.Popen[bytes], answers: queue.SimpleQueue[Any]) -> None:
    """Put every answer where it can be waited for with a limit; None when no more can come."""
    assert process.stdout is not None
    with process.stdout as stream:
        while True:
            try:
                answers.put(pickle.load(stream))
            except (EOFError, OSError, pickle.UnpicklingError):
                answers.put(_GONE)
                return
