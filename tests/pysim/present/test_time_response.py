"""Records over time show the numbers they were given."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from pysim.present.overlay import time_response_figure
from pysim.types import BadInput, Record


def curve(figure: Figure, axes: int) -> np.ndarray:
    """Of the second record."""
    return np.asarray(figure.axes[axes].get_lines()[1].get_ydata())


def test_time_response_is_drawn_in_the_reader_s_units() -> None:
    values, names = np.array([[1e5, 1.0, 1.0], [2e5, 2.0, 2.0]]), ("p1", "u", "w")
    record = Record(np.arange(2.0), values, names, ("Pa", "1", "rad/s"))
    figure = time_response_figure({"reference": record, "FMU": record}, names)
    np.testing.assert_allclose(curve(figure, 0), [1.0, 2.0])
    np.testing.assert_allclose(curve(figure, 2), [30 / np.pi, 60 / np.pi])
    assert [axes.get_ylabel() for axes in figure.axes] == ["p1 (bar)", "u (-)", "w (rpm)"]
    with pytest.raises(BadInput, match="at least one record"):
        time_response_figure({}, ("u",))
