import pytest

from pysim.io.file_names import same_file, unusable_name


@pytest.mark.parametrize(
    ("source", "why"),
    [
        ("step/con.txt", "'con.txt' is a device on Windows"),
        ("AUX/a.txt", "'AUX' is a device"),
        ("nul .old.txt", "is a device"),
        ("lpt1", "is a device"),
        ("step./a.txt", "drops the end of 'step.'"),
        ("step/a.txt ", "drops the end of 'a.txt '"),
        ("../a.txt", "drops the end of '..'"),
        ("a?b:c.txt", "no file names with : ?"),
        ("a\\b.txt", "no file names with"),
        ("a\tb.txt", r"no file names with '\t'"),
    ],
)
def test_what_windows_has_no_name_for(source: str, why: str) -> None:
    assert why in unusable_name(source)


@pytest.mark.parametrize(
    "source", ["step/O+1_H-2.txt", "console.txt", "com10.txt", "a .txt", ".hidden/x", "Prüfung é.csv"]
)
def test_what_every_system_has(source: str) -> None:
    assert unusable_name(source) == ""


def test_names_of_one_file() -> None:
    assert same_file("Step/A.txt") == same_file("step//./a.TXT")
    assert same_file("\u00e9.txt") == same_file("e\u0301.txt") == same_file("\u00c9.txt")
    assert same_file("a.txt") != same_file("b/a.txt")
