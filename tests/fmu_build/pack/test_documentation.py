"""The page for the reader of an FMU."""

from dataclasses import replace

from fmu_build.pack.documentation import documentation_page
from tests import ode_models


def test_page_has_text_and_variables():
    model = replace(ode_models.oscillator(), documentation="<html><p>Swings <b>freely</b>.</p></html>")
    page = documentation_page(model)
    assert "<p>Swings <b>freely</b>.</p>" in page
    assert page.count("<html") == page.count("</html>") == 1
    assert page.index("<h2>Inputs</h2>") < page.index("<td>F</td>") < page.index("<h2>Outputs</h2>")
    assert "Force of the spring &amp; damper" in page
    assert '<td>k</td><td class="number">50</td><td>N/m</td>' in page


def test_headings_without_variables_are_left_out():
    assert "Inputs" not in documentation_page(ode_models.bouncing_ball())
