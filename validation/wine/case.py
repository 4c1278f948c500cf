"""Load and step the pump's Windows binary under Wine, and compare with this machine's binary."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from fmpy.fmi2 import FMU2Slave
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.types import Model
from validation.findings import Finding
from validation.pump import CLASSES

# Tight, so that step sizes chosen a little differently (by another pow()) do not show in the answer
TOLERANCE = 1e-9
SIGNALS = ("alphaCMD", "alphaPercent")
STEP, COUNT, COMMAND = 0.01, 50, 40.0  # s, steps, percent: a step of the command and half a second of answer
_HERE = Path(__file__).parent
_CLAIM = "Windows binary under Wine: largest difference of alphaPercent from this machine's binary"
_LONGEST_S = 1200.0  # zig compiles its C library for Windows once, which takes some minutes


def run() -> Iterator[Finding]:
    """One finding; skipped where there is no Wine."""
    wine = shutil.which("wine64") or shutil.which("wine")
    if wine is None:
        yield Finding(_CLAIM, float("nan"), 1e-6, "%", "there is no Wine here (Debian: apt-get install wine64)")
        return
    with tempfile.TemporaryDirectory() as scratch:
        loader, folder = _compile_loader(Path(scratch)), Path(scratch) / "fmu"
        model = read_model(fmu_build.build(CLASSES["free"], platforms=("host", "x86_64-windows")))
        with zipfile.ZipFile(model.path) as archive:
            archive.extractall(folder)
        here, there = step_here(model, folder), step_under_wine(model, wine, loader, folder)
    yield Finding("Windows binary under Wine: steps that are missing", float(COUNT - there.size), 0, "")
    yield Finding("the angle moves: short of 1 percent by", max(0.0, 1.0 - float(np.max(np.abs(here)))), 0, "%")
    yield Finding(_CLAIM, float(np.max(np.abs(here[: there.size] - there), initial=0.0)), 1e-6, "%")


def step_here(model: Model, folder: Path) -> NDArray[np.float64]:
    """alphaPercent after every step (COUNT,), by FMPy with the same calls as loader.c."""
    fmu = FMU2Slave(
        guid=model.token, modelIdentifier=model.abilities.library, unzipDirectory=str(folder), instanceName="here"
    )
    command, angle = ([model[name].reference] for name in SIGNALS)
    fmu.instantiate()
    fmu.setupExperiment(tolerance=TOLERANCE, startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    fmu.setReal(command, [COMMAND])
    values = []
    for i in range(COUNT):
        fmu.doStep(i * STEP, STEP)
        values += fmu.getReal(angle)
    fmu.terminate()
    fmu.freeInstance()
    return np.array(values)


def step_under_wine(model: Model, wine: str, loader: Path, folder: Path) -> NDArray[np.float64]:
    """alphaPercent after every step, from the Windows library in the extracted FMU."""
    library = folder / "binaries" / "win64" / f"{model.abilities.library}.dll"
    references = [str(model[name].reference) for name in SIGNALS]
    resources = (folder / "resources").as_uri()
    settings = [str(number) for number in (COMMAND, STEP, COUNT, TOLERANCE)]
    words = [wine, str(loader), _windows(library), model.token, resources, *references, *settings]
    done = subprocess.run(words, capture_output=True, text=True, timeout=_LONGEST_S, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"the loader ended with {done.returncode} under Wine: {done.stderr.strip()[-2000:]}")
    return np.array([float(line.split()[1]) for line in done.stdout.splitlines()])


def _compile_loader(folder: Path) -> Path:
    """loader.c as a Windows program, by the compiler in the package ziglang."""
    package = importlib.util.find_spec("ziglang")
    if package is None or package.origin is None:
        raise RuntimeError("compiling the loader needs the Python package ziglang: pip install ziglang")
    zig = next(path for path in Path(package.origin).parent.glob("zig*") if path.stem == "zig" and path.is_file())
    loader = folder / "loader.exe"
    command = [str(zig), "cc", "-target", "x86_64-windows-gnu", "-O1", "-Wall", "-Wextra", "-Werror", "-std=c99"]
    words = [*command, str(_HERE / "loader.c"), "-o", str(loader)]
    subprocess.run(words, check=True, timeout=_LONGEST_S)
    return loader


def _windows(path: Path) -> str:
    """The path as a Windows program under Wine sees it: the root directory is drive Z."""
    return "Z:" + str(path).replace("/", "\\")
