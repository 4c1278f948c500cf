"""Set up an environment of its own beside this file, then run a command in it: `python3 run.py demo` or `... test`.

Needs Python 3.11 or later and nothing else. The first run downloads the packages that its command needs, as
pyproject.toml names them; a later command adds what it needs beside them, once. Packages in a folder wheels/ beside
this file are taken from there. What follows the command is passed on to it; `python3 run.py python FILE.py` runs a
program of your own in the environment.

`python3 run.py bundle` fills wheels/ for a PC without a network, of this system or of another:
`python3 run.py bundle --platform win_amd64 --python 3.12`. Copy the whole folder there.
"""

import argparse
import hashlib
import os
import queue
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = ENVIRONMENT / "installed.txt"  # the fingerprint, then the groups of packages, a line each
BEFORE = ROOT / "build" / "environment-before"  # what .venv was, until its successor is complete
BYTECODE = ROOT / "build" / "bytecode"
WHEELS = ROOT / "wheels"
COMMANDS = {
    "demo": ["-m", "pysim", "demo"],
    "pysim": ["-m", "pysim"],
    "fmu-build": ["-m", "fmu_build"],
    "validate": ["-m", "pysim", "validate"],
    "python": [],
}
CHECKS = {  # run beside this file; the others where they were called
    "test": ["-m", "pytest", "-n", "auto", "--dist", "loadfile"],
    "lint": ["-m", "ruff", "check"],
    "types": ["-m", "mypy"],
    "docs": ["-m", "sphinx", "-W", "--keep-going", "docs", "build/docs"],
}
EXTRAS = {"app", "data", "notebook", "openmodelica"}  # whose packages the tests and the type checker look at
GROUPS = {  # extras of the package, and dependency groups of the clone, in pyproject.toml that a command needs
    "test": EXTRAS | {"test", "bundle"},
    "validate": EXTRAS | {"test"},
    "lint": {"lint"},
    "types": EXTRAS | {"test", "lint", "bundle"},
    "docs": {"docs", "data"},
    "bundle": {"bundle"},
}
WINDOWS = os.name == "nt"
ROOM = 95  # characters of this folder's path; the packages' own come to 163 more, and Windows takes 259 as it comes
PLATFORMS = {  # of another PC: its name for uv, and the endings of wheels that run there
    "win_amd64": ("x86_64-pc-windows-msvc", ["win_amd64"]),
    "linux_x86_64": (
        "x86_64-manylinux_2_28",
        ["manylinux_2_28_x86_64", "manylinux_2_27_x86_64", "manylinux2014_x86_64"],
    ),
}


def groups_of(words: Sequence[str]) -> set[str]:
    """Groups of packages, beside those that every command needs, by the words behind run.py."""
    return {"app"} if list(words[:2]) == ["pysim", "app"] else GROUPS.get(words[0], set())


