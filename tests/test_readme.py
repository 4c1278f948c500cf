"""What the README shows works as it stands."""

import re
from pathlib import Path

import fmu_build

README = Path(__file__).parents[1] / "README.md"


def python_blocks(page: Path) -> list[str]:
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def test_the_first_lines_are_those_of_the_quick_start_which_is_run() -> None:
    quick_start = python_blocks(README.parent / "docs" / "python.md")[0].splitlines()
    assert set(python_blocks(README)[0].splitlines()) <= {line.partition("#")[0].rstrip() for line in quick_start}


def test_python_example(capsys) -> None:
    pump = fmu_build.build("HydraulicTestBench.Pump.FreeGreyBox")
    code = python_blocks(README)[1]
    exec(code.replace("results/demo/FreeGreyBox.fmu", pump.as_posix()), {})
    angle = float(capsys.readouterr().out)
    assert 39 < angle < 41  # a P controller with a spring: close to the command of 40 percent, not on it


def test_links_lead_somewhere() -> None:
    for target in re.findall(r"\]\(([^)#:]+)\)", README.read_text(encoding="utf-8")):
        assert (README.parent / target).exists(), target
