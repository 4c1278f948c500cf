"""The cases of the thesis that are done in no time hold, and would not with another number."""

import pytest

from validation.thesis.appendix_a import case as appendix_a
from validation.thesis.figure_2_1 import case as figure_2_1
from validation.thesis.figure_4_2 import case as figure_4_2
from validation.thesis.table_4_2 import case as table_4_2
from validation.thesis.table_5_1 import case as table_5_1

MODULES = (appendix_a, figure_2_1, figure_4_2, table_4_2, table_5_1)


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__.split(".")[-2])
def test_all_hold(module) -> None:
    findings = list(module.run())
    assert findings
    assert [str(finding) for finding in findings if not finding.holds] == []


@pytest.mark.parametrize(
    ("module", "name", "factor"),
    [
        (appendix_a, "height", 1.01),
        (figure_2_1, "sine_starts", 1.01),
        (table_5_1, "K_s", 1.0001),
        (table_5_1, "K_qp", 1.1),
    ],
)
def test_another_number_fails(module, name: str, factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    told = module.published(module.__file__)
    if module is appendix_a:  # the spectrum is made of the numbers; only Eq. 1 beside it is to have another
        monkeypatch.setattr(
            module, "_spectrum", lambda: module.PiersonMoskowitz(told["height"] * factor, told["period"])
        )
    else:
        monkeypatch.setattr(module, "published", lambda _: {**told, name: told[name] * factor})
    assert not all(finding.holds for finding in module.run())


def test_an_orifice_alone_would_be_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    angle, _ = table_4_2._table()
    monkeypatch.setattr(table_4_2, "_table", lambda: (angle, 0.01 * angle**2))
    assert not all(finding.holds for finding in table_4_2.run())
