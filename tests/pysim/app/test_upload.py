"""Drops: what they become, and what never leaves or fills the project's folder."""

import asyncio
import io
import re
import zipfile
from collections.abc import AsyncIterator, Sequence
from pathlib import Path

import pytest

from pysim.app.project import Project
from pysim.app.upload import Batch, Limits, adopt, replaces
from pysim.types import BadInput

SENT = b"0,1\n0,1\n"
TOML = '[dataset]\nname = "a"\n'


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project.at(tmp_path / "project")


def batch(project: Project, files: dict[str, bytes], limits: Limits = Limits()) -> Batch:  # noqa: B008 - frozen
    """A drop that has come in."""
    found = Batch(project.folder / "uploads", limits)
    (found.folder / found.name).mkdir(parents=True)

    async def pieces(data: bytes) -> AsyncIterator[bytes]:
        for k in range(0, len(data), 7):
            yield data[k : k + 7]

    for name, data in files.items():
        asyncio.run(found.take(name, pieces(data), size=len(data)))
    return found


def packed(files: dict[str, bytes]) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return data.getvalue()


@pytest.mark.parametrize(
    ("came", "why"),
    [
        (b"0,1\n0,", r"d/a.csv did not arrive whole \(6 bytes where 8 were announced\); drop it again"),
        (b"0,1\n0,1\n0", r"d/a.csv did not arrive whole \(9 bytes where 8 were announced\); drop it again"),
        (None, "the connection broke"),
    ],
)
def test_of_a_file_that_does_not_arrive_as_it_was_sent_nothing_stays(
    project: Project, came: bytes | None, why: str
) -> None:
    coming = batch(project, {"d/b.csv": b"0,1\n"})

    async def pieces() -> AsyncIterator[bytes]:
        if came is None:
            yield SENT[:3]
            raise ConnectionError("the connection broke")
        yield came

    with pytest.raises((BadInput, ConnectionError), match=why):
        asyncio.run(coming.take("d/a.csv", pieces(), size=len(SENT)))
    assert coming.whole == 1
    assert [path.name for path in (coming.folder / coming.name).rglob("*")] == ["d", "b.csv"]


@pytest.mark.parametrize("as_zip", [False, True])
def test_a_data_set_is_taken_over_with_its_folders(project: Project, as_zip: bool) -> None:
    files = {"bench/dataset.toml": TOML.encode(), "bench/logs/a.txt": b"0 1\n", "__MACOSX/dataset.toml": b"?"}
    if as_zip:
        files = {"bench.zip": packed(files)}
    assert adopt(batch(project, files), project).kind == "dataset"
    assert (project.data / "logs/a.txt").read_bytes() == b"0 1\n"
    assert list((project.folder / "uploads").iterdir()) == []


@pytest.mark.parametrize(
    ("beside", "libraries"), [((), ()), (("Lib/package.mo", "Lib/b.csv", "a.txt"), ("model/Lib",))]
)
def test_bare_logs_wait_for_their_description(
    project: Project, beside: Sequence[str], libraries: Sequence[str]
) -> None:
    files = dict.fromkeys([f"logs/{one}" for one in ("a.csv", "b.csv", *beside)], b"0,1\n")
    adopted = adopt(batch(project, files), project)
    assert (adopted.kind, adopted.libraries) == ("logs", libraries)
    assert f"{3 if beside else 2} logs without a dataset.toml" in adopted.text
    assert (project.data / "a.csv").is_file()


@pytest.mark.parametrize("as_zip", [False, True])
def test_what_a_system_leaves_beside_logs_is_taken_for_nobody_s(project: Project, as_zip: bool) -> None:
    files = {"logs/a.csv": b"0,1\n", "logs/.DS_Store": b"?", "__MACOSX/logs/._a.csv": b"?", ".git/x/b.csv": b"?"}
    if as_zip:
        files = {"logs.zip": packed({**files, "__MACOSX/._a/b|c.csv": b""}), "._logs.zip": b"of another disk"}
    assert adopt(batch(project, files), project).text.startswith("1 log without")
    assert [path.relative_to(project.data).as_posix() for path in project.data.rglob("*")] == ["a.csv"]


@pytest.mark.parametrize("place", ["", "Lib/"])
def test_a_library_and_an_fmu_become_the_model(project: Project, place: str) -> None:
    files = {"Lib/package.mo": b"package Lib end Lib;", "Lib/Sub/package.mo": b"", f"{place}pump.fmu": b"PK"}
    adopted = adopt(batch(project, files), project)
    assert (adopted.kind, adopted.model, adopted.libraries) == ("model", "model/pump.fmu", ("model/Lib",))
    assert (project.models / "Lib/Sub/package.mo").is_file()


