"""Plant some forty faults, half by hand and half by a generator, and say which the tests do not notice.

    python3 run.py python -m tests.mutations [--seed 1] [--only NUMBER ...] [--list]
    python3 run.py python -m tests.mutations --thesis [--json FILE]

Works on a copy of the checkout; each fault is followed by the tests of its folder, until one fails. Exits with 1 where
more than two faults survive. Takes about half an hour on two cores. With --thesis the faults are those of thesis.toml,
each followed by the tests that it names, and none may survive: a few minutes.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import SimpleQueue

from tests.mutations.generate import Fault, faults

ROOT = Path(__file__).parents[2]
BY_HAND, THESIS = (Path(__file__).parent / name for name in ("by_hand.toml", "thesis.toml"))
ALLOWED = 2  # survivors, none of them in a formula of the thesis
CACHE = Path("build") / "cache"  # as tests/conftest.py has it
STORE = Path(os.environ.get("HTB_CACHE", ROOT / CACHE))  # what is built already
TIMEOUT = 900.0  # s for the tests of one fault; a program that hangs has been noticed
# Tests that should notice a fault below a folder: its own first, then those that use it.
WATCHED_BY = {
    "fmu_build/emit": ("tests/fmu_build/emit", "tests/contracts", "tests/fmu_build/lower"),
    "fmu_build/front": ("tests/fmu_build/front", "tests/modelica"),
    "fmu_build/lower": ("tests/fmu_build/lower", "tests/contracts", "tests/modelica"),
    "fmu_build/pack": ("tests/fmu_build/pack", "tests/contracts"),
    "fmu_build/runtime": ("tests/fmu_build/runtime", "tests/contracts", "tests/fmu_build/lower"),
    "modelica": ("tests/modelica",),
    "pysim/bench": ("tests/pysim/bench", "tests/pysim/identify"),
    "pysim/diagnosis": ("tests/pysim/diagnosis", "tests/known_answers"),
    "pysim/identify": ("tests/pysim/identify", "tests/pysim/diagnosis", "tests/known_answers"),
    "pysim/io": ("tests/pysim/io", "tests/pysim/identify"),
    "pysim/simulate": ("tests/pysim/simulate", "tests/pysim/cosim", "tests/pysim/identify"),
    "pysim/types": ("tests/pysim/types", "tests/pysim/io", "tests/pysim/identify", "tests/pysim/simulate"),
}


def watching(path: Path) -> tuple[str, ...]:
    """Folders of tests that should notice a fault in this file."""
    name = path.as_posix()
    for folder, tests in WATCHED_BY.items():
        if name.startswith(folder + "/"):
            return tests
    return ("tests/" + "/".join(path.parts[:2]),)


def written(root: Path, file: Path) -> list[Fault]:
    """The faults of a file; each text has to stand exactly once in its place."""
    found = []
    for entry in tomllib.loads(file.read_text(encoding="utf-8"))["faults"]:
        text = (root / entry["file"]).read_text(encoding="utf-8")
        if text.count(entry["old"]) != 1:
            sys.exit(
                f"{file.name}: {entry['old']!r} stands {text.count(entry['old'])} times in {entry['file']}, not once"
            )
        start = text.index(entry["old"])
        about = f"{entry['file']}:{text.count(chr(10), 0, start) + 1}: {entry['about']}"
        end, tests = start + len(entry["old"]), tuple(entry.get("tests", ()))
        found.append(Fault(Path(entry["file"]), start, end, entry["new"], about, tests))
    return found


def noticed(copy: Path, fault: Fault) -> str:
    """The test that fails with the fault planted in a copy of the checkout; "" where none does."""
    path = copy / fault.path
    text = path.read_text(encoding="utf-8")
    path.write_text(text[: fault.start] + fault.text + text[fault.end :], encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(copy), "HTB_CACHE": str(copy / CACHE)}
    try:
        for tests in fault.tests or watching(fault.path):
            words = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "--no-header", tests]
            try:
                done = subprocess.run(
                    words, cwd=copy, env=environment, capture_output=True, text=True, timeout=TIMEOUT, check=False
                )
            except subprocess.TimeoutExpired:
                return f"{tests}: does not end"
            failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
            if failed:
                return failed[0].partition(" - ")[0]
            if done.returncode not in (0, 1, 5):  # 1: slower than it may be, which is no sign of the fault
                return f"{tests}: exit status {done.returncode}"
        return ""
    finally:
        path.write_text(text, encoding="utf-8")


def copied(folder: Path) -> Path:
    """What git tracks, and what the tests have built."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, folder / name)
    if STORE.is_dir():
        shutil.copytree(STORE, folder / CACHE, symlinks=True, ignore=shutil.ignore_patterns("workbench"))
    return folder


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1, help="of the generated faults (1)")
    parser.add_argument("--only", type=int, nargs="*", help="numbers of faults, as --list prints them")
    parser.add_argument("--list", action="store_true", help="print the faults and plant none")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="faults at a time (one a core)")
    parser.add_argument("--thesis", action="store_true", help="only the formulas of the thesis")
    parser.add_argument("--json", type=Path, help="write about and test of each fault here, a line of JSON each")
    args = parser.parse_args()
    chosen = written(ROOT, THESIS) if args.thesis else [*written(ROOT, BY_HAND), *faults(ROOT, args.seed)]
    planted = dict(enumerate(chosen, 1))
    if args.only:
        planted = {number: planted[number] for number in args.only}
    if args.list:
        print(*(f"{number:3} {fault.about}" for number, fault in planted.items()), sep="\n")
        return 0
    survivors = []
    copies: SimpleQueue[Path] = SimpleQueue()
    with tempfile.TemporaryDirectory(prefix="mutations-") as folder, ThreadPoolExecutor(args.workers) as pool:
        for worker in range(args.workers):
            copies.put(copied(Path(folder) / str(worker)))

        def ask(number: int) -> tuple[int, str, float]:
            copy, begun = copies.get(), time.monotonic()
            try:
                return number, noticed(copy, planted[number]), time.monotonic() - begun
            finally:
                copies.put(copy)

        for number, test, took in pool.map(ask, planted):
            print(f"{number:3} {planted[number].about}\n    {test or 'SURVIVES'} ({took:.0f} s)", flush=True)
            survivors += [] if test else [planted[number].about]
            if args.json:
                with args.json.open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"about": planted[number].about, "test": test}) + "\n")
    print(f"\n{len(planted)} faults, {len(survivors)} not noticed", *survivors, sep="\n  ")
    return int(len(survivors) > (0 if args.thesis else ALLOWED))


if __name__ == "__main__":
    sys.exit(main())