def fingerprint() -> str:
    """What the installed environment depends on: this Python, this place, and the packages asked for."""
    parts = (sys.version, str(ROOT), (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def installed() -> set[str] | None:
    """Groups that the environment holds; None where there is none, or where it is not that of `fingerprint`."""
    if not PYTHON.exists() or not STAMP.exists():
        return None
    stamp, *groups = STAMP.read_text(encoding="utf-8").split()
    return set(groups) if stamp == fingerprint() else None


def prepare(groups: Iterable[str]) -> None:
    """Bring the environment to what pyproject.toml says now, with these groups of packages.

    An environment cannot be moved: its scripts hold its path. So the one of before is set aside, and comes back to its
    own place where the new one cannot be completed. Packages that are only added need no new environment.
    """
    recover()
    held, wanted = installed(), set(groups)
    if held is not None and wanted <= held:
        return
    try:
        if held is None:
            print(f"Setting up {ENVIRONMENT} (once, half a minute or so) ...", file=sys.stderr, flush=True)
            set_aside()
            create()
        else:
            print(f"Adding packages for: {', '.join(sorted(wanted - held))} (once) ...", file=sys.stderr, flush=True)
        install(wanted | (held or set()))
        STAMP.write_text("\n".join([fingerprint(), *sorted(wanted | (held or set()))]), encoding="utf-8")
    except (subprocess.CalledProcessError, OSError) as error:
        recover()
        if held is not None or not usable():  # without the packages that were to be added the command cannot run
            sys.exit(reason(error))
        print(f"{reason(error)}\nrun.py: continuing with the previous environment.", file=sys.stderr, flush=True)
    except BaseException:  # Ctrl-C
        recover()
        raise
    else:
        recover()


def set_aside() -> None:
    """Free the place of the environment; on Windows that fails while a program of it runs."""
    if ENVIRONMENT.exists():
        BEFORE.parent.mkdir(exist_ok=True)
        ENVIRONMENT.rename(BEFORE)


def recover() -> None:
    """Take away what was set aside where its successor is complete; else put it back, even after a kill."""
    if not BEFORE.exists():
        return
    if STAMP.exists():
        shutil.rmtree(BEFORE, ignore_errors=True)  # what a running program holds goes the next time
        return
    if ENVIRONMENT.exists():
        shutil.rmtree(ENVIRONMENT)
    BEFORE.rename(ENVIRONMENT)


def create() -> None:
    """A new environment with nothing in it but pip."""
    inside = Path(sys.prefix).resolve() == ENVIRONMENT.resolve()  # this very program runs in what was set aside
    python = getattr(sys, "_base_executable", sys.executable) if inside else sys.executable
    subprocess.run([python, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)


def install(groups: Iterable[str]) -> None:
    """All packages: from wheels/ where that holds them all, else with the index.

    Bytecode is made when a module is first imported: most of what is installed never is.
    """
    extras, others = requirements(groups)
    names = ",".join(extras)
    wanted = ["--editable", f"{ROOT}[{names}]" if names else str(ROOT), *others]
    words = ["install", "--no-compile", "--progress-bar", "off", *wanted]
    if WHEELS.is_dir():
        words += ["--find-links", str(WHEELS)]
        if pip([*words, "--no-index"]) == 0:
            return
        print("run.py: wheels/ does not hold every package; asking the package index.", file=sys.stderr, flush=True)
    elif os.environ.get("HTB_INSTALLER") == "uv" and uv(wanted) == 0:
        return
    code = pip(words)
    if code:
        raise subprocess.CalledProcessError(code, "pip")


def uv(wanted: Sequence[str]) -> int:
    """Install with uv, which takes a third of pip's time, for who needs a new environment again and again; its exit
    status. What pip is configured with, such as a proxy, uv knows nothing of: so pip stays what everyone else uses."""
    known = [one for one in requirements({"bundle"})[1] if one.startswith("uv")]
    if pip(["install", "--no-compile", "--progress-bar", "off", *known]):
        return 1
    return subprocess.run([str(PYTHON), "-m", "uv", "pip", "install", "--quiet", *wanted]).returncode


def project() -> dict[str, Any]:
    """What pyproject.toml says."""
    import tomllib  # not in the Python that `main` refuses

    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def requirements(names: Iterable[str]) -> tuple[list[str], list[str]]:
    """Which of the names are extras, and the requirements of the others, which are dependency groups (PEP 735).

    Groups are read here, since the pip of a new environment knows them from 25.1 on only.
    """
    said, wanted = project(), set(names)
    groups = said.get("dependency-groups", {})
    extras = sorted(wanted & set(said["project"].get("optional-dependencies", {})))
    unknown = wanted - set(extras) - set(groups)
    if unknown:
        sys.exit(f"run.py: pyproject.toml has no extra and no dependency group {', '.join(sorted(unknown))}.")
    return extras, [one for name in sorted(wanted - set(extras)) for one in groups[name]]


def for_bundle(words: Sequence[str]) -> argparse.Namespace:
    """What `run.py bundle` is given."""
    parser = argparse.ArgumentParser(prog="run.py bundle", description=bundle.__doc__)
    everything = sorted({"app"}.union(*GROUPS.values()) - {"bundle"})
    about = (
        f"extras and groups of pyproject.toml; by default all that a command of run.py needs: {' '.join(everything)}"
    )
    parser.add_argument("names", nargs="*", default=everything, metavar="NAME", help=about)
    parser.add_argument("--platform", choices=sorted(PLATFORMS), help="system of the other PC (that of this one)")
    here = f"{sys.version_info.major}.{sys.version_info.minor}"
    parser.add_argument("--python", default=here, metavar="3.12", help=f"Python of the other PC ({here}, as here)")
    return parser.parse_args(words)


def bundle(words: Sequence[str]) -> int:
    """Fill wheels/ with all packages that a PC without a network needs, for its system and its Python."""
    given, said = for_bundle(words), project()
    extras, wanted = requirements(given.names)
    prepare({"bundle"})
    wanted += [*said["project"].get("dependencies", ()), *said["build-system"]["requires"], "editables"]
    wanted += [one for extra in extras for one in said["project"]["optional-dependencies"][extra]]
    folder = ROOT / "build" / "wheels"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    target, tags = PLATFORMS.get(given.platform, ("", []))
    (folder / "wanted.txt").write_text("\n".join(wanted) + "\n", encoding="utf-8")
    # uv decides what is needed on the other system; pip, which decides by this one, only fetches it.
    resolve = [str(PYTHON), "-m", "uv", "pip", "compile", "--quiet", "--no-header", "--no-annotate"]
    resolve += ["--python-version", given.python, *(["--python-platform", target] if target else [])]
    resolve += [str(folder / "wanted.txt"), "--output-file", str(folder / "needed.txt")]
    fetch = ["download", "--no-deps", "--only-binary=:all:", "--dest", str(folder), "--python-version", given.python]
    fetch += [word for tag in tags for word in ("--platform", tag)]
    own = ["wheel", "--no-deps", "--wheel-dir", str(folder), str(ROOT)]
    if subprocess.run(resolve).returncode or pip([*fetch, "-r", str(folder / "needed.txt")]) or pip(own):
        sys.exit("run.py: not every package could be had for that system and Python, see the messages above.")
    for list_of_names in folder.glob("*.txt"):
        list_of_names.unlink()
    shutil.rmtree(WHEELS, ignore_errors=True)
    folder.rename(WHEELS)
    sizes = [file.stat().st_size for file in WHEELS.iterdir()]
    print(f"{WHEELS}: {len(sizes)} wheels, {sum(sizes) / 1e6:.0f} MB. Copy this whole folder to the other PC.")
    return 0


def pip(words: Sequence[str]) -> int:
    """Run pip, say every few seconds what it is doing, and pass on what it says where it fails; its exit status."""
    command = [str(PYTHON), "-m", "pip", "--disable-pip-version-check", *words]
    lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
    said: list[str] = []
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    ) as process:

        def read() -> None:
            assert process.stdout is not None
            for line in process.stdout:
                lines.put(line.strip())
            lines.put(None)

        threading.Thread(target=read, daemon=True).start()
        show = Ticker()
        while True:
            try:
                line = lines.get(timeout=1.0)
            except queue.Empty:
                line = ""
            if line is None:
                break
            said += [line] if line else []
            show(line)
    show.end()
    if process.returncode:
        print("\n".join(line for line in said if line.startswith(("ERROR", "error", "Could not"))), file=sys.stderr)
    return process.returncode


class Ticker:
    """Seconds and the step pip is at, on one line of a terminal; a line every ten seconds elsewhere."""

    STEPS = (("Collecting ", "looking up"), ("Downloading ", "downloading"), ("Installing ", "installing"))

    def __init__(self) -> None:
        self.begun = self.shown = time.monotonic()
        self.step = "starting"
        self.terminal = sys.stderr.isatty()

    def __call__(self, line: str) -> None:
        for start, verb in self.STEPS:
            if line.startswith(start):
                name = "" if verb == "installing" else line[len(start) :].split()[0].rpartition("/")[2]
                self.step = f"{verb} {name}"
        now = time.monotonic()
        if now - self.shown > (0.2 if self.terminal else 10.0):
            self.shown = now
            text = f"  {now - self.begun:3.0f} s  {self.step[:70]}"
            print(f"\r{text:<80}" if self.terminal else text, end="" if self.terminal else "\n", file=sys.stderr)
            sys.stderr.flush()

    def end(self) -> None:
        if self.terminal:
            print(f"\r{'':<80}\r", end="", file=sys.stderr, flush=True)


def usable() -> bool:
    """Whether there is an environment that runs this very checkout, if perhaps with older packages."""
    code = "import os, sys, pysim; sys.exit(not os.path.samefile(os.path.dirname(pysim.__file__), sys.argv[1]))"
    try:
        asked = [str(PYTHON), "-I", "-c", code, str(ROOT / "pysim")]
        return subprocess.run(asked, cwd=ENVIRONMENT, capture_output=True).returncode == 0
    except OSError:
        return False


def reason(error: Exception) -> str:
    """Why there is no new environment, and what to do."""
    if isinstance(error, OSError):
        return f"run.py: {ENVIRONMENT} cannot be renewed ({error}); close what runs in it and try again."
    if WINDOWS and len(str(ROOT)) > ROOM:
        return (
            f"run.py: could not install the packages, see the messages above. The path of this folder has "
            f"{len(str(ROOT))} characters, and above {ROOM} some packages do not fit into the 259 that Windows takes: "
            "move the folder, for example to C:\\bench, or turn on long paths in Windows."
        )
    if "venv" in getattr(error, "cmd", ()):
        return "run.py: could not create the environment; on Debian and Ubuntu: apt install python3-venv."
    return (
        "run.py: could not install the packages, see the messages above; is the package index reachable? Without a "
        "network they can come from a folder wheels/ beside run.py, see README.md."
    )


def surroundings() -> dict[str, str]:
    """Environment variables of the command: bytecode is kept in build/, so that not every process makes it anew."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {"PYTHONPYCACHEPREFIX": str(BYTECODE)} | kept


def main() -> int:
    if sys.version_info < (3, 11):  # noqa: UP036 - this file meets the system's Python before any package does
        sys.exit(f"run.py: needs Python 3.11 or later, this is {sys.version.split()[0]}.")
    for stream in (sys.stdout, sys.stderr):  # a pipe on Windows knows Latin letters only, and folders may have others
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    known = [*COMMANDS, *CHECKS, "bundle"]
    if len(sys.argv) < 2 or sys.argv[1] not in known:
        sys.exit(f"usage: python3 run.py {{{','.join(known)}}} [arguments]\n\n{__doc__}")
    if sys.argv[1] == "bundle":
        return bundle(sys.argv[2:])
    prepare(groups_of(sys.argv[1:]))
    folder = ROOT if sys.argv[1] in CHECKS else None
    words = [str(PYTHON), *(COMMANDS | CHECKS)[sys.argv[1]], *sys.argv[2:]]
    return subprocess.run(words, cwd=folder, env=surroundings()).returncode


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
