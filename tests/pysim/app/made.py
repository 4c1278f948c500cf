"""Projects of one mass that moves on a spring, for the tests of the workbench."""

from pathlib import Path

from pysim.app.project import Project, Settings
from pysim.io import write_dataset
from tests.toy import TEXT, measured


def description(file: str) -> str:
    """dataset.toml of one log of the mass, by hand."""
    return f"""
[dataset]
name = "toy"
[signals.F]
role = "input"
unit = "N"
[signals.x]
role = "output"
unit = "m"
[[records]]
file = "{file}"
columns = ["time", "F", "x"]
kind = "other"
"""


def rubbing(folder: Path, F_c: float = 0.4) -> Project:
    """A mass that rubs, whose model does not."""
    one = Project.at(folder)
    write_dataset(one.data, measured(1, "toy.friction", F_c=F_c))
    one.models.mkdir()
    (one.models / "Toy.mo").write_text(TEXT)
    one.save(Settings(model="Toy.Mass", libraries=("model/Toy.mo",)))
    return one
