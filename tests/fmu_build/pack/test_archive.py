"""The zip file: the same bytes for the same content, and whole or not there."""

import time
import zipfile

import pytest

from fmu_build.errors import BuildError
from fmu_build.pack.archive import check_writable, write_archive

MEMBERS = {"sources/b.c": b"int b;", "modelDescription.xml": b"<x/>", "binaries/linux64/m.so": bytes(1000)}


def accept(path):
    pass


def test_content_comes_back_with_the_description_first(tmp_path):
    write_archive(tmp_path / "m.fmu", MEMBERS, accept)
    with zipfile.ZipFile(tmp_path / "m.fmu") as archive:
        assert archive.namelist()[0] == "modelDescription.xml"
        assert {name: archive.read(name) for name in archive.namelist()} == MEMBERS
        assert archive.testzip() is None


def test_same_content_same_bytes(tmp_path, monkeypatch):
    write_archive(tmp_path / "a.fmu", MEMBERS, accept)
    monkeypatch.setattr(time, "time", lambda: 2e9)
    write_archive(tmp_path / "b.fmu", dict(reversed(MEMBERS.items())), accept)
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "b.fmu").read_bytes()


def test_a_refused_archive_leaves_what_was_there(tmp_path):
    (tmp_path / "m.fmu").write_text("before")

    def refuse(path):
        raise BuildError("no")

    with pytest.raises(BuildError, match="no"):
        write_archive(tmp_path / "m.fmu", MEMBERS, refuse)
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("m.fmu", "before")]


@pytest.mark.parametrize(
    ("place", "message"), [("missing/m.fmu", "does not exist"), (".", "is a folder"), ("file/m.fmu", "does not exist")]
)
def test_unwritable_targets(tmp_path, place, message):
    (tmp_path / "file").touch()
    with pytest.raises(BuildError, match=message):
        check_writable(tmp_path / place)


def test_a_target_that_becomes_unwritable(tmp_path):
    with pytest.raises(BuildError, match="cannot write"):
        write_archive(tmp_path / "gone" / "m.fmu", MEMBERS, accept)
