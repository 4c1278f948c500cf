"""Unpacked FMUs: once, whole, as the archive has them, and never more than a machine can bear."""

import os
import shutil
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from pysim.io import archive as module
from pysim.io import extracted, read_model
from pysim.io.archive_check import ArchiveLimits, check_archive
from pysim.types import BadInput


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    folder = tmp_path / "cache"
    folder.mkdir()
    monkeypatch.setattr(module, "cache_folder", lambda purpose: folder)
    new_process()
    yield folder
    new_process()


def new_process() -> None:
    """Forget what this one knows of archives."""
    module._folder.cache_clear()
    module._verify.cache_clear()


def pack(path: Path, **members: str) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in members.items():
            archive.writestr(name.replace("__", "/"), text)
    return path


def test_same_content_is_unpacked_once_and_other_content_elsewhere(tmp_path: Path, own_cache: Path) -> None:
    one = extracted(pack(tmp_path / "a.fmu", resources__data="1"))
    assert (one / "resources" / "data").read_text() == "1"
    (one / "mark").touch()
    (tmp_path / "b.fmu").write_bytes((tmp_path / "a.fmu").read_bytes())
    assert (extracted(tmp_path / "b.fmu") / "mark").exists()
    other = extracted(pack(tmp_path / "a.fmu", resources__data="22"))  # the same file, overwritten
    assert other != one
    assert (other / "resources" / "data").read_text() == "22"
    assert {path.name for path in own_cache.iterdir()} == {one.name, other.name}


def test_the_unused_go_first_and_come_back(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = [pack(tmp_path / f"{name}.fmu", resources__data=name) for name in "abc"]
    folders = [extracted(file) for file in files]
    for age, folder in enumerate(folders):
        os.utime(folder, (age, age))
    extracted(files[0])  # used just now
    monkeypatch.setattr(module, "KEPT_FOLDERS", 2)
    new = extracted(pack(tmp_path / "d.fmu", resources__data="d"))
    assert {path.name for path in own_cache.iterdir()} == {folders[0].name, new.name}
    assert (extracted(files[1]) / "resources" / "data").read_text() == "b"


def test_what_was_used_within_a_day_stays(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "KEPT_FOLDERS", 1)
    folders = [extracted(pack(tmp_path / f"{name}.fmu", resources__data=name)) for name in "abc"]
    assert all(folder.is_dir() for folder in folders)


def test_files_beside_the_folders_stay(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "KEPT_FOLDERS", 0)
    built = own_cache / "built.fmu"
    built.touch()
    os.utime(built, (0, 0))
    extracted(pack(tmp_path / "a.fmu", resources__data="1"))
    assert built.exists()


def test_what_another_process_removed_is_unpacked_again(tmp_path: Path) -> None:
    path = pack(tmp_path / "a.fmu", resources__data="1")
    shutil.rmtree(extracted(path))
    assert (extracted(path) / "resources" / "data").read_text() == "1"


LIBRARY = "binaries/linux64/m.so"


@pytest.mark.parametrize("planted", [LIBRARY, "binaries/linux64/libm.so.6", "resources/data.dll", "resources/data"])
def test_what_was_planted_is_not_given_out(tmp_path: Path, planted: str) -> None:
    path = pack(tmp_path / "a.fmu", **{LIBRARY: "code"}, resources__data="1")
    folder = extracted(path)
    (folder / planted).write_text("planted")
    new_process()
    with pytest.raises(BadInput, match=rf"{planted} was changed\); delete that folder"):
        extracted(path)
    shutil.rmtree(folder)
    assert (extracted(path) / LIBRARY).read_text() == "code"


def test_a_library_that_is_gone_is_missed(tmp_path: Path) -> None:
    path = pack(tmp_path / "a.fmu", **{LIBRARY: "code"})
    (extracted(path) / LIBRARY).unlink()
    new_process()
    with pytest.raises(BadInput, match="delete that folder"):
        extracted(path)


def test_what_an_fmu_writes_beside_its_files_does_not_matter(tmp_path: Path) -> None:
    path = pack(tmp_path / "a.fmu", **{LIBRARY: "code"}, resources__data="1")
    (extracted(path) / "resources" / "log.txt").write_text("x")
    new_process()
    assert (extracted(path) / "resources" / "log.txt").exists()


def zeros(path: Path, method: int = zipfile.ZIP_DEFLATED, size: int = 30_000_000) -> Path:
    """An archive with a file of zeros: 30 MB shrink to 30 kB."""
    with zipfile.ZipFile(path, "w", method) as archive:
        archive.writestr("data", bytes(size))
    return path


def test_an_archive_that_would_grow_a_thousandfold_is_refused_unread(tmp_path: Path, own_cache: Path) -> None:
    path = zeros(tmp_path / "bomb.fmu")
    for read in (extracted, read_model):
        with pytest.raises(BadInput, match=r"bomb\.fmu would unpack to 30 MB, more than the 20 MB .*; export it again"):
            read(path)
    assert list(own_cache.iterdir()) == []


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        (ArchiveLimits(files=2), "holds 3 files, more than 2; export it again with fewer"),
        (ArchiveLimits(size=2_900_000), "would unpack to 3 MB, more than the 3 MB"),
        (ArchiveLimits(ratio=900.0, small=0), "would unpack to 3 MB"),
    ],
)
def test_limits(tmp_path: Path, limits: ArchiveLimits, message: str) -> None:
    path = tmp_path / "a.fmu"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in "abc":
            archive.writestr(name, bytes(1_000_000))
    assert set(check_archive(path)) == set("abc")
    with pytest.raises(BadInput, match=message):
        check_archive(path, limits)


