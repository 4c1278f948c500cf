"""Models are compiled once, stay where they are, and a class that does not compile leaves nothing behind."""

from dataclasses import replace
from pathlib import Path

import pytest

from pysim.types import BadInput
from validation.blind.benchmark import workshop as module
from validation.blind.benchmark.workshop import Workshop, workshop


def test_a_variant_is_built_once_and_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shop = workshop()
    mine = Workshop(shop.model, shop.catalogue, tmp_path)
    effects = [shop.effect("oil.air"), shop.effect("sensor.lag")]
    model, places = mine.variant(effects)
    assert model.path == tmp_path / "oil.air+sensor.lag.fmu"
    assert set(places) == {"oil.air", "sensor.lag"}
    assert all(model[f"{places[e.name]}.{e.parameters[0].name}"].causality == "parameter" for e in effects)
    assert mine.seconds > 0
    monkeypatch.setattr(module.fmu_build, "build", lambda *_, **__: pytest.fail("built again"))
    assert mine.variant(effects)[0] is model
    again = Workshop(shop.model, shop.catalogue, tmp_path)
    assert again.variant(effects)[0].token == model.token


def test_what_does_not_compile_is_refused_and_leaves_nothing(tmp_path: Path) -> None:
    shop = workshop()
    broken = replace(shop.effect("oil.air"), class_name="HydraulicTestBench.Effects.Nothing")
    with pytest.raises(BadInput, match="Nothing"):
        Workshop(shop.model, shop.catalogue, tmp_path).variant([broken])
    assert list(tmp_path.iterdir()) == []


def test_the_base_model_lacks_nothing() -> None:
    shop = workshop()
    assert shop.model.path.name == "base.fmu"
    assert len({effect.name for effect in shop.catalogue}) == len(shop.catalogue) >= 18