def test_a_model_dropped_again_keeps_the_one_before_and_says_where(project: Project) -> None:
    for text in (b"model A end A;", b"model A Real x; end A;"):
        adopted = adopt(batch(project, {"A.mo": text, "Lib/package.mo": text}), project)
    assert adopted.text == "taken over: Lib, A.mo; what was there before is in earlier/model-1"
    assert (project.models / "A.mo").read_bytes() == b"model A Real x; end A;"
    assert (project.folder / "earlier/model-1/A.mo").read_bytes() == b"model A end A;"
    assert (project.folder / "earlier/model-1/Lib/package.mo").read_bytes() == b"model A end A;"
    for text in (b"0 1\n", b"0 2\n"):
        adopted = adopt(batch(project, {"a.csv": text}), project)
    assert adopted.text.endswith("; what was there before is in earlier/data-1")


@pytest.mark.parametrize(
    "name", ["../a.txt", "/etc/a.txt", "x/../../a.txt", "C:\\a.txt", "..\\a.txt", "", "a\0b", "a\nb"]
)
def test_no_name_leaves_the_folder(project: Project, name: str) -> None:
    with pytest.raises(BadInput, match="is no name of a file below the dropped folder"):
        batch(project, {name: b""})
    if name:
        inside = batch(project, {"a.zip": packed({name.replace("\0", "\x01"): b"x"})})
        with pytest.raises(BadInput, match="below the dropped folder"):
            adopt(inside, project)
    assert not (project.folder.parent / "a.txt").exists()


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("logs/2024-01-01 12:30.csv", "Windows has no file names with :"),
        ('a"b?.csv', 'Windows has no file names with " ?'),
        ("run./a.csv", "Windows drops the end of 'run.'"),
        ("a.csv ", "Windows drops the end of 'a.csv '"),
        ("nul.csv", "'nul.csv' is a device on Windows"),
        ("COM1/a.csv", "'COM1' is a device on Windows"),
    ],
)
def test_a_name_that_windows_does_not_take_is_refused_everywhere(project: Project, name: str, why: str) -> None:
    message = re.escape(f"{name!r}: {why}; rename it")
    with pytest.raises(BadInput, match=message):
        batch(project, {name: b"0,1\n"})
    with pytest.raises(BadInput, match=message):
        adopt(batch(project, {"a.zip": packed({name: b"0,1\n"})}), project)
    assert not project.data.exists()


def test_names_that_every_system_keeps_are_taken(project: Project) -> None:
    names = ("console.csv", "com10.csv", "Größe (2), 50 % + 1.csv", "a..b.csv")
    adopt(batch(project, dict.fromkeys(names, b"0,1\n")), project)
    assert sorted(path.name for path in project.data.iterdir()) == sorted(names)


