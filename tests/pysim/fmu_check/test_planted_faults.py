"""Every planted fault is found by its check and by no other, and the FMU without a fault passes all."""

from collections.abc import Callable

import pytest

from pysim.fmu_check import CHECKS, check_fmu
from pysim.fmu_check.result import CheckResult
from pysim.fmu_check.subject import Subject
from tests.planted import FAULTS

Told = Callable[[str, str], list[CheckResult]]
QUIET = [name for name in CHECKS if not name.startswith("call order")]

# fault -> check, verdict, words of its claim, words of its detail
FOUND = {
    "WRONG_SLOPE": ("derivatives", "fails", "directional", "d der(v) / d v off by 0.99 %"),
    "WRONG_RUN": ("runs", "fails", "follows model exchange", "2.0e-02"),
    "UNTOLD_DEPENDENCY": ("dependencies", "fails", "nothing moves", "y moves with u"),
    "SHARED_DAMPING": ("instances", "fails", "do not know each other (me)", "der(v)"),
    "IGNORED_START": ("start values", "fails", "are taken", "x is 0.5 after 0.55 was set"),
    "OTHER_START": ("start values", "fails", "in force", "x is 0.4, declared 0.5"),
    "IDLE_GAIN": ("parameters", "doubtful", "has an effect", "g"),
    "HALF_RESTORED": ("restore", "fails", "same again (cs)", "v"),
    "HALF_RESET": ("instances", "fails", "a reset gives the first run again (me)", "der(v)"),
    "MEMORY": ("derivatives", "fails", "nothing but time", "der(v)"),
    "EULER": ("runs", "doubtful", "steps four times as large", "bound to the step"),
    "ANY_REFERENCE": ("call order: an unknown value reference (cs)", "doubtful", "refused", "goes unnoticed"),
    "FIXED_STEP": ("runs", "doubtful", "follows model exchange", "steps of a fixed size"),
    "BENT": ("dependencies", "fails", "constant or fixed are linear", "der(v) with x"),
    "OTHER_DERIVATIVE": ("derivatives", "fails", "what the call for derivatives gives", "der(v)"),
}
DEADLY = {"CRASH_EARLY", "CRASH_SAVE", "HANG"}
HARMLESS = {"NONE", "SLOW", "TALKATIVE", "EARLY_END"}


def test_every_fault_is_expected_somewhere() -> None:
    assert set(FOUND) | DEADLY | HARMLESS == set(FAULTS)


@pytest.mark.parametrize("fault", FOUND)
def test_the_fault_is_found(fault: str, told: Told) -> None:
    check, verdict, claim, detail = FOUND[fault]
    found = told(fault, check)
    assert found, "nothing was found"
    assert found[0].verdict == verdict
    assert claim in found[0].claim
    assert detail in found[0].detail


@pytest.mark.parametrize("fault", ["WRONG_SLOPE", "UNTOLD_DEPENDENCY", "OTHER_START", "HALF_RESTORED", "EULER", "BENT"])
def test_no_other_check_is_alarmed(fault: str, told: Told) -> None:
    """But for runs that differ by as much as two right-hand sides do."""
    allowed = {FOUND[fault][0], *({"runs"} if fault == "BENT" else ())}
    alarmed = {check for check in QUIET if check not in allowed and told(fault, check)}
    assert alarmed == set()


def test_without_a_fault_all_holds(subject: Callable[[str], Subject]) -> None:
    seen = []
    report = check_fmu(subject("NONE").path, progress=lambda done, total: seen.append((done, total)))
    assert {result.verdict for result in report.results} == {"holds"}
    assert (report.model, report.fmi, report.passes) == ("Mass", "2.0", True)
    assert seen[0] == (0, len(CHECKS))
    assert seen[-1] == (len(CHECKS), len(CHECKS))


def test_a_crash_is_a_finding_and_not_the_end(subject: Callable[[str], Subject]) -> None:
    (crash, after) = check_fmu(subject("CRASH_SAVE").path, ("restore", "order")).results
    assert (crash.check, crash.verdict) == ("restore", "fails")
    assert "SIGSEGV" in crash.detail or "exit code" in crash.detail
    assert (after.check, after.verdict) == ("order", "holds")


def test_a_crash_in_a_forbidden_call_is_doubtful(subject: Callable[[str], Subject]) -> None:
    name = "call order: derivatives asked for before initialisation (me)"
    (crash,) = check_fmu(subject("CRASH_EARLY").path, (name,)).results
    assert crash.verdict == "doubtful"
    assert "survives derivatives asked for" in crash.claim


def test_a_hang_is_a_finding(subject: Callable[[str], Subject]) -> None:
    """Patience is shorter than a worker takes to start, which is not the FMU's doing."""
    name = "call order: terminated twice (me)"
    (hang,) = check_fmu(subject("HANG").path, (name,), patience=0.3).results
    assert hang.verdict == "fails"
    assert "hangs" in hang.detail


@pytest.mark.slow
def test_many_slow_answers_are_no_hang(subject: Callable[[str], Subject]) -> None:
    """Half a second for each of eight instances."""
    results = check_fmu(subject("SLOW").path, ("start values",), patience=3.0).results
    assert [result.verdict for result in results] == ["holds"] * 3


def test_what_an_fmu_writes_to_the_standard_error_does_not_hold_it_up(subject: Callable[[str], Subject]) -> None:
    (result,) = check_fmu(subject("TALKATIVE").path, ("order",), patience=30.0).results
    assert result.verdict == "holds"


def test_an_fmu_may_end_the_simulation(told: Told) -> None:
    """After half of the default experiment, in both kinds."""
    assert [result for check in QUIET for result in told("EARLY_END", check)] == []
