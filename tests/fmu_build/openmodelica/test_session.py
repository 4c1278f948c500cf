"""The session with the program that stands for omc, by OMPython as it is."""

from pathlib import Path

import pytest

from fmu_build import BuildError
from fmu_build.openmodelica import session
from fmu_build.openmodelica.session import Session, open_session, quoted, told


def test_answers_are_values_of_python(omc):
    asked = omc(refuses={"getVersion": ['"1.28.0"', []], "numbers": ["{1, 2.5}", []]})
    with open_session() as omc_session:
        assert omc_session.ask("getVersion()") == "1.28.0"
        assert omc_session.ask("numbers()") == (1, 2.5)
        omc_session.require('setCommandLineOptions("-d=x")')
    assert asked.read_text().splitlines()[-1] == 'setCommandLineOptions("-d=x")'


def test_an_error_has_its_place_and_keeps_the_console_clean(omc, capfd):
    messages = [
        ["error", "Error occurred while flattening model A", "", 0],
        ["error", "Variable y not found in scope A.", "/lib/A.mo", 7],
        ["warning", "Something else", "/lib/B.mo", 3],
    ]
    omc(refuses={"loadFile": ["false", messages]})
    with open_session() as omc_session, pytest.raises(BuildError) as caught:
        omc_session.require('loadFile("A.mo")')
    assert (caught.value.file, caught.value.line) == (Path("/lib/A.mo"), 7)
    assert "Variable y not found in scope A." in caught.value.message
    assert "flattening model A" in caught.value.message
    assert "Something else" not in caught.value.message
    assert capfd.readouterr() == ("", "")


def test_a_refusal_without_an_error_is_one_too(omc):
    omc(refuses={"setCommandLineOptions": ["false", []], "getErrorString": ['"Unknown option --x"', []]})
    with open_session() as omc_session, pytest.raises(BuildError, match=r"answers False to .*: Unknown option --x"):
        omc_session.require('setCommandLineOptions("--x")')


def test_an_omc_that_does_not_start_says_why(omc, monkeypatch):
    omc(starts=False)
    monkeypatch.setattr(session, "START_S", 1.0)
    with pytest.raises(BuildError, match=r"omc does not start: .*as a server using the root user"), open_session():
        pass


def test_an_omc_that_crashes_does_not_hang_us(omc):
    omc(dies="buildModelFMU")
    with open_session() as plain, pytest.raises(BuildError, match=r"has not answered buildModelFMU.* for 1 s"):
        Session(plain._omc, plain._failure, 1.0).ask("buildModelFMU(A)")


@pytest.mark.usefixtures("no_omc")
def test_a_missing_one_is_said():
    with pytest.raises(BuildError, match="building with OpenModelica: omc is not installed"), open_session():
        pass


def test_texts_are_quoted_for_omc():
    assert quoted(Path("a b") / "c.mo") == '"a b/c.mo"'
    assert quoted('model A "x\\y" end A;') == '"model A \\"x\\\\y\\" end A;"'


def test_words_without_a_record_are_passed_on():
    assert str(told("OMC error: Error occurred building AST")) == "omc: OMC error: Error occurred building AST"