@pytest.mark.parametrize("letter", ["a", "д", "漢"])
@pytest.mark.parametrize("place", ["{}.csv", "{}/a.csv"])
def test_a_name_that_is_too_long_for_a_disk_is_refused_whatever_its_letters(
    project: Project, letter: str, place: str
) -> None:
    longest = (200 if letter == "a" else 254 // len(letter.encode())) - len(".csv")
    kept, refused = (place.format(letter * count) for count in (longest, longest + 6))
    assert adopt(batch(project, {kept: b"0,1\n"}), project).kind == "logs"
    words = f"^{re.escape(repr(refused[:80]))} is no name of a file below the dropped folder; rename it$"
    with pytest.raises(BadInput, match=words):
        batch(project, {refused: b"0,1\n"})
    with pytest.raises(BadInput, match=words):
        adopt(batch(project, {"a.zip": packed({refused: b"0,1\n"})}), project)


def test_limits_hold_for_what_comes_in_and_for_what_is_unpacked(project: Project) -> None:
    small = Limits(size=1000, files=3)
    with pytest.raises(BadInput, match="goes beyond the limit"):
        batch(project, {"a.txt": b"x" * 1001}, small)
    with pytest.raises(BadInput, match="more than 3 files"):
        batch(project, {f"{k}.txt": b"" for k in range(4)}, small)
    bomb = batch(project, {"a.zip": packed({"zeros.txt": bytes(10**6)})}, Limits(size=5000))
    with pytest.raises(BadInput, match=r"zeros.txt goes beyond the limit"):
        adopt(bomb, project)
    assert not project.data.exists()


def test_a_description_cannot_name_files_elsewhere(project: Project) -> None:
    toml = TOML + '[[records]]\nfile = "../../project.toml"\n'
    with pytest.raises(BadInput, match=r"'../../project.toml' lies outside the data set"):
        adopt(batch(project, {"d/dataset.toml": toml.encode()}), project)


@pytest.mark.parametrize(
    ("files", "message"),
    [
        ({"a.jpg": b"x"}, r"no data set, no logs and no model in this: .jpg"),
        ({"a/dataset.toml": b"", "b/dataset.toml": b""}, r"2 files dataset.toml in this"),
        ({"a.fmu": b"", "b.fmu": b""}, "2 FMUs in this"),
        ({"x/A.mo": b"", "y/a.mo": b""}, r"more than one A.mo in this"),
        ({"a.zip": b"no zip"}, r"a.zip cannot be unpacked"),
    ],
)
def test_what_is_no_use_is_refused_with_a_remedy(project: Project, files: dict[str, bytes], message: str) -> None:
    with pytest.raises(BadInput, match=message):
        adopt(batch(project, files), project)


def test_a_link_in_an_archive_is_no_link_any_more(project: Project) -> None:
    (project.folder.parent / "secret.txt").write_text("0 1\n")
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        link = zipfile.ZipInfo("logs/a.txt")
        link.external_attr = 0o120777 << 16  # a symbolic link, as Unix packs it
        archive.writestr(link, "../../../secret.txt")
    adopt(batch(project, {"a.zip": data.getvalue()}), project)
    assert not (project.data / "a.txt").is_symlink()
    assert (project.data / "a.txt").read_text() == "../../../secret.txt"


def test_a_name_that_is_a_folder_too_is_refused_in_a_sentence(project: Project) -> None:
    inside = batch(project, {"a.zip": packed({"x/b.txt": b"0 1\n", "x": b"0 1\n"})})
    with pytest.raises(BadInput, match=r"a.zip cannot be unpacked: .*; pack it again"):
        adopt(inside, project)
    assert not project.data.exists()
    assert list((project.folder / "uploads").iterdir()) == []


@pytest.mark.parametrize(
    ("files", "pair"),
    [
        ({"A.zip": {"0.5Hz.txt": b"0 1\n"}, "B.zip": {"0.5Hz.txt": b"0 2\n"}}, "0.5Hz.txt and 0.5Hz.txt"),
        ({"A.zip": {"dataset.toml": TOML.encode()}, "B.zip": {"dataset.toml": b"?"}}, "dataset.toml and dataset.toml"),
        ({"x/A.zip": {"s/a.csv": b"0,1\n"}, "x/s/a.csv": b"0,2\n"}, "x/s/a.csv and x/s/a.csv"),
        ({"A.zip": {"a.csv": b"0,1\n", "A.CSV": b"0,2\n"}}, "A.CSV and a.csv"),
        ({"A.zip": {"B.zip": b"?"}, "B.zip": {"a.csv": b"0,1\n"}}, "B.zip and B.zip"),
        ({"A.zip": {"A.zip": b"?"}}, "A.zip and A.zip"),
        ({"Größe.csv": b"0,1\n", "gro\u0308ße.csv": b"0,2\n"}, "gro\u0308ße.csv and Größe.csv"),
        ({"a/b.csv": b"0,1\n", "a\\.\\b.csv": b"0,2\n"}, "a/b.csv and a/b.csv"),
    ],
)
def test_no_file_of_a_drop_takes_the_place_of_another(
    project: Project, files: dict[str, bytes | dict[str, bytes]], pair: str
) -> None:
    adopt(batch(project, {"before.csv": b"0,1\n"}), project)
    coming = {name: packed(own) if isinstance(own, dict) else own for name, own in files.items()}
    with pytest.raises(
        BadInput, match=f"^{re.escape(pair)} would be one file; rename one of them, or drop one at a time$"
    ):
        adopt(batch(project, coming), project)
    assert [path.name for path in project.data.iterdir()] == ["before.csv"]


def test_archives_that_share_no_name_and_the_pieces_of_a_file_are_taken(project: Project) -> None:
    logs = {f"{k}/{name}.csv": b"0,1\n" * 50 for k, name in ((1, "a"), (2, "a"), (2, "b"))}  # each in many pieces
    archives = {f"{k}.zip": packed({n: b for n, b in logs.items() if n[0] == str(k)}) for k in (1, 2)}
    adopt(batch(project, {**archives, "a.csv": b"0,1\n"}), project)
    found = {path.relative_to(project.data).as_posix(): path.read_bytes() for path in project.data.rglob("*.csv")}
    assert found == {**logs, "a.csv": b"0,1\n"}


def test_a_log_that_comes_later_lies_beside_those_that_are_there(project: Project) -> None:
    adopt(batch(project, {"a.csv": b"0,1\n", "b.csv": b"0,1\n"}), project)
    adopted = adopt(batch(project, {"b.csv": b"0,2\n"}), project)
    assert adopted.text == "1 log more; what was there before is in earlier/data-1"
    assert {path.name: path.read_bytes() for path in project.data.iterdir()} == {"a.csv": b"0,1\n", "b.csv": b"0,2\n"}
    assert (project.folder / "earlier/data-1/b.csv").read_bytes() == b"0,1\n"
    assert list(project.uploads.iterdir()) == []
    project.replace_data(None)
    assert not project.data.exists()
    assert adopt(batch(project, {"c.csv": b"0,1\n"}), project).text.startswith("1 log without")


@pytest.mark.parametrize("as_zip", [False, True])
def test_only_a_data_set_takes_the_place_of_another(project: Project, as_zip: bool) -> None:
    described = {"bench/dataset.toml": TOML.encode(), "bench/a.txt": b"0 1\n"}
    files = {"bench.zip": packed(described)} if as_zip else described
    assert not replaces(batch(project, files), project)  # nothing is there
    adopt(batch(project, described), project)
    again = batch(project, files)
    assert replaces(again, project)
    assert adopt(again, project).kind == "dataset"
    assert not replaces(batch(project, {"b.txt": b"0 1\n", "__MACOSX/dataset.toml": b"?"}), project)  # logs are added
