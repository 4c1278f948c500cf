"""The one list of kinds of records, against the specification of data sets; the words beside a setting."""

from dataclasses import FrozenInstanceError, dataclass

import pytest

from pysim.types.record_kind import KINDS, LOGS, Compared
from pysim.types.setting import setting, settings_of


def test_kinds_are_those_of_the_specification() -> None:
    needs = {name: kind.needs for name, kind in KINDS.items()}
    assert needs == {
        "frequency-response": ("offset", "amplitude", "frequency"),
        "chirp": ("offset", "amplitude"),
        "stochastic": (),
        "multisine": (),
        "step": (),
        "other": (),
        "frequency-response-table": (),
    }
    assert [kind.name for kind in KINDS.values() if kind not in LOGS] == ["frequency-response-table"]
    assert {kind.name for kind in LOGS if kind.broad} == {"chirp", "stochastic", "multisine"}
    assert [kind.name for kind in LOGS if kind.compared is Compared.HARMONICS] == ["frequency-response"]


def test_a_setting_keeps_its_words_beside_its_number() -> None:
    @dataclass(frozen=True)
    class Settings:
        level: float = setting(0.95, unit="1", meaning="Probability of intervals.", source="convention")

    (level,) = settings_of(Settings(level=0.9))
    assert (level.name, level.value, level.unit) == ("level", 0.9, "1")
    assert Settings().level == 0.95
    with pytest.raises(FrozenInstanceError):
        Settings().level = 0.5  # type: ignore[misc]
