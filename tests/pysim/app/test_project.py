"""A project is a folder: what was chosen comes back, and results belong to the data and the model they were made of."""

import os
from pathlib import Path

import pytest

from pysim.app.description import begin_logs, description_text, put_unit, put_use, read_description
from pysim.app.project import Project, Settings
from pysim.io import write_dataset, write_file
from pysim.types import BadInput
from tests.toy import NOISE, measured


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


def test_a_file_that_comes_back_as_it_was_is_the_same_whatever_its_date(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    file = project.models / "A.mo"
    file.parent.mkdir()
    seen = []
    for date, text in enumerate(("one", "two", "one")):
        file.write_text(text)
        os.utime(file, (date, date))
        seen.append(project.fingerprint())
    assert seen[0] == seen[2] != seen[1]


def test_a_library_that_is_dropped_again_keeps_what_was_added(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    project.use_model("A.B", ("model/A.mo",))
    project.change(added=("x",), free=("k",))
    project.use_model("A.B", ("model/A.mo",))
    assert (project.settings().added, project.settings().free) == (("x",), ("k",))
    project.use_model("A.C", ("model/A.mo",))
    assert (project.settings().added, project.settings().free) == ((), ())


def test_what_is_chosen_and_taken_back_leaves_the_fingerprint(tmp_path: Path) -> None:
    """The bytes need not be the same, nor the order: an answer is of what was asked."""
    project = Project.at(tmp_path / "p")
    project.change(free=("a", "b"), bounds=("a=1.0:2.0", "b=1.0:2.0"))
    write_dataset(project.data, measured(1))
    content = read_description(project.description)
    own, read = content["signals"]["x"], ["a.txt", "b.txt"]
    seen = [project.fingerprint()]
    for change in (
        lambda: begin_logs(content, "at rest"), lambda: begin_logs(content, "near rest"),
        lambda: put_use(content, read, 0, "test"), lambda: put_use(content, read, 0, "fit"),
        lambda: put_unit("x", own, "V", "m"), lambda: put_unit("x", own, "m", "V"),
        lambda: own.update(noise=0.5), lambda: own.update(noise=NOISE),
    ):  # fmt: skip
        change()
        write_file(project.description, description_text(content))
        seen.append(project.fingerprint())
    project.change(free=("b", "a"), bounds=("b=1.0:2.0", "a=1.0:2.0"))
    seen.append(project.fingerprint())
    assert {*seen[::2], seen[-1]} == {seen[0]}
    assert len({*seen}) == 1 + len(seen[1:-1:2])


def test_a_description_that_cannot_be_read_has_a_fingerprint_too(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    project.data.mkdir()
    seen = set()
    for text in ("[dataset", "signals = 3", "records = 3\n[signals]", "\0"):
        write_file(project.description, text)
        seen.add(project.fingerprint())
    assert len(seen) == 4


@pytest.mark.parametrize("place", ["Pump.fmu", "../elsewhere/Pump.fmu", "absolute"])
def test_the_fingerprint_tells_an_fmu_that_was_exported_anew_wherever_it_is(tmp_path: Path, place: str) -> None:
    project = Project.at(tmp_path / "p")
    name = str(tmp_path / "elsewhere/Pump.fmu") if place == "absolute" else place
    (tmp_path / "elsewhere").mkdir()
    project.change(model=name)
    seen = [project.fingerprint()]
    for text, time in (("first", 1), ("other", 2), ("longer", 2)):
        (project.folder / name).write_text(text)
        os.utime(project.folder / name, ns=(time, time))
        seen.append(project.fingerprint())
    assert len(set(seen)) == 4
    assert project.fingerprint() == seen[-1]


@pytest.mark.parametrize("file", ["Lib/Sub/A.mo", "Lib/Resources/table.txt", "One.mo"])
def test_the_fingerprint_tells_a_library_that_was_changed_wherever_it_is(tmp_path: Path, file: str) -> None:
    project = Project.at(tmp_path / "p")
    changed = tmp_path / "elsewhere" / file
    changed.parent.mkdir(parents=True)
    project.change(libraries=(str(tmp_path / "elsewhere/Lib"), "../elsewhere/One.mo"))
    seen = [project.fingerprint()]
    for text in ("", "1", "12"):
        changed.write_text(text)
        seen.append(project.fingerprint())
    assert len(set(seen)) == 4
    (tmp_path / "elsewhere/Lib/.git").mkdir(parents=True)
    (tmp_path / "elsewhere/Lib/.git/index").write_text("what looking at it writes")
    assert project.fingerprint() == seen[-1]


@pytest.mark.parametrize("library", [".", ".."])
def test_what_the_workbench_writes_is_no_part_of_a_library_that_the_project_lies_in(
    tmp_path: Path, library: str
) -> None:
    project = Project.at(tmp_path / "p")
    project.change(libraries=(library,))
    (project.folder / library / "package.mo").write_text("package P end P;")
    before = project.fingerprint()
    for place in ("results/compare/job.json", "uploads/x/a.csv", "earlier/data-1/a.csv", "server.lock"):
        (project.folder / place).parent.mkdir(parents=True, exist_ok=True)
        (project.folder / place).write_text("x")
    project.change(look="dark")
    assert project.fingerprint() == before
    (project.folder / library / "package.mo").write_text("package P extends Q; end P;")
    assert project.fingerprint() != before


@pytest.mark.parametrize("name", ["A" * 5000, "A.B\0", "data"])
def test_a_model_that_is_no_file_has_a_fingerprint_too(tmp_path: Path, name: str) -> None:
    project = Project.at(tmp_path / "p")
    project.data.mkdir()
    before = project.fingerprint()
    project.change(model=name)
    assert project.fingerprint() not in ("", before)


def dropped(folder: Path, text: str, name: str = "a.txt") -> Path:
    """A folder with one file."""
    (folder / text).mkdir()
    (folder / text / name).write_text(text)
    return folder / text


def test_earlier_data_are_kept_whatever_was_removed_of_them(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    kept = [project.replace_data(dropped(tmp_path, text)) for text in ("first", "second", "third")]
    assert kept == ["", "earlier/data-1", "earlier/data-2"]
    assert (project.folder / "earlier/data-1/a.txt").read_text() == "first"
    (project.folder / "earlier/data-1/a.txt").unlink()
    (project.folder / "earlier/data-1").rmdir()
    assert project.replace_data(dropped(tmp_path, "fourth")) == "earlier/data-3"
    assert (project.data / "a.txt").read_text() == "fourth"
    assert (project.folder / "earlier/data-2/a.txt").read_text() == "second"
    assert (project.folder / "earlier/data-3/a.txt").read_text() == "third"


def test_earlier_models_are_kept_with_their_names(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    assert project.replace_models([dropped(tmp_path, "first", "A.mo") / "A.mo"]) == ""
    assert project.replace_models([dropped(tmp_path, "other", "B.mo") / "B.mo"]) == ""
    assert project.replace_models([dropped(tmp_path, "second", "A.mo") / "A.mo"]) == "earlier/model-1"
    assert project.replace_models([dropped(tmp_path, "third", "A.mo") / "A.mo"]) == "earlier/model-2"
    assert {path.name: path.read_text() for path in project.models.iterdir()} == {"A.mo": "third", "B.mo": "other"}
    assert (project.folder / "earlier/model-1/A.mo").read_text() == "first"
    assert (project.folder / "earlier/model-2/A.mo").read_text() == "second"


@pytest.mark.parametrize("what", ["data", "model"])
def test_what_was_there_is_replaced_whole_or_not_at_all(tmp_path: Path, what: str) -> None:
    project = Project.at(tmp_path / "p")
    project.replace_data(dropped(tmp_path, "first"))
    project.replace_models([dropped(tmp_path, name, f"{name}.mo") / f"{name}.mo" for name in ("A", "B")])
    before = {path: path.read_text() for path in project.folder.rglob("*") if path.is_file()}
    coming = dropped(tmp_path, "second", "B.mo")
    replace = {
        "data": lambda: project.replace_data(tmp_path / "gone"),
        "model": lambda: project.replace_models([coming / "B.mo", coming / "A.mo"]),
    }[what]
    with pytest.raises(BadInput, match="No such file"):
        replace()
    assert {path: path.read_text() for path in project.folder.rglob("*") if path.is_file()} == before
    assert [path.name for path in coming.iterdir()] == ["B.mo"]
    (coming / "A.mo").write_text("second")
    if what == "data":
        coming.rename(tmp_path / "gone")
    assert replace() in ("earlier/data-1", "earlier/model-1")


def test_an_fmu_below_model_may_be_named_without_its_folder(tmp_path: Path) -> None:
    project = Project.at(tmp_path / "p")
    (project.models / "sub").mkdir(parents=True)
    for name in ("Pump.fmu", "sub/Other.FMU", "both.fmu"):
        (project.models / name).write_text("")
    (project.folder / "both.fmu").write_text("")
    written = [" Pump.fmu ", "model/Pump.fmu", "sub/Other.FMU", "both.fmu", "gone.fmu", "Lib.Pump", ""]
    found = ["model/Pump.fmu", "model/Pump.fmu", "model/sub/Other.FMU", "both.fmu", "gone.fmu", "Lib.Pump", ""]
    assert [project.model_name(name) for name in written] == found
