"""The generated model: its functions against closed forms, and its derivatives against each other."""

import ctypes
import re

import numpy as np
import pytest

from fmu_build.emit import c_source, complete_table
from fmu_build.emit.c_source import c_string
from fmu_build.emit.functions import model_functions
from fmu_build.emit.hoist import hoist_parameters
from tests import ode_models
from tests.generated_c import compile_shared, exported


def functions_of(model, folder):
    model = complete_table(model)
    functions = model_functions(hoist_parameters(model))[1]
    sizes = {f.name: tuple(r.numel() for r in f.results) for f in functions if not f.is_empty}
    return exported(c_source(model, "token"), sizes, folder)


@pytest.mark.parametrize("build", ode_models.ALL)
def test_compiles_without_a_warning_and_exports_only_the_model(build, tmp_path):
    source = c_source(complete_table(build()), "token")
    library = compile_shared(source, tmp_path)
    assert ctypes.c_char_p.in_dll(library, "model").value == build().name.encode()
    assert not re.search(r"^(?!static|const Model model)[a-z].*[({=]", source, flags=re.M)


def test_oscillator_follows_its_closed_form(tmp_path):
    f = functions_of(ode_models.oscillator(), tmp_path)
    p = [2.0, 50.0, 0.1]
    (c,) = f["calculated"](p=p)
    assert c[0] == pytest.approx(2 * 0.1 * 10, rel=1e-15)
    values = {"x": [0.1, 0.3], "u": [4.0], "p": p, "c": c}
    np.testing.assert_allclose(f["derivatives"](**values)[0], [0.3, (4 - 5 - 0.6) / 2], rtol=1e-15)
    np.testing.assert_allclose(f["outputs"](**values)[0], [5.6], rtol=1e-15)
    np.testing.assert_allclose(f["jacobian"](**values)[0], [0, -25, 1, -1], rtol=1e-15)


def test_tangents_of_parameters_run_through_calculated_ones(tmp_path):
    f = functions_of(ode_models.oscillator(), tmp_path)
    p, seed = np.array([2.0, 50.0, 0.1]), np.array([0.3, -2.0, 0.7])

    def derivatives(p):
        return f["derivatives"](x=[0.1, 0.3], u=[4.0], p=p, c=f["calculated"](p=p)[0])[0]

    h = 1e-6
    expected = (derivatives(p + h * seed) - derivatives(p - h * seed)) / (2 * h)
    zeros = {"seed_x": [0, 0], "seed_u": [0]}
    found = f["forward"](x=[0.1, 0.3], u=[4.0], p=p, c=f["calculated"](p=p)[0], seed_p=seed, **zeros)[0]
    np.testing.assert_allclose(found, expected, rtol=1e-8)


@pytest.mark.parametrize("build", [ode_models.oscillator, ode_models.implicit_decay, ode_models.bouncing_ball])
def test_reverse_is_the_transpose_of_forward(build, tmp_path):
    model = build()
    f = functions_of(model, tmp_path)
    random = np.random.default_rng(1)
    values = {name: random.normal(size=getattr(model.symbols, name).numel()) for name in ("x", "u", "q", "d")}
    values["p"] = random.uniform(0.5, 2, model.symbols.p.numel())
    values["c"] = f["calculated"](p=values["p"])[0] if "calculated" in f else []
    order = ("x", "u", "p", "q", "v")
    seeds = {name: random.normal(size=getattr(model.symbols, name).numel()) for name in order}
    weights = [random.normal(size=size) for size in f["forward"].sizes]
    tangents = f["forward"](**values, **{f"seed_{name}": seed for name, seed in seeds.items()})
    named = dict(zip(("weight_dx", "weight_w", "weight_g"), weights, strict=True))
    gradients = f["reverse"](**values, **named)
    forward = sum(w @ t for w, t in zip(weights, tangents, strict=True))
    reverse = sum(g @ seeds[name] for g, name in zip(gradients, order, strict=True))
    assert forward == pytest.approx(reverse, rel=1e-12)
    assert abs(forward) > 1e-3


def test_ball_bounces_once_per_contact_and_comes_to_rest(tmp_path):
    update = functions_of(ode_models.bouncing_ball(), tmp_path)["update"]
    common = {"x": [-1e-9, -2.0], "p": [9.81, 0.7, 0.1], "pre_d": [1]}
    d, b, x, _ = update(**common, r=[1, 0], pre_b=[0])
    np.testing.assert_allclose([d[0], b[0], x[1]], [1, 1, 1.4])
    _, _, x, _ = update(**common, r=[1, 0], pre_b=[1])
    assert x[1] == -2.0
    d, _, x, _ = update(**common, r=[1, 1], pre_b=[0])
    np.testing.assert_array_equal([d[0], x[1]], [0, 0])


def test_absent_parts_are_null(tmp_path):
    source = c_source(complete_table(ode_models.oscillator()), "token")
    for name in ("residual", "indicators", "delays", "check", "start_d", "relations"):
        assert f".{name} = NULL" in source


def test_strings_survive_c(tmp_path):
    text = 'a "quoted" \\ back?slash, Grüße ??='
    library = compile_shared(f'#include "model.h"\nconst char text[] = {c_string(text)};', tmp_path)
    raw = (ctypes.c_char * (len(text.encode()) + 1)).in_dll(library, "text")
    assert raw.value.decode() == text


def test_states_name_their_own_rows_and_whether_an_event_changes_them():
    model = complete_table(ode_models.bouncing_ball())
    row = {variable.name: k for k, variable in enumerate(model.variables)}
    assert f"ModelState states[] = {{\n    {{{row['h']}, 0}},\n    {{{row['v']}, 1}},\n}};" in c_source(model, "token")
