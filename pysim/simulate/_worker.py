"""A process that runs FMUs of others: questions come on standard input, answers go to standard output."""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
import time
from contextlib import ExitStack
from typing import Any, BinaryIO

from pysim.simulate._library import Library, open_library
from pysim.simulate._pass import run_tasks
from pysim.types import BadInput, Model

_PAUSE = 1.0  # s between two looks for the parent


def main() -> None:
    """Answer until nobody asks any more. A question is a model, which is opened, or requests to it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the one who asks decides
    if os.name != "nt":  # there an FMU that never returns outlives whoever asked it
        threading.Thread(target=_end_with, args=(os.getppid(),), daemon=True).start()
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what an FMU prints is no answer
    library: Library | None = None
    answer: Any
    with ExitStack() as opened:
        for question in _questions(sys.stdin.buffer):
            if isinstance(question, Model):
                opened.close()
                library, answer = _open(question, opened)
            else:
                kind, requests = question
                assert library is not None
                answer = [(found.tasks, found.number) for found in run_tasks(library, kind, requests)]
            pickle.dump(answer, answers, protocol=5)
            answers.flush()


def _end_with(parent: int) -> None:
    """End this process once its parent is gone."""
    while os.getppid() == parent:
        time.sleep(_PAUSE)
    os._exit(1)


def _questions(stream: BinaryIO) -> Any:
    while True:
        try:
            yield pickle.load(stream)
        except EOFError:
            return


def _open(model: Model, opened: ExitStack) -> tuple[Library | None, BadInput | None]:
    try:
        return opened.enter_context(open_library(model)), None
    except BadInput as error:
        return None, error


if __name__ == "__main__":
    main()
