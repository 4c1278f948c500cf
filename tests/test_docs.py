"""What the pages in docs/ show works as it stands: their Python runs, their command lines parse, their links lead
somewhere. A block that begins with ```sh run is executed, one with file=NAME behind its language is written there. A
comment `files: PATTERN` names what lies beside the page and is copied. A block ```python script is run where its files
are, by tests/pysim/nouns/test_scripts.py. A block ```python given has a model, logs and a fit."""

import re
import shlex
import shutil
import sys
import traceback
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import pysim
from pysim.cli.main import argument_parser
from tests.pysim.nouns.script_files import with_drag

ROOT = Path(__file__).parents[1]
PAGES = sorted((ROOT / "docs").glob("**/*.md"))
CELL = "{code-cell} python"
RUNNER = ("python3", "run.py")


def blocks(text: str) -> Iterator[tuple[str, int, str]]:
    """Every fenced block: the words behind its fence, language first, the line its content starts at, the content."""
    for match in re.finditer(r"^```([^\n`]*)\n(.*?)^```[ \t]*$", text, re.DOTALL | re.MULTILINE):
        yield match[1].strip(), text.count("\n", 0, match.start()) + 2, match[2]


def run_page(page: Path) -> None:
    """Do what the page does, block by block: write its files, run its commands, and its Python in one namespace.

    Raises:
        AssertionError: something failed; names the page and the line.
    """
    namespace: dict[str, object] = {"__name__": "__main__"}
    text = page.read_text(encoding="utf-8")
    for pattern in re.findall(r"<!-- files: (\S+) -->", text):
        for beside in page.parent.glob(pattern):
            (shutil.copytree if beside.is_dir() else shutil.copy)(beside, beside.name)
    for words, line, source in blocks(text):
        file = re.search(r"\bfile=(\S+)", words)
        if file:
            Path(file[1]).parent.mkdir(parents=True, exist_ok=True)
            Path(file[1]).write_text(source, encoding="utf-8")
        if words == "sh run":
            for at, command in commands(source, line):
                code = execute(command)
                assert code == 0, f"{page.name}, line {at}: {shlex.join(command)} ends with {code}"
        if words not in ("python", CELL):
            continue
        padded = "\n" * (line - 1) + source  # so that tracebacks count the page's lines
        try:
            exec(compile(padded, str(page), "exec"), namespace)
        except Exception as error:
            inside = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(page)]
            at = inside[-1] if inside else getattr(error, "lineno", line)
            raise AssertionError(f"{page.name}, line {at}: {type(error).__name__}: {error}") from error


def command_lines(text: str) -> Iterator[tuple[int, list[str]]]:
    """Every command of ours in a shell block or one without language: its line and its words."""
    for language, first, content in blocks(text):
        if language in ("", "sh", "sh run", "console"):
            yield from commands(content, first)


def commands(content: str, first: int) -> Iterator[tuple[int, list[str]]]:
    """Every command of ours in a block that starts at line `first`: its line and its words."""
    for match in re.finditer(r"(?:\\\n|[^\n])+", content):  # a line goes on behind a backslash
        words = match[0].replace("\\\n", " ").removeprefix("$ ").strip()
        if words.startswith(("pysim ", "fmu-build ", "python3 run.py ")):
            yield first + content.count("\n", 0, match.start()), shlex.split(words, comments=True)


def execute(words: list[str]) -> int:
    """The exit status of a command of ours, run in this process."""
    main = {"pysim": "pysim.cli", "fmu-build": "fmu_build.cli"}[words[0]]
    return int(import_module(main).main(words[1:]))


def parse(words: list[str]) -> None:
    """Let the command's own parser read the words.

    Raises:
        AssertionError: a command that is not there. SystemExit: words that its parser refuses.
    """
    if tuple(words[:2]) == RUNNER:
        run = import_module("run")
        if words[2] == "bundle":
            run.for_bundle(words[3:])
            return
        assert words[2] in run.COMMANDS | run.CHECKS, f"run.py has no command {words[2]}"
        words = {"demo": ["pysim", "demo"]}.get(words[2], [words[2]]) + words[3:]
    if words[0] == "validate":
        words = ["pysim", *words]
    if words[0] == "pysim":
        parsed = argument_parser().parse_args(words[1:])
        if words[1] == "validate":
            unknown = {name for name, _ in parsed.names or ()} - set(import_module("validation.registry").CASES)
            assert not unknown, f"there is no case {sorted(unknown)}"
    elif words[0] == "fmu-build":
        import_module("fmu_build.cli")._parser().parse_args(words[1:])