def test_a_directory_that_lies_about_a_size_is_found_out(tmp_path: Path, own_cache: Path) -> None:
    path = zeros(tmp_path / "liar.fmu")
    content = bytearray(path.read_bytes())
    for header, at in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        start = content.index(header) + at
        content[start : start + 4] = (10).to_bytes(4, "little")
    path.write_bytes(content)
    with pytest.raises(BadInput, match=r"liar\.fmu is not an FMU that can be unpacked: Bad CRC"):
        extracted(path)
    assert list(own_cache.iterdir()) == []


def test_a_compression_that_fmi_does_not_allow_is_refused(tmp_path: Path) -> None:
    path = zeros(tmp_path / "a.fmu", zipfile.ZIP_BZIP2, 100)
    with pytest.raises(BadInput, match="data is not compressed by Deflate"):
        extracted(path)


@pytest.mark.parametrize(
    "name", ["../out", "/out", "a/../../out", ".", "..\\out", "C:\\out", "C:out", "\\\\host\\share\\out"]
)
def test_member_that_leaves_the_folder_is_refused_and_nothing_is_left(
    tmp_path: Path, own_cache: Path, name: str
) -> None:
    path = tmp_path / "evil.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("good", "1")
        info = zipfile.ZipInfo("x")
        info.filename = name
        archive.writestr(info, "2")
    with pytest.raises(BadInput, match="would be written outside its folder"):
        extracted(path)
    assert list(own_cache.iterdir()) == []
    assert not (tmp_path / "out").exists()


def test_broken_archive_is_bad_input_and_leaves_nothing(tmp_path: Path, own_cache: Path) -> None:
    path = tmp_path / "broken.fmu"
    path.write_bytes(b"PK\x03\x04 nothing that follows makes sense")
    with pytest.raises(BadInput, match=r"broken\.fmu is not an FMU"):
        extracted(path)
    assert list(own_cache.iterdir()) == []


def damaged(path: Path, change: Callable[[bytearray], None]) -> Path:
    """An archive of one member whose headers or content were changed."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("data", "12345678" * 200)
    content = bytearray(path.read_bytes())
    change(content)
    path.write_bytes(content)
    return path


def encrypted(content: bytearray) -> None:
    for header, at in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        content[content.index(header) + at] |= 1


def broken_stream(content: bytearray) -> None:
    start = 30 + len("data")
    content[start : start + 4] = b"\xff\xff\xff\xff"


@pytest.mark.parametrize("change", [encrypted, broken_stream])
def test_damaged_archive_is_bad_input_and_leaves_nothing(
    tmp_path: Path, own_cache: Path, change: Callable[[bytearray], None]
) -> None:
    path = damaged(tmp_path / "damaged.fmu", change)
    with pytest.raises(BadInput, match=r"damaged\.fmu is not an FMU that can be unpacked: .*; export it again"):
        extracted(path)
    assert list(own_cache.iterdir()) == []
    with pytest.raises(BadInput, match=r"damaged\.fmu"):
        read_model(path)
