"""What notebooks add: figures that move, sliders, xarray, and pictures that are seen without pyplot."""

import sys
from collections.abc import Callable
from typing import Any

import pytest

import pysim
from pysim.nouns.diagnosis import Diagnosis
from pysim.nouns.fit import Fit
from pysim.nouns.model import Model
from pysim.present.charts import COLOURS, HEAT, coloured
from pysim.types import BadInput, Dataset
from tests.test_docs import ROOT

PLOTS: dict[str, Callable[[Fit, Diagnosis], Any]] = {
    "log": lambda fitted, why: fitted.plot(interactive=True),
    "parameters": lambda fitted, why: fitted.plot("parameters", interactive=True),
    "correlation": lambda fitted, why: fitted.plot("correlation", interactive=True),
    "model": lambda fitted, why: fitted.model.plot(interactive=True),
    "run": lambda fitted, why: fitted.model.simulate(1.0).plot(interactive=True),
    "diagnosis": lambda fitted, why: why.plot(interactive=True),
    "where": lambda fitted, why: why.where().plot(interactive=True),
    "effect": lambda fitted, why: pysim.effect(
        "my.drag", at="force", law="-c*v*abs(v)", model=fitted.begun, c=(0, 1, 0.1, "N.s2/m2")
    ).plot(interactive=True),
}


@pytest.mark.parametrize("name", PLOTS)
def test_every_plot_moves_where_it_is_asked_to(name: str, fitted: Fit, why: Diagnosis) -> None:
    graph = pytest.importorskip("plotly.graph_objects")
    figure = PLOTS[name](fitted, why)
    assert isinstance(figure, graph.Figure)  # which refuses what Plotly does not know
    assert figure.data or figure.layout.annotations


def test_the_staircase_that_moves_has_the_numbers_of_the_table(why: Diagnosis) -> None:
    pytest.importorskip("plotly")
    steps = {trace.name: trace for trace in why.plot(interactive=True).data if trace.mode == "markers"}
    assert list(steps["fitted"].y[1:]) == list(why.steps["fitted"])
    assert list(steps["used to choose"].y[1:]) == list(why.steps["used to choose"])


def test_sliders_move_the_model(mass: Model, data: Dataset) -> None:
    pytest.importorskip("ipywidgets")
    sliders = mass.free("m", "k").explore(data)
    m, k = sliders.children[:2]
    assert (m.description, m.min, m.max, m.value) == ("m", 0.5, 5.0, 1.0)
    k.value = 40.0
    assert sliders.kwargs == {"m": 1.0, "k": 40.0}
    assert len(sliders.result.axes) == 2  # the log, and what is left


def test_tables_go_to_xarray(fitted: Fit) -> None:
    pytest.importorskip("xarray")
    assert fitted.to_xarray()["value"].sel(parameter="m").item() == fitted.values["m"]
    run = fitted.model.simulate(1.0)
    assert run.to_xarray()["x [m]"].size == run.time.size


@pytest.mark.parametrize(
    ("package", "ask"),
    [
        ("plotly.graph_objects", lambda fitted, data: fitted.plot(interactive=True)),
        ("ipywidgets", lambda fitted, data: fitted.begun.explore(data)),
        ("xarray", lambda fitted, data: fitted.to_xarray()),
    ],
)
def test_a_package_that_is_missing_is_named_with_the_cure(
    package: str, ask: Callable[[Fit, Dataset], Any], fitted: Fit, data: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(BadInput, match=r"; run: pip install \"hydraulic-test-bench\[notebook\]\"$"):
        ask(fitted, data)


def test_a_figure_shows_itself_where_nobody_has_imported_pyplot(fitted: Fit) -> None:
    assert fitted.plot()._repr_png_().startswith(b"\x89PNG")


def test_nothing_of_a_run_prints_at_length(fitted: Fit) -> None:
    assert len(repr(fitted.model.simulate(1.0).record)) < 2000


def test_colours_are_those_of_the_page() -> None:
    style = (ROOT / "pysim" / "app" / "static" / "app.css").read_text(encoding="utf-8").partition("body.body--dark")[0]
    for name, value in {**COLOURS, **{f"heat{k}": colour for k, colour in enumerate(HEAT)}}.items():
        assert f"--{name}: {value};" in style, name
    assert coloured({"a": ["@ink", "inherit"], "b": "@heat"})["a"][0] == COLOURS["ink"]
