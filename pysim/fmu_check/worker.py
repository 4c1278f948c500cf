"""`python -m pysim.fmu_check.worker FMU NUMBER ...`: run checks by their place, one line of JSON for all that is found.

A process of its own, for an FMU may crash it. The line {"started": ...} comes before each check, and {"alive": true}
every other second of a long one, as long as the FMU answers.
"""

from __future__ import annotations

import json
import os
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.instance import CallFailed
from pysim.fmu_check.result import FAILS, CheckResult, skipped
from pysim.fmu_check.subject import Subject, read_subject
from pysim.types import BadInput

_FMPY = "fmpy"  # the folder of whoever calls the FMU for us
_EVERY_S = 1.0  # between two signs of life


def main(words: Sequence[str]) -> None:
    """Write to standard output; whatever the FMU prints goes nowhere."""
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    subject, names = read_subject(Path(words[0]), _sign_of_life(channel)), list(CHECKS)
    for word in words[1:]:
        name = names[int(word)]
        _say(channel, {"started": name})
        for result in results_of(name, subject):
            _say(channel, {"result": result.data()})
    _say(channel, {"done": True})


def results_of(name: str, subject: Subject) -> Iterator[CheckResult]:
    """A check's results; a description that it cannot be tried by, an error of the FMU in a legal call, or of ours,
    becomes one.
    """
    try:
        yield from CHECKS[name](subject)
    except BadInput as error:
        yield skipped(name.partition(":")[0], f"{name!r} can be tried", str(error))
    except CallFailed as error:
        yield CheckResult(name.partition(":")[0], f"every legal call of {name!r} is obeyed", FAILS, str(error))
    except Exception as error:  # FMPy raises bare exceptions, and the other checks are still to be tried
        last = traceback.extract_tb(error.__traceback__)[-1]
        text = f"{type(error).__name__} in {last.name}: {error}"
        ours = _FMPY not in Path(last.filename).parts
        claim = f"{name!r} can be tried"
        yield (
            skipped(name.partition(":")[0], claim, f"a mistake of ours, not of the FMU: {text}")
            if ours
            else CheckResult(name.partition(":")[0], claim, FAILS, text)
        )


def _sign_of_life(channel: Any) -> Callable[[], None]:
    """What is called at every answer of the FMU, and says so now and then."""
    told = time.monotonic()

    def alive() -> None:
        nonlocal told
        if time.monotonic() > told + _EVERY_S:
            told = time.monotonic()
            _say(channel, {"alive": True})

    return alive


def _say(channel: Any, data: dict[str, Any]) -> None:
    channel.write(json.dumps(data) + "\n")
    channel.flush()


if __name__ == "__main__":
    main(sys.argv[1:])
