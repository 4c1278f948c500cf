"""What a diagnosis says to one complete model, as a line."""

from __future__ import annotations

import sys
import time

from pysim.diagnosis import diagnose
from validation.batch import Line, serve
from validation.nulls.data import drawn


def answer(name: str) -> Line:
    """Names, sensor errors among them, whether it is said to be complete, residual over floor, and CPU time."""
    session = drawn(name)
    begun = time.process_time()
    found = diagnose(session)
    return {
        "named": [one.effect.name for one in found.effects],
        "learned": [law.slot for law in found.learned],
        "complete": found.complete,
        "fit": found.left.fit,
        "validate": found.left.validate,
        "share": found.left.share_explained,
        "cpu": round(time.process_time() - begun, 2),
    }


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
