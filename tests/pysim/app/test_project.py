"""A project is a folder: what was chosen comes back, and results belong to the data and the model they were made of."""

from pathlib import Path

import pytest

from pysim.app.project import Project, Settings
from pysim.types import BadInput


def test_settings_come_back_and_a_broken_file_is_said(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "new")
    chosen = Settings("A.B", ("model/Lib",), ("m", "k"), ('odd "name"',), "dark")
    project.save(chosen)
    assert Project.at(tmp_path / "new").settings() == chosen
    (tmp_path / "new/project.toml").write_text("model = 3\n")
    with pytest.raises(BadInput, match="model is 3; correct it"):
        project.settings()


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text("dear")
    with pytest.raises(BadInput, match=r"holds files but no project.toml"):
        Project.at(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_the_fingerprint_tells_other_data_and_another_model(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    seen = [project.fingerprint()]
    project.change(model="A.B")
    seen.append(project.fingerprint())
    (project.data / "sub").mkdir(parents=True)
    (project.data / "sub/a.txt").write_text("1")
    seen.append(project.fingerprint())
    (project.data / "sub/a.txt").write_text("12")
    seen.append(project.fingerprint())
    assert len(set(seen)) == 4
    project.change(added=("x",), look="dark")  # neither changes what is compared
    assert project.fingerprint() == seen[-1]


def test_earlier_data_are_kept(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    for text in ("first", "second"):
        (tmp_path / text).mkdir()
        (tmp_path / text / "a.txt").write_text(text)
        project.replace_data(tmp_path / text)
    assert (project.data / "a.txt").read_text() == "second"
    assert (project.folder / "earlier/data-1/a.txt").read_text() == "first"
