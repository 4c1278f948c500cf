"""Every benchmark by name, each run in a process of its own with one BLAS thread."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from importlib import import_module
from pathlib import Path
from types import MappingProxyType

from validation.benchmarks.measurement import Measurement

PAIRS = 3
_ROOT = Path(__file__).parents[2]
_ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")

BENCHMARKS: Mapping[str, str] = MappingProxyType(
    {
        "whole-fit": "whole_fit",
        "two-cores": "two_cores",
        "python-share": "python_share",
        "orbits": "orbits",
        "sixteen-times": "sixteen_times",
        "ten-million": "ten_million",
        "cluster": "cluster",
        "workbench": "workbench",
    }
)


def run_one(name: str, *, pairs: int = PAIRS, full: bool = False) -> Iterator[Measurement]:
    """What one benchmark measures, line by line as it comes.

    Args:
        pairs: how often what is timed is timed.
        full: all ten million rows of "ten-million".
    Raises:
        RuntimeError: it failed.
    """
    words = [sys.executable, "-m", "validation.benchmarks.suite", BENCHMARKS[name], str(pairs), str(int(full))]
    with subprocess.Popen(
        words, cwd=_ROOT, env={**os.environ, **_ONE_THREAD}, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            yield Measurement(**json.loads(line))
    if process.returncode:
        raise RuntimeError(f"benchmark {name} ended with {process.returncode}")


def _main(module: str, pairs: int, full: bool) -> None:
    """One JSON line per measurement, and nothing else, to standard output."""
    channel = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    benchmark = import_module(f"validation.benchmarks.{module}")
    for found in benchmark.measure_whole() if full else benchmark.measure(pairs):
        channel.write(json.dumps(asdict(found)) + "\n")
        channel.flush()


if __name__ == "__main__":
    _main(sys.argv[1], int(sys.argv[2]), sys.argv[3] == "1")
