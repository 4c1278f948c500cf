"""The script that sets up the environment: what it says, and what it leaves, when it cannot go on."""

import importlib.util
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).parents[1] / "run.py"


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *arguments], capture_output=True, text=True)


def test_without_a_command_it_lists_them() -> None:
    result = run()
    assert result.returncode == 1
    assert "usage: python3 run.py {demo," in result.stderr


def test_unknown_command_is_refused_before_anything_is_set_up(tmp_path: Path) -> None:
    copy = tmp_path / "run.py"
    copy.write_text(SCRIPT.read_text(encoding="utf-8"), encoding="utf-8")
    result = subprocess.run([sys.executable, str(copy), "dance"], capture_output=True, text=True)
    assert result.returncode == 1
    assert not (tmp_path / ".venv").exists()


@pytest.fixture
def script(tmp_path: Path) -> ModuleType:
    """A copy of the script in a folder of its own."""
    (tmp_path / "run.py").write_text(SCRIPT.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text("one")
    spec = importlib.util.spec_from_file_location("run_copy", tmp_path / "run.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def prepared(script: ModuleType, monkeypatch: pytest.MonkeyPatch, *, works: bool = True) -> list[set[str]]:
    """Stand-ins for venv, pip and the question whether the environment works; the groups that pip is asked for."""
    asked: list[set[str]] = []

    def create() -> None:
        assert not script.ENVIRONMENT.exists()
        script.PYTHON.parent.mkdir(parents=True)
        script.PYTHON.write_text("new")

    monkeypatch.setattr(script, "create", create)
    monkeypatch.setattr(script, "install", lambda groups: asked.append(set(groups)))
    monkeypatch.setattr(script, "usable", lambda: works and script.PYTHON.is_file())
    return asked


def fails(script: ModuleType, monkeypatch: pytest.MonkeyPatch, error: BaseException) -> None:
    """From now on pip ends like this."""

    def install(groups: set[str]) -> None:
        raise error

    monkeypatch.setattr(script, "install", install)


def installed(script: ModuleType, monkeypatch: pytest.MonkeyPatch, **options: bool) -> None:
    """An environment that was made before, from another pyproject.toml."""
    prepared(script, monkeypatch, **options)
    script.prepare({"app"})
    script.PYTHON.write_text("old")
    (script.ROOT / "pyproject.toml").write_text("two")


def no_index() -> subprocess.CalledProcessError:
    return subprocess.CalledProcessError(1, "pip")


def test_each_command_installs_what_it_needs_once(script: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = prepared(script, monkeypatch)
    for words in (
        ["demo"],
        ["pysim", "fit"],
        ["pysim", "app"],
        ["pysim", "app"],
        ["test"],
        ["lint"],
        ["types"],
        ["demo"],
    ):
        script.prepare(script.groups_of(words))
    tests = {"app", "data", "notebook", "openmodelica", "test", "bundle"}
    assert asked == [set(), {"app"}, tests, tests | {"lint"}]
    (script.ROOT / "pyproject.toml").write_text("two")
    script.prepare(script.groups_of(["demo"]))
    assert asked[4:] == [set()]


def test_packages_that_cannot_be_added_leave_the_environment_as_it_is(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepared(script, monkeypatch)
    script.prepare(set())
    fails(script, monkeypatch, no_index())
    with pytest.raises(SystemExit, match="is the package index reachable"):
        script.prepare({"test"})
    assert script.installed() == set()


def test_without_the_index_the_environment_of_before_stays(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    installed(script, monkeypatch)
    fails(script, monkeypatch, no_index())
    script.prepare(set())
    said = capsys.readouterr().err
    assert "could not install the packages" in said
    assert "continuing with the previous environment" in said
    assert script.PYTHON.read_text() == "old"
    assert script.installed() is None  # the next run tries again
    assert not script.BEFORE.exists()
    prepared(script, monkeypatch)
    script.prepare(set())
    assert script.PYTHON.read_text() == "new"
    assert script.installed() == set()
    assert not script.BEFORE.exists()


def test_an_environment_of_another_place_is_not_continued_with(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed(script, monkeypatch, works=False)
    fails(script, monkeypatch, no_index())
    with pytest.raises(SystemExit, match="is the package index reachable"):
        script.prepare(set())
    assert script.PYTHON.read_text() == "old"


def test_stopped_while_setting_up_it_leaves_what_was_there(script: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    installed(script, monkeypatch)
    fails(script, monkeypatch, KeyboardInterrupt())
    with pytest.raises(KeyboardInterrupt):
        script.prepare(set())
    assert script.PYTHON.read_text() == "old"
    assert not script.BEFORE.exists()
    script.set_aside()  # and killed here, the next run puts it back
    (script.ROOT / "pyproject.toml").write_text("one")
    script.prepare({"app"})
    assert script.PYTHON.read_text() == "old"


def test_what_runs_in_it_keeps_it_from_being_renewed(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    installed(script, monkeypatch)

    def locked(self: Path, target: Path) -> None:
        raise PermissionError(13, "in use", str(self))

    monkeypatch.setattr(Path, "rename", locked)
    script.prepare(set())
    assert "close what runs in it and try again" in capsys.readouterr().err
    assert script.PYTHON.read_text() == "old"


WITH_GROUPS = """
[project]
dependencies = ["needed"]
optional-dependencies = { app = ["server"], data = ["tables"] }
[dependency-groups]
test = ["pytest>=8.0", "xdist"]
"""


def test_a_name_that_is_neither_extra_nor_group_is_refused(script: ModuleType) -> None:
    (script.ROOT / "pyproject.toml").write_text(WITH_GROUPS)
    with pytest.raises(SystemExit, match=r"no extra and no dependency group apps, tests"):
        script.requirements(["apps", "data", "tests"])


def test_every_group_that_a_command_needs_is_there() -> None:
    """Of the script and the pyproject.toml of this clone."""
    spec = importlib.util.spec_from_file_location("run_itself", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for command, names in module.GROUPS.items():
        extras, others = module.requirements(names)  # ends where one is neither
        assert len(extras) + len(others) >= len(names), command


def wheel_of(folder: Path, name: str, tag: str = "py3-none-any", needs: tuple[str, ...] = ()) -> None:
    """A package with one module, which says what it needs."""
    with zipfile.ZipFile(folder / f"{name}-2-{tag}.whl", "w") as wheel:
        about = ["Metadata-Version: 2.1", f"Name: {name}", "Version: 2", *(f"Requires-Dist: {need}" for need in needs)]
        wheel.writestr(f"{name}.py", "VALUE = 42")
        wheel.writestr(f"{name}-2.dist-info/METADATA", "\n".join(about) + "\n")
        wheel.writestr(f"{name}-2.dist-info/WHEEL", f"Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: {tag}\n")
        wheel.writestr(f"{name}-2.dist-info/RECORD", "")


@pytest.fixture
def index(script: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Path:
    """What stands for the package index: packages that need others on one system only, and binaries for some."""
    pytest.importorskip("uv")
    folder = script.ROOT / "index"
    folder.mkdir()
    wheel_of(folder, "needed", needs=("for_windows; sys_platform == 'win32'", "for_linux; sys_platform == 'linux'"))
    for name in ("for_windows", "for_linux", "server", "tables", "hatchling", "editables", "unasked"):
        wheel_of(folder, name)
    for python in ("cp311", "cp312"):
        for system in ("win_amd64", "manylinux2014_x86_64"):
            wheel_of(folder, "for_windows" if system == "win_amd64" else "binary", f"{python}-{python}-{system}")
    (script.ROOT / "backend.py").write_text(BACKEND)
    (script.ROOT / "pysim").mkdir()
    (script.ROOT / "pyproject.toml").write_text(
        PROJECT + 'dependencies = ["needed"]\noptional-dependencies = { app = ["server"] }\n[dependency-groups]\n'
        'bundle = []\ntest = ["tables", "binary; sys_platform == \'linux\'"]\n'
    )
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    (script.ROOT / "nothing").mkdir()
    monkeypatch.setenv("UV_DEFAULT_INDEX", (script.ROOT / "nothing").as_uri())
    monkeypatch.setenv("UV_OFFLINE", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(folder))
    monkeypatch.setenv("UV_FIND_LINKS", str(folder))
    monkeypatch.setattr(script, "PYTHON", Path(sys.executable))
    monkeypatch.setattr(script, "prepare", lambda groups: None)
    return folder


ALWAYS = {"needed-2-py3-none-any", "editables-2-py3-none-any", "tiny-1-py3-none-any"}


@pytest.mark.usefixtures("index")
@pytest.mark.parametrize(
    ("words", "only_there"),
    [
        (
            "app test --platform win_amd64 --python 3.12",
            {"server-2-py3-none-any", "for_windows-2-cp312-cp312-win_amd64"},
        ),
        (
            "test --platform linux_x86_64 --python 3.11",
            {"for_linux-2-py3-none-any", "binary-2-cp311-cp311-manylinux2014_x86_64"},
        ),
    ],
)
def test_a_bundle_for_another_system_holds_what_is_needed_there(
    script: ModuleType, words: str, only_there: set[str]
) -> None:
    script.WHEELS.mkdir()
    (script.WHEELS / "of-an-earlier-one.whl").write_text("")
    assert script.bundle(words.split()) == 0
    assert {file.stem for file in script.WHEELS.iterdir()} == ALWAYS | {"tables-2-py3-none-any"} | only_there


def test_a_bundle_that_cannot_be_whole_leaves_the_one_of_before(script: ModuleType, index: Path) -> None:
    script.WHEELS.mkdir()
    (script.WHEELS / "of-an-earlier-one.whl").write_text("")
    (index / "tables-2-py3-none-any.whl").unlink()
    with pytest.raises(SystemExit, match="not every package could be had for that system and Python"):
        script.bundle(["test", "--platform", "win_amd64", "--python", "3.12"])
    assert [file.name for file in script.WHEELS.iterdir()] == ["of-an-earlier-one.whl"]


def test_wheels_beside_it_come_first(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    script.WHEELS.mkdir()
    (script.ROOT / "pyproject.toml").write_text(WITH_GROUPS)
    asked: list[list[str]] = []
    monkeypatch.setattr(script, "pip", lambda words: asked.append(words) or 0)
    script.install({"app", "data", "test"})
    (words,) = asked
    assert words[0] == "install"
    assert "--no-index" in words
    assert words[words.index("--find-links") + 1] == str(script.WHEELS)
    assert words[words.index("--editable") + 1] == f"{script.ROOT}[app,data]"
    assert {"pytest>=8.0", "xdist"} <= set(words)  # no pip has to know dependency groups
    asked.clear()
    monkeypatch.setattr(script, "pip", lambda words: asked.append(words) or int("--no-index" in words))
    script.install(set())
    assert ["--no-index" in words for words in asked] == [True, False]
    assert "wheels/ does not hold every package" in capsys.readouterr().err


@pytest.mark.parametrize("works", [True, False])
def test_uv_installs_where_it_is_asked_for_and_pip_where_that_fails(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch, works: bool
) -> None:
    groups = '[dependency-groups]\ntest = ["pytest>=8.0"]\nbundle = ["uv>=0.5"]\n'
    (script.ROOT / "pyproject.toml").write_text('[project]\nname = "one"\n' + groups)
    asked: list[list[str]] = []

    def run(words: list[str]) -> subprocess.CompletedProcess[str]:
        asked.append(words[1:])
        return subprocess.CompletedProcess(words, int(not works))

    monkeypatch.setattr(script, "pip", lambda words: asked.append(["-m", "pip", *words]) or 0)
    monkeypatch.setattr(script.subprocess, "run", run)
    monkeypatch.setenv("HTB_INSTALLER", "uv")
    script.install({"test"})
    own = ["--editable", str(script.ROOT), "pytest>=8.0"]
    assert [words[1] for words in asked] == ["pip", "uv", *([] if works else ["pip"])]
    assert asked[0][-1] == "uv>=0.5"
    assert all(words[-3:] == own for words in asked[1:])


def test_windows_is_told_when_the_folder_lies_too_deep(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(script, "WINDOWS", True)
    monkeypatch.setattr(script, "ROOT", Path("C:/") / ("a" * 117))
    assert "has 120 characters, and above 95 some packages do not fit" in script.reason(no_index())
    monkeypatch.setattr(script, "ROOT", Path("C:/bench"))
    assert "is the package index reachable" in script.reason(no_index())


BACKEND = """
import os
import zipfile


def build_editable(folder, settings=None, metadata=None):
    name = "tiny-1-py3-none-any.whl"
    with zipfile.ZipFile(f"{folder}/{name}", "w") as wheel:
        wheel.writestr("tiny.pth", os.path.dirname(__file__))
        wheel.writestr("tiny-1.dist-info/METADATA", METADATA)
        wheel.writestr("tiny-1.dist-info/WHEEL", "Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n")
        wheel.writestr("tiny-1.dist-info/RECORD", "")
    return name


build_wheel = build_editable
METADATA = '''Metadata-Version: 2.1
Name: tiny
Version: 1
Provides-Extra: test
Provides-Extra: lint
Requires-Dist: needed
'''
"""
PROJECT = '[build-system]\nrequires = []\nbuild-backend = "backend"\nbackend-path = ["."]\n[project]\nname = "tiny"\n'
PROJECT += 'version = "1"\n'


@pytest.mark.slow
def test_a_machine_without_a_network_is_set_up_from_wheels(script: ModuleType) -> None:
    """With the true venv and pip, no index, and a project of two packages."""
    root = script.ROOT
    (root / "backend.py").write_text(BACKEND)
    (root / "pyproject.toml").write_text(PROJECT)
    (root / "pysim").mkdir()
    (root / "pysim" / "__init__.py").write_text("")
    environment = {**os.environ, "PIP_NO_INDEX": "1"}

    def python(code: str) -> subprocess.CompletedProcess[str]:
        words = [sys.executable, str(root / "run.py"), "python", "-c", code]
        return subprocess.run(words, capture_output=True, text=True, env=environment, cwd=root.parent)

    failed = python("pass")
    assert failed.returncode == 1
    assert "is the package index reachable? Without a network they can come from a folder wheels/" in failed.stderr
    script.WHEELS.mkdir()
    wheel_of(script.WHEELS, "needed")
    done = python("import needed; print(needed.VALUE)")
    assert (done.returncode, done.stdout.strip()) == (0, "42"), done.stderr
    (script.WHEELS / "needed-2-py3-none-any.whl").unlink()
    (root / "pyproject.toml").write_text(PROJECT + 'description = "another"\n')
    again = python("import needed; print(needed.VALUE)")
    assert (again.returncode, again.stdout.strip()) == (0, "42"), again.stderr
    assert "continuing with the previous environment" in again.stderr


def test_a_name_with_letters_that_the_console_lacks_stops_nothing(tmp_path: Path) -> None:
    (tmp_path / "run.py").write_text(SCRIPT.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "pyproject.toml").write_text(WITH_GROUPS)
    words = [sys.executable, str(tmp_path / "run.py"), "bundle", "x\N{GREEK SMALL LETTER PI}"]
    done = subprocess.run(words, capture_output=True, env={**os.environ, "PYTHONIOENCODING": "latin-1"})
    assert b"no extra and no dependency group x?" in done.stderr
