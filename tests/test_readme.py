"""What the README shows works as it stands."""

import re
from pathlib import Path

import fmu_build

README = Path(__file__).parents[1] / "README.md"


def test_python_example(capsys) -> None:
    pump = fmu_build.build("HydraulicTestBench.Pump.FreeGreyBox")
    code = re.search(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)[1]
    exec(code.replace("results/demo/FreeGreyBox.fmu", pump.as_posix()), {})
    angle = float(capsys.readouterr().out)
    assert 39 < angle < 41  # a P controller with a spring: close to the command of 40 percent, not on it


def test_links_lead_somewhere() -> None:
    for target in re.findall(r"\]\(([^)#:]+)\)", README.read_text(encoding="utf-8")):
        assert (README.parent / target).exists(), target