def anchors(text: str) -> set[str]:
    """What a link to a heading of the page can name."""
    heads = re.findall(r"^#+ +(.+?) *$", re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def links(page: Path) -> list[str]:
    """Targets of the page's links, but for those to the web."""
    found = re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8"))
    return [link for link in found if not re.match(r"[a-z]+:", link)]


def dead_links(page: Path) -> list[str]:
    """Links to files or headings that are not there."""
    dead = []
    for link in links(page):
        name, _, anchor = link.partition("#")
        target = page.parent / name if name else page
        if not target.exists() or (anchor and anchor not in anchors(target.read_text(encoding="utf-8"))):
            dead.append(link)
    return dead


def page_name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def pages_to_run() -> list[Any]:
    """Those that fit and diagnose take their time, and run where slow tests are asked for; the site's build executes
    the notebooks of the gallery."""
    long = ("missing_effect.md", "own_model.md", "unknown_law.md")
    pages = [page for page in PAGES if page.parent.name != "gallery"]
    return [pytest.param(page, marks=[pytest.mark.slow] * (page.name in long)) for page in pages]


@pytest.mark.parametrize("page", pages_to_run(), ids=page_name)
def test_what_it_shows_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run_page(page)


@pytest.mark.parametrize("page", [ROOT / "README.md", *PAGES], ids=page_name)
def test_command_lines_parse(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for line, words in command_lines(page.read_text(encoding="utf-8")):
        try:
            parse(words)
        except (SystemExit, AssertionError) as error:
            pytest.fail(f"{page.name}, line {line}: {shlex.join(words)}: {error} {capsys.readouterr().err}")


@pytest.mark.parametrize("page", [ROOT / "README.md", *PAGES], ids=page_name)
def test_links_lead_somewhere(page: Path) -> None:
    assert dead_links(page) == []


def test_every_page_is_reached_from_the_readme() -> None:
    found, to_read = set(), {ROOT / "README.md"}
    while to_read:
        page = to_read.pop()
        found.add(page)
        names = {link.partition("#")[0] for link in links(page)} - {""}
        targets = {(page.parent / name).resolve() for name in names}
        to_read |= {t for t in targets if t.suffix == ".md" and t.exists()} - found
    assert [page.name for page in PAGES if page not in found] == []


@pytest.mark.slow
def test_what_is_shown_of_a_fit_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every block of ```python given, with an axis that lacks a drag."""
    monkeypatch.chdir(tmp_path)
    with_drag(tmp_path)
    data = pysim.load("logs/*.csv", inputs="F", outputs="x").hold_out("run3")
    model = pysim.model("MyLib.Axis", library="MyLib")
    fitted = pysim.fit(model, data)
    ran = 0
    for page in PAGES:
        for words, line, source in blocks(page.read_text(encoding="utf-8")):
            if words == "python given":
                names = {"pysim": pysim, "model": model, "data": data, "fitted": fitted}
                exec(compile("\n" * (line - 1) + source, str(page), "exec"), names)
                ran += 1
    assert ran >= 4


def test_the_limits_on_the_page_are_those_that_judge() -> None:
    page = (ROOT / "docs" / "explanation" / "comparison.md").read_text(encoding="utf-8")
    section = page[page.index("## The limits") :]
    rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in re.findall(r"^\|.*\|$", section, re.M)[2:5]]
    accuracy = import_module("pysim.identify.accuracy")
    criteria = [*accuracy.FREQUENCY_CRITERIA, *accuracy.TIME_CRITERIA]
    limits = [(f"{c.limit:g} {c.unit}", c.source) for c in criteria]
    assert [(row[k], row[3]) for row in rows for k in (1, 2)] == limits


@pytest.mark.parametrize(
    ("page", "words"),
    [
        ("explanation/cosimulation.md", ("An FMU is native code", "Open what you trust", "--isolate")),
        ("reference/fmu_checks.md", ("An FMU is native code",)),
        ("tutorials/workbench.md", ("--host",)),
        (
            "how-to/other_programs.md",
            ("output intervals of at most 1 ms", "500 steps per output interval"),
        ),
    ],
)
def test_a_reader_is_warned(page: str, words: tuple[str, ...]) -> None:
    """Of code that an FMU runs, of what an open port means, and of what an importer does to inputs."""
    text = " ".join((ROOT / "docs" / page).read_text(encoding="utf-8").split())
    assert [word for word in words if word not in text] == []


@pytest.mark.parametrize("page", [ROOT / "README.md", *PAGES], ids=page_name)
def test_commands_can_be_typed_into_any_shell(page: Path) -> None:
    """The consoles of Windows know no line that goes on behind a backslash."""
    for language, line, content in blocks(page.read_text(encoding="utf-8")):
        if language in ("", "sh", "sh run", "console"):
            assert not re.search(r"\\$", content, re.MULTILINE), f"{page.name}, block at line {line}"


PAGE = """# A page: of mine

Words `pysim nonsense`.

```python
a = 1
```

```python
assert a == 1
assert a == 2, "not two"
```

```sh
pysim simulate a.fmu \\
  --nonsense
pysim simulate a.fmu --set tau=1 --output b.csv   # a remark
```

```toml file=in/a.toml
b = 2
```

```sh run
pysim simulate nothing.fmu
```

[here](#a-page-of-mine) [there](other.md) [web](https://example.org) [gone](#nowhere)
"""


def test_the_guard_sees_what_it_is_to_see(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    page = tmp_path / "page.md"
    page.write_text(PAGE, encoding="utf-8")
    with pytest.raises(AssertionError, match=r"page.md, line 11: AssertionError: not two"):
        run_page(page)
    page.write_text(PAGE.replace("a = 1", "a = = 1"), encoding="utf-8")
    with pytest.raises(AssertionError, match=r"page.md, line 6: SyntaxError"):
        run_page(page)
    page.write_text(PAGE.replace('assert a == 2, "not two"', ""), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError, match=r"page.md, line 25: pysim simulate nothing.fmu ends with 2"):
        run_page(page)
    assert Path("in/a.toml").read_text() == "b = 2\n"
    (first, bad), (second, good), _ = command_lines(PAGE)
    assert (first, bad[-1], second, good[-1]) == (15, "--nonsense", 17, "b.csv")
    with pytest.raises(SystemExit):
        parse(bad)
    parse(good)
    with pytest.raises(AssertionError, match="no command nonsense"):
        parse([*RUNNER, "nonsense"])
    assert dead_links(page) == ["other.md", "#nowhere"]
    assert "--nonsense" in capsys.readouterr().err
    assert "pysim.cli.main" in sys.modules
