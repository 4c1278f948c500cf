"""Questions to one running omc, every answer looked at.

The plain session of OMPython is used, not its ModelicaSystem classes: those add options of their own to each build
(`--generateSymbolicLinearization`), under which a built model has been seen to run past its stop time.
"""

import logging
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from fmu_build.errors import BuildError, Underdetermined
from fmu_build.openmodelica.installation import what_is_missing

START_S = 30.0  # OMPython waits this long for omc's port, also where omc has ended at once
ANSWER_S = 900.0  # compiling the C code of a large model; OMPython itself would wait for ever for an omc that crashed
_SHOWN = 3  # messages
_RECORD = re.compile(
    r"^\d+: \[\w+:(?P<level>\w+):\d+\] "
    r"\[(?P<file>[^\]\n]*):\w+:(?P<line>\d+):\d+:\d+:\d+\] (?P<text>.*?)(?=^\d+: \[|\Z)",
    re.MULTILINE | re.DOTALL,
)
_OPEN = re.compile(r"under-determined|over-determined|singular", re.IGNORECASE)  # what omc calls such a system
_LOG = re.compile(r"Log-file says:\n(.*)", re.DOTALL)


class Session:
    """One omc; `open_session` makes it."""

    def __init__(self, omc: Any, failure: type[Exception], longest: float = ANSWER_S) -> None:
        self._omc, self._failure, self._longest = omc, failure, longest

    def ask(self, expression: str) -> Any:
        """omc's answer as a Python value.

        Raises:
            BuildError: omc reports an error, with file and line where it names them, or does not answer.
        """
        try:
            return _within(self._longest, lambda: self._omc.sendExpression(expression), expression)
        except self._failure as failure:
            raise told(str(failure)) from None

    def require(self, expression: str) -> None:
        """For what omc answers by true or false."""
        answer = self.ask(expression)
        if answer is not True:
            raise BuildError(f"omc answers {answer} to {expression}: {self.reason()}")

    def reason(self) -> str:
        """What omc has to say beside its last answer."""
        text = str(self.ask("getErrorString()")).strip().strip('"').strip()
        return " ".join(text.split()) or "it gives no reason"


@contextmanager
def open_session() -> Iterator[Session]:
    """Start an omc of this machine, and end it.

    Raises:
        BuildError: OpenModelica or OMPython is missing, or omc does not start; says why.
    """
    missing = what_is_missing()
    if missing:
        raise BuildError(f"building with OpenModelica: {missing}.")
    import OMPython

    failure = getattr(OMPython, "OMSessionException", None) or OMPython.OMCSessionException
    with _listening() as heard:
        omc = _start(OMPython, failure, heard)
        try:
            yield Session(omc, failure)
        finally:
            _end(omc)


def told(text: str) -> BuildError:
    """OMPython's report of omc's messages as one error: the first errors, at the place of the first that has one."""
    errors = [found for found in _RECORD.finditer(text) if found["level"] == "error"]
    if not errors:
        return BuildError(f"omc: {' '.join(text.split())}")
    message = "; ".join(dict.fromkeys(" ".join(found["text"].split()) for found in errors[:_SHOWN]))
    kind = Underdetermined if _OPEN.search(message) else BuildError
    placed = next((found for found in errors if found["file"].endswith(".mo")), None)
    if placed is None:
        return kind(f"omc: {message}")
    return kind(f"omc: {message}", Path(placed["file"]), int(placed["line"]))


def quoted(text: Path | str) -> str:
    """As a string of omc's language."""
    words = text.as_posix() if isinstance(text, Path) else text
    return '"' + words.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _start(ompython: Any, failure: type[Exception], heard: list[str]) -> Any:
    start = getattr(ompython, "OMCSessionLocal", None) or ompython.OMCSessionZMQ  # the latter before OMPython 4.1
    try:
        return start(timeout=START_S)
    except (failure, OSError) as error:
        log = next((found[1] for text in heard if (found := _LOG.search(text))), "")
        why = " ".join((log or str(error)).split())
        raise BuildError(f"omc does not start: {why}") from None


def _end(omc: Any) -> None:
    """Let omc quit; one that no longer answers is killed."""
    process: Any = getattr(omc, "_omc_process", None)
    try:
        _within(5.0, lambda: omc.sendExpression("quit()"), "quit()")
    except Exception:
        with suppress(Exception):
            process.kill()


@contextmanager
def _listening() -> Iterator[list[str]]:
    """What OMPython logs, kept from the console: its reports of a failed start hold omc's own words."""
    heard: list[str] = []
    handler = logging.Handler()
    handler.emit = lambda record: heard.append(record.getMessage())  # type: ignore[method-assign]
    logger = logging.getLogger("OMPython")
    spread = logger.propagate
    logger.addHandler(handler)
    logger.propagate = False
    try:
        yield heard
    finally:
        logger.removeHandler(handler)
        logger.propagate = spread


def _within(longest: float, call: Callable[[], Any], what: str) -> Any:
    """The result of a call that may never return."""
    box: list[Any] = []
    failed: list[BaseException] = []

    def work() -> None:
        try:
            box.append(call())
        except BaseException as error:
            failed.append(error)

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    thread.join(longest)
    if failed:
        raise failed[0]
    if thread.is_alive():
        raise BuildError(f"omc has not answered {what} for {longest:g} s; it may have crashed on the model")
    return box[0]
