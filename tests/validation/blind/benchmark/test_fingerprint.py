"""The fingerprint changes with the code that answers, and with nothing else."""

from pathlib import Path

from validation.blind.benchmark.fingerprint import fingerprint


def tree(root: Path, **changed: bytes) -> Path:
    files = {
        "pysim/diagnose/a.py": b"a\n",
        "pysim/diagnose/deep/b.py": b"b\n",
        "pysim/diagnose/locating/l.py": b"l\n",
        "pysim/cli/c.py": b"c\n",
        "modelica/HydraulicTestBench/Effects/E.mo": b"e\n",
        "modelica/HydraulicTestBench/Examples/X.mo": b"x\n",
        "validation/blind/benchmark/judged.py": b"j\n",
        "validation/blind/benchmark/report.py": b"r\n",
    }
    for name, content in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(changed.get(path.stem, content))
    return root


def test_what_answers_counts(tmp_path: Path) -> None:
    first = fingerprint(tree(tmp_path / "0"))
    assert len(first) == 12
    for name in ("a", "b", "E", "judged"):
        assert fingerprint(tree(tmp_path / name, **{name: b"new\n"})) != first


def test_what_only_shows_does_not_nor_how_lines_end(tmp_path: Path) -> None:
    first = fingerprint(tree(tmp_path / "0"))
    for name in ("c", "l", "X", "report"):
        assert fingerprint(tree(tmp_path / name, **{name: b"new\n"})) == first
    assert fingerprint(tree(tmp_path / "ends", a=b"a\r\n")) == first


def test_where_a_term_is_missing_counts_only_for_places(tmp_path: Path) -> None:
    first = fingerprint(tree(tmp_path / "0"), places=True)
    assert fingerprint(tree(tmp_path / "l", l=b"new\n"), places=True) != first


def test_moving_a_line_from_one_file_to_the_next_counts(tmp_path: Path) -> None:
    other = fingerprint(tree(tmp_path / "0", a=b"a\nb\n", b=b""))
    assert other != fingerprint(tree(tmp_path / "1"))


def test_the_sources_are_there() -> None:
    assert fingerprint() == fingerprint()
    assert fingerprint() != fingerprint(Path("nowhere"))
