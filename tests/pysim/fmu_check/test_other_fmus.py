"""FMUs that offer less, and FMI 3: what cannot be tried is skipped, and the rest still finds faults."""

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from fmu_build import build
from pysim.fmu_check import check_fmu
from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.result import CheckResult
from pysim.fmu_check.subject import Subject, read_subject
from pysim.fmu_check.worker import results_of
from tests.foreign import made_foreign
from tests.planted import planted

QUIET = [name for name in CHECKS if not name.startswith("call order")]


def without(kind: str, fmu: Path, output: Path) -> Path:
    """A copy that does not offer this kind."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(output, "w") as new:
        for item in old.infolist():
            content = old.read(item)
            if item.filename == "modelDescription.xml":
                text = content.decode("utf-8")
                content = re.sub(rf"<{kind} [^>]*/>", "", text).encode("utf-8")
            new.writestr(item, content)
    return output


def verdicts(subject: Subject) -> dict[str, set[str]]:
    return {name: {result.verdict for result in CHECKS[name](subject)} for name in QUIET}


def test_co_simulation_alone(tmp_path: Path) -> None:
    good = verdicts(read_subject(without("ModelExchange", planted("NONE", tmp_path), tmp_path / "good.fmu")))
    assert {name for name, found in good.items() if found == {"skipped"}} == {"derivatives", "dependencies", "order"}
    assert set().union(*good.values()) == {"holds", "skipped"}
    for fault, check in (
        ("IGNORED_START", "start values"),
        ("HALF_RESTORED", "restore"),
        ("SHARED_DAMPING", "instances"),
    ):
        bad = verdicts(read_subject(without("ModelExchange", planted(fault, tmp_path), tmp_path / f"{check}.fmu")))
        assert "fails" in bad[check]


def test_model_exchange_alone(tmp_path: Path) -> None:
    good = verdicts(read_subject(without("CoSimulation", planted("NONE", tmp_path), tmp_path / "good.fmu")))
    assert good["runs"] == {"skipped"}
    assert set().union(*good.values()) == {"holds", "skipped"}
    bad = verdicts(read_subject(without("CoSimulation", planted("IDLE_GAIN", tmp_path), tmp_path / "bad.fmu")))
    assert "doubtful" in bad["parameters"]


def test_a_derivative_of_no_state_is_reported_and_the_rest_skipped(tmp_path: Path) -> None:
    bad = tmp_path / "bad.fmu"
    with zipfile.ZipFile(planted("NONE", tmp_path)) as old, zipfile.ZipFile(bad, "w") as new:
        for item in old.infolist():
            new.writestr(item, old.read(item).replace(b' derivative="1"', b""))
    first, *rest = check_fmu(bad, ("description", "start values", "runs")).results
    assert first.verdict == "fails"
    assert '"der(x)"' in first.detail
    assert 'must have the attribute "derivative"' in first.detail
    *_, last = rest
    assert (last.check, last.verdict) == ("runs", "skipped")
    assert "der(x) stands among the derivatives" in last.detail


def redescribed(fmu: Path, output: Path, *changes: tuple[str, str]) -> Subject:
    """The same with another description."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(output, "w") as new:
        for item in old.infolist():
            content = old.read(item)
            if item.filename == "modelDescription.xml":
                text = content.decode("utf-8")
                for before, after in changes:
                    assert before in text
                    text = text.replace(before, after, 1)
                content = text.encode("utf-8")
            new.writestr(item, content)
    return read_subject(output)


def test_an_output_that_is_a_state_depends_on_no_other(tmp_path: Path) -> None:
    """FMI wants an output's dependencies on states and inputs; a state is what it is."""
    subject = redescribed(
        planted("NONE", tmp_path),
        tmp_path / "output.fmu",
        ('name="x" valueReference="0" causality="local"', 'name="x" valueReference="0" causality="output"'),
        (
            '<Outputs><Unknown index="6" dependencies="1"/>',
            '<Outputs><Unknown index="1" dependencies=""/><Unknown index="6"/>',
        ),
    )
    assert set().union(*verdicts(subject).values()) == {"holds"}


def test_an_fmu_of_which_nothing_moves_is_not_run(tmp_path: Path) -> None:
    """As one that only reads a file of its resources."""
    head, rest = _description(tmp_path).split("<ModelVariables>")
    tail = rest.partition("</ModelVariables>")[2]
    still = '<ScalarVariable name="g" valueReference="9" causality="parameter" variability="fixed" initial="exact">'
    still += '<Real start="3"/></ScalarVariable></ModelVariables><ModelStructure/></fmiModelDescription>'
    text = f"{head}<ModelVariables>{still}"
    assert tail
    subject = redescribed(planted("NONE", tmp_path), tmp_path / "still.fmu", (_description(tmp_path), text))
    assert verdicts(subject)["runs"] == {"skipped"}


def _description(folder: Path) -> str:
    with zipfile.ZipFile(planted("NONE", folder)) as archive:
        return archive.read("modelDescription.xml").decode("utf-8")


def test_our_own_mistake_is_not_laid_at_the_fmus_door(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def mistaken(subject: Subject) -> Iterator[CheckResult]:
        raise ValueError("need at least one array")
        yield

    monkeypatch.setattr("pysim.fmu_check.worker.CHECKS", {"runs": mistaken})
    (result,) = results_of("runs", read_subject(planted("NONE", tmp_path)))
    assert result.verdict == "skipped"
    assert "ValueError in mistaken" in result.detail


TEXT = """model Lag "Follows its input"
  parameter Real T(min = 0.01, fixed = true) = 0.5;
  input Real u(start = 0);
  output Real y(start = 0.2, fixed = true);
equation
  T*der(y) = u - y;
end Lag;
"""


@pytest.mark.parametrize("fmi", [2, 3])
def test_our_own_and_a_foreign_one(fmi: int, tmp_path: Path) -> None:
    (tmp_path / "Lag.mo").write_text(TEXT, encoding="utf-8")
    own = build("Lag", tmp_path / f"Lag_{fmi}.fmu", libraries=[tmp_path / "Lag.mo"], fmi=fmi)
    assert set().union(*verdicts(read_subject(own)).values()) == {"holds"}
    foreign = verdicts(read_subject(made_foreign(own, tmp_path / "foreign.fmu")))
    assert foreign["restore"] == {"skipped"}
    assert foreign["dependencies"] == {"skipped"}
    assert "skipped" in foreign["derivatives"]
    assert "fails" not in set().union(*foreign.values())
