"""What the README shows works as it stands."""

import re
from pathlib import Path

README = Path(__file__).parents[1] / "README.md"


def python_blocks(page: Path) -> list[str]:
    return re.findall(r"```python(?: script)?\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def test_the_first_lines_are_those_of_the_quick_start_which_is_run() -> None:
    quick_start = python_blocks(README.parent / "docs" / "tutorials" / "first_minutes.md")[0].splitlines()
    assert set(python_blocks(README)[0].splitlines()) <= {line.partition("#")[0].rstrip() for line in quick_start}


def test_links_lead_somewhere() -> None:
    for target in re.findall(r"\]\(([^)#:]+)\)", README.read_text(encoding="utf-8")):
        assert (README.parent / target).exists(), target
