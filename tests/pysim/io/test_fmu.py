import re
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest

from pysim.io import read_model
from pysim.types import BadInput
from tests.foreign import made_foreign
from tests.planted import planted
from tests.pysim.simulate.fixture_fmus import BALL, OSCILLATOR, build
from tests.pysim.simulate.text_models import LAG, text_model


@pytest.mark.parametrize("fmi", [2, 3])
def test_table_and_abilities(tmp_path, fmi):
    model = read_model(str(build(OSCILLATOR, fmi, tmp_path)))
    assert (model.name, model.token) == ("oscillator", "oscillator")
    assert model.abilities.fmi == fmi
    assert (model.abilities.model_exchange, model.abilities.co_simulation) == (True, False)
    assert model.abilities.directional_derivatives
    assert model.abilities.states == ("x", "v")
    assert model.abilities.derivatives == ("der(x)", "der(v)")
    assert model.abilities.library == "oscillator"
    assert model.abilities.needs_completed_step
    w = model["w"]
    assert (w.causality, w.variability, w.start, w.reference) == ("parameter", "fixed", 2.0, 400)
    assert (model["u"].unit, model["u"].causality, model["power"].unit) == ("N", "input", "W")
    assert model["der(x)"].derivative_of == "x"
    assert model["D"].unit == "1"


@pytest.mark.parametrize("fmi", [2, 3])
def test_event_indicators_are_counted(tmp_path, fmi):
    assert read_model(build(BALL, fmi, tmp_path)).abilities.event_indicators == 1
    assert read_model(build(OSCILLATOR, fmi, tmp_path)).abilities.event_indicators == 0


def test_dependencies_are_names_and_none_where_not_given(tmp_path):
    path = tmp_path / "given.fmu"
    with zipfile.ZipFile(build(OSCILLATOR, 2, tmp_path)) as archive:
        text = archive.read("modelDescription.xml").decode()
    assert read_model(build(OSCILLATOR, 2, tmp_path)).abilities.dependencies == (None, None)
    with zipfile.ZipFile(path, "w") as archive:
        # der(x) is variable 4 and depends on v, number 3; der(v) on x, v and u, numbers 2, 3 and 6.
        text = text.replace('<Unknown index="4"/>', '<Unknown index="4" dependencies="3"/>')
        archive.writestr("modelDescription.xml", text.replace('index="5"/>', 'index="5" dependencies="2 3 6"/>'))
    assert read_model(path).abilities.dependencies == (frozenset({"v"}), frozenset({"x", "v", "u"}))


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_derivative_of_no_state_is_named(tmp_path, fmi):
    with zipfile.ZipFile(build(OSCILLATOR, fmi, tmp_path)) as archive:
        text = archive.read("modelDescription.xml").decode()
    path = write(tmp_path / "stateless.fmu", re.sub(r' derivative="\d+"', "", text, count=1))
    with pytest.raises(BadInput, match=r"stateless\.fmu: .* der\(x\) among the derivatives, .* says of which state"):
        read_model(path)
    assert read_model(path, faulty=True).abilities.states == ("v",)


def write(path: Path, description: str | None) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        if description is not None:
            archive.writestr("modelDescription.xml", description)
    return path


@pytest.mark.parametrize("fmi", [2, 3])
def test_a_model_without_any_unit_is_told_from_one_whose_numbers_have_none(tmp_path, fmi):
    with zipfile.ZipFile(build(OSCILLATOR, fmi, tmp_path)) as archive:
        text = archive.read("modelDescription.xml").decode()
    assert read_model(build(OSCILLATOR, fmi, tmp_path)).declares_units
    bare = re.sub(r' (unit|displayUnit|declaredType)="[^"]*"', "", text)
    model = read_model(write(tmp_path / "bare.fmu", bare))
    assert (model.declares_units, model["u"].unit) == (False, "1")
    time = ("<Real/>", '<Real unit="s"/>') if fmi == 2 else ('name="time"', 'name="time" unit="s"')
    timed = bare.replace(*time, 1)
    assert not read_model(write(tmp_path / "timed.fmu", timed)).declares_units  # time says nothing of the others
    assert read_model(write(tmp_path / "one.fmu", bare.replace('start="2.0"', 'start="2.0" unit="1"'))).declares_units


def test_what_is_no_fmu_is_named(tmp_path):
    with pytest.raises(BadInput, match=r"no FMU at .*missing\.fmu"):
        read_model(tmp_path / "missing.fmu")
    (tmp_path / "text.fmu").write_text("hello")
    with pytest.raises(BadInput, match=r"text\.fmu is not an FMU"):
        read_model(tmp_path / "text.fmu")
    with pytest.raises(BadInput, match=r"empty\.fmu is not an FMU"):
        read_model(write(tmp_path / "empty.fmu", None))
    with pytest.raises(BadInput, match=r"modelDescription\.xml cannot be read"):
        read_model(write(tmp_path / "broken.fmu", "<fmiModelDescription"))


def test_fmi_1_is_refused_with_the_cure(tmp_path):
    xml = (
        '<fmiModelDescription fmiVersion="1.0" modelName="old" modelIdentifier="old" guid="g" '
        'numberOfContinuousStates="0" numberOfEventIndicators="0"><ModelVariables/></fmiModelDescription>'
    )
    with pytest.raises(BadInput, match=r"is an FMI 1\.0 FMU; export it as FMI 2\.0 or 3\.0"):
        read_model(write(tmp_path / "old.fmu", xml))


@pytest.mark.parametrize("fmi", [2, 3])
def test_what_is_said_of_coupling(tmp_path, fmi):
    abilities = text_model(LAG, tmp_path, fmi=fmi).abilities  # power = K*u*y, and y is a state
    assert dict(abilities.feedthrough) == {"y": frozenset(), "power": frozenset({"u"})}
    stepping = abilities.stepping
    assert stepping.library == "Lag"
    assert (stepping.variable_step, stepping.state_handling, stepping.single_instance) == (True, True, False)
    assert (stepping.event_mode, stepping.early_return) == (fmi == 3, fmi == 3)
    foreign = read_model(made_foreign(tmp_path / f"Lag_{fmi}.fmu", tmp_path / "foreign.fmu")).abilities
    assert dict(foreign.feedthrough) == {"y": None, "power": None}
    assert not foreign.stepping.state_handling
    assert read_model(build(OSCILLATOR, fmi, tmp_path)).abilities.stepping is None


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-32", "latin-1"])
def test_a_description_in_another_encoding_is_read_or_refused(encoding: str, tmp_path: Path) -> None:
    """FMI writes UTF-8; one reader takes some others, and another does not."""
    path = tmp_path / "other.fmu"
    with zipfile.ZipFile(planted("NONE", tmp_path)) as old, zipfile.ZipFile(path, "w") as new:
        for item in old.infolist():
            content = old.read(item)
            if item.filename == "modelDescription.xml":
                text = (
                    content.decode("utf-8")
                    .replace('"Mass"', '"Größe"')
                    .replace(' providesDirectionalDerivative="true"', "")
                )
                content = text.encode(encoding)
            new.writestr(item, content)
    name = ""
    with suppress(BadInput):
        name = read_model(path).name
    assert name in ("", "Größe")
