"""Figures of the page, as Plotly takes them. Colours are names such as "@ink" that the page's look fills in."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from textwrap import wrap
from typing import Any

from pysim.identify import FREQUENCY_CRITERIA, HALF_95
from pysim.identify.accuracy import TIME_CRITERIA
from pysim.io import shown_unit

Figure = dict[str, Any]

_LEAST = 1e-3  # share of a limit below which nobody looks

CRITERIA = {c.symbol: c for c in (*FREQUENCY_CRITERIA, *TIME_CRITERIA)}
# Models from the untouched to the final one: words, colour, dash; told apart by colour and by dash.
LOOKS = {
    "measured": ("measured", "@measured", "solid"),
    "prior": ("as it is", "@prior", "dot"),
    "refit": ("refitted", "@base", "dash"),
    "last": ("with what was added", "@final", "solid"),
}


def plain(text: str) -> str:
    """A name of the user's inside a figure: shown as it is, whatever is in it."""
    return escape(text, quote=False)


def unit_text(unit: str) -> str:
    """A unit, as `shown_unit` gives it, behind a name."""
    return {"": "–", "-": "–", "deg": "°"}.get(unit, plain(unit))


def figure(data: Sequence[Mapping[str, Any]], **layout: Any) -> Figure:
    """With the one look of all figures."""
    base = {
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"family": "inherit", "size": 12.5, "color": "@ink"},
        "margin": {"l": 62, "r": 18, "t": 34, "b": 46},
        "hovermode": "closest",
        "hoverlabel": {"bgcolor": "@raised", "bordercolor": "@line", "font": {"color": "@ink", "size": 12.5}},
        "legend": {"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "bgcolor": "rgba(0,0,0,0)"},
        "showlegend": True,
        "modebar": {"bgcolor": "rgba(0,0,0,0)", "color": "@quiet", "activecolor": "@ink"},
        "uirevision": "keep",
    }
    return {"data": list(data), "layout": {**base, **layout}}


def axis(title: str = "", **more: Any) -> dict[str, Any]:
    """A quiet axis."""
    look = {"gridcolor": "@grid", "linecolor": "@line", "tickcolor": "@line", "zeroline": False, "automargin": True}
    return {**look, "title": {"text": title, "standoff": 8, "font": {"size": 12.5}}, **more}


# --- the falling error ----------------------------------------------------------------------------------------------


def step_name(step: str) -> str:
    """A step of the ledger as people call it."""
    return {"prior": "as it is", "refit": "refitted"}.get(step, f"+ {step}")


def staircase_figure(steps: Sequence[Mapping[str, Any]], *, doing: str = "") -> Figure:
    """The error over noise, step by step, fitted and held out; what is being worked on stands last, empty.

    Args:
        steps: of the ledger.
        doing: name of the step that is being found; "" where nothing runs.
    """
    names = [plain(step_name(s["step"])) for s in steps] + ([f"<i>{_wrapped(doing)} …</i>"] if doing else [])
    places = list(range(len(names)))
    lines = {
        "fitted": ([s["fit"] for s in steps], "@final", "solid", "circle", -0.16),
        "held out": ([s["validate"] for s in steps], "@base", "dash", "square", 0.16),
    }
    known = [v for values, *_ in lines.values() for v in values if v]
    low, high = min([0.6, *(0.62 * v for v in known)]), max([3.0, *(1.9 * v for v in known)])
    data: list[dict[str, Any]] = []
    notes: list[dict[str, Any]] = []
    for name, (values, colour, dash, symbol, _) in lines.items():
        if any(v is not None for v in values):
            data += _stairs(name, values, colour, dash, symbol)
    for k, step in enumerate(steps):
        pair = sorted(((step["fit"], "@final"), (step["validate"], "@base")), key=lambda p: -(p[0] or 0.0))
        for rank, (value, colour) in enumerate(p for p in pair if p[0]):
            notes.append(_number(k, value, colour, above=rank == 0))
    noise = {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": low, "y1": 1, "fillcolor": "@band"}
    shapes = [{**noise, "line": {"width": 0}, "layer": "below"}]
    if doing:
        begin = len(steps) - 0.5
        box = {"type": "rect", "x0": begin + 0.06, "x1": begin + 0.94, "yref": "paper", "y0": 0.02, "y1": 0.98}
        shapes.append({**box, "line": {"color": "@quiet", "width": 1.2, "dash": "dot"}, "fillcolor": "@raised"})
    notes.append(
        {"xref": "paper", "x": 0.004, "y": math.log10(1.0), "text": "noise alone", "showarrow": False}
        | {"xanchor": "left", "yanchor": "top", "font": {"size": 11.5, "color": "@quiet"}}
    )
    ticks = [d * 10.0**p for p in range(-1, 6) for d in (1, 2, 5) if low <= d * 10.0**p <= high]
    return figure(
        data,
        xaxis=axis(range=[-0.5, max(len(names), 3) - 0.5], tickvals=places, ticktext=names, showgrid=False),
        yaxis=axis(
            "Error over noise (–)", type="log", range=[math.log10(low), math.log10(high)], tickvals=ticks,
            ticktext=[f"{t:g}" for t in ticks],
        ),
        shapes=shapes,
        annotations=notes,
        margin={"l": 62, "r": 18, "t": 34, "b": 30},
    )  # fmt: skip


def _wrapped(words: str) -> str:
    """In lines that fit below a step."""
    return "<br>".join(plain(line) for line in wrap(words, 20))


def _stairs(name: str, values: Sequence[float | None], colour: str, dash: str, symbol: str) -> list[dict[str, Any]]:
    """A level per step, and a mark in its middle."""
    x = [edge for k in range(len(values)) for edge in (k - 0.5, k + 0.5)]
    y = [v for v in values for _ in range(2)]
    line = {"color": colour, "width": 3, "dash": dash}
    marks = {"color": colour, "size": 9, "symbol": symbol}
    level = {"x": x, "y": y, "mode": "lines", "line": line, "name": name, "hoverinfo": "skip", "showlegend": False}
    hover = f"{name}: %{{y:.3g}} times the noise<extra></extra>"
    both = {"mode": "lines+markers", "line": line, "marker": marks, "name": name, "hovertemplate": hover}
    return [
        level,
        {**both, "x": [None, *range(len(values))], "y": [None, *values], "mode": "markers"},
    ]


def _number(k: int, value: float, colour: str, *, above: bool) -> dict[str, Any]:
    text = f"<b>{value:.3g}</b>" if value >= 10 else f"<b>{value:.2f}</b>"
    place = {"x": k, "y": math.log10(value), "yshift": 15 if above else -15, "showarrow": False}
    return {**place, "text": text, "font": {"color": colour, "size": 13}}


# What is shown of a criterion: its colour by what is compared, its dash and mark by whether mean or maximum.
_GROUPS = {"E_M": "@final", "E_P": "@base", "E_t": "@measured"}


def criteria_figure(steps: Sequence[Mapping[str, Any]]) -> Figure:
    """Worst value of every criterion of thesis Tables 1.3 and 1.4, step by step, over its limit, which is a line.

    Args:
        steps: of the ledger; those without criteria leave a gap.
    """
    symbols = [symbol for symbol in CRITERIA if any(symbol in step["criteria"] for step in steps)]
    data: list[dict[str, Any]] = []
    for symbol in symbols:
        one = CRITERIA[symbol]
        values = [step["criteria"].get(symbol) for step in steps]
        told = ["" if v is None else f"{one.name} {v:.3g} of {one.limit:g} {one.unit}" for v in values]
        shares = [None if v is None else max(v / one.limit, _LEAST) for v in values]
        colour = _GROUPS[symbol.partition(" ")[0]]
        mean = symbol.endswith("mean")
        look = {"color": colour, "width": 2.5, "dash": "solid" if mean else "dash"}
        x = [edge for k in range(len(steps)) for edge in (k - 0.5, k + 0.5)]
        y = [v for v in shares for _ in range(2)]
        mark = {"color": colour, "size": 8, "symbol": "circle" if mean else "square"}
        group = {"legendgroup": symbol, "name": one.name.replace(" deviation", "")}
        data.append({"x": x, "y": y, "mode": "lines", "line": look, "hoverinfo": "skip", "showlegend": False, **group})
        middle = {"x": [None, *range(len(steps))], "y": [None, *shares], "text": ["", *told]}
        data.append(
            {**middle, "mode": "markers", "line": look, "marker": mark, "hovertemplate": "%{text}<extra></extra>"}
            | group
        )
    known = [v for trace in data for v in trace["y"] if v is not None]
    low, high = min([0.3, *(0.6 * v for v in known)]), max([3.0, *(1.7 * v for v in known)])
    limit = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 1, "y1": 1, "line": {"color": "@bad", "width": 2}}
    words = {"xref": "paper", "x": 0.996, "y": 0.0, "text": "limit", "showarrow": False, "xanchor": "right"}
    names = [plain(step_name(step["step"])) for step in steps]
    ticks = [d * 10.0**p for p in range(-4, 6) for d in (1, 3) if low <= d * 10.0**p <= high]
    return figure(
        data,
        xaxis=axis(
            range=[-0.5, max(len(names), 3) - 0.5], tickvals=list(range(len(names))), ticktext=names, showgrid=False
        ),
        yaxis=axis(
            "Worst value over its limit (–)", type="log", range=[math.log10(low), math.log10(high)], tickvals=ticks,
            ticktext=[f"{t:g}" for t in ticks],
        ),
        shapes=[limit],
        annotations=[{**words, "yanchor": "bottom", "font": {"size": 12, "color": "@bad"}}],
        margin={"l": 62, "r": 18, "t": 50, "b": 30},
    )  # fmt: skip


# --- records ---------------------------------------------------------------------------------------------------------


def overlay_figure(
    names: Sequence[str], units: Sequence[str], models: Sequence[tuple[str, str]], traces: Sequence[Mapping[str, Any]]
) -> Figure:
    """Each signal as measured and as the models have it, what each leaves below; all panels share the time axis.

    Args:
        names, units: of the signals.
        models: key of LOOKS and words of each model.
        traces: as `signal_traces` gives them.
    """
    layout: dict[str, Any] = {"xaxis": axis("Time (s)", showgrid=True)}
    heights = [weight for _ in names for weight in ((3.0, 1.6) if models else (3.0,))]
    gap = 0.045
    free, top = 1.0 - gap * (len(heights) - 1), 1.0
    for k, weight in enumerate(heights):
        size = free * weight / sum(heights)
        name = names[k // 2] if models else names[k]
        unit = units[k // 2] if models else units[k]
        residual = bool(models) and k % 2 == 1
        title = "left over<br>(noise s.d.)" if residual else f"{plain(name)} ({unit_text(unit)})"
        low = max(top - size, 0.0)
        layout[f"yaxis{k + 1 if k else ''}"] = axis(title, domain=[low, top], anchor="x")
        top -= size + gap
    last = len(heights)
    layout["xaxis"]["anchor"] = f"y{last}" if last > 1 else "y"
    bands = [
        {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "yref": f"y{2 * k + 2}", "y0": -HALF_95, "y1": HALF_95}
        | {"fillcolor": "@band", "line": {"width": 0}, "layer": "below"}
        for k in range(len(names) if models else 0)
    ]
    return figure(traces, **layout, shapes=bands, dragmode="zoom", margin={"l": 74, "r": 18, "t": 30, "b": 46})


def signal_trace(key: str, words: str, panel: int, x: Any, y: Any, *, legend: bool, unit: str = "") -> dict[str, Any]:
    """One line of an overlay.

    Args:
        key: of LOOKS.
        panel: from 1, from above.
    """
    _, colour, dash = LOOKS[key]
    look = {"color": colour, "width": 1.4 if key == "measured" else 1.8, "dash": dash}
    hover = f"{plain(words)}: %{{y:.4g}} {unit_text(unit)} at %{{x:.4g}} s<extra></extra>"
    place = {"xaxis": "x", "yaxis": f"y{panel}" if panel > 1 else "y"}
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": plain(words), "line": look, **place} | {
        "legendgroup": key, "showlegend": legend, "hovertemplate": hover,
    }  # fmt: skip


# --- frequency responses ---------------------------------------------------------------------------------------------


def bode_figure(response: Mapping[str, Any], models: Sequence[tuple[str, str, Mapping[str, Any]]]) -> Figure:
    """Magnitude above phase, measured with the band of thesis Table 1.3 around it, and the models.

    Args:
        response: measured, `frequency` Hz, `gain`, `phase` rad.
        models: key of LOOKS, words, and the simulated `gain` and `phase`.
    """
    f = response["frequency"]
    limits = (FREQUENCY_CRITERIA[1].limit, FREQUENCY_CRITERIA[3].limit)
    measured = response["measured"]
    data: list[dict[str, Any]] = []
    for panel, limit in enumerate(limits):
        y = _bode(measured, panel)
        place = {"xaxis": "x", "yaxis": "y2" if panel else "y"}
        band = {"x": [*f, *reversed(f)], "y": [v + limit for v in y] + [v - limit for v in reversed(y)]}
        told = f"± {limits[0]:g} dB, ± {limits[1]:g}° (Table 1.3)"
        look = {"fill": "toself", "fillcolor": "@band", "line": {"width": 0}, "mode": "lines", "hoverinfo": "skip"}
        data.append({**band, **look, **place, "name": told, "showlegend": not panel, "legendgroup": "band"})
        unit = "°" if panel else "dB"
        for key, words, side in [("measured", "measured", measured), *models]:
            _, colour, dash = LOOKS[key]
            values = _bode(side, panel)
            if panel:
                turns = round((values[0] - y[0]) / 360)
                values = [v - 360 * turns for v in values]
            line = {"color": colour, "width": 2, "dash": dash}
            marks = {"mode": "lines+markers", "marker": {"size": 6, "color": colour}} if key == "measured" else {}
            hover = f"{plain(words)}: %{{y:.2f}} {unit} at %{{x:g}} Hz<extra></extra>"
            data.append({"x": f, "y": values, "mode": "lines", "line": line, "name": plain(words), **marks, **place} | {
                "legendgroup": key, "showlegend": not panel, "hovertemplate": hover,
            })  # fmt: skip
    ticks = [t for t in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200) if f[0] <= t <= f[-1]]
    return figure(
        data,
        xaxis=axis("Frequency (Hz)", type="log", tickvals=ticks, ticktext=[f"{t:g}" for t in ticks], anchor="y2"),
        yaxis=axis("Magnitude (dB)", domain=[0.53, 1]),
        yaxis2=axis("Phase (°)", domain=[0, 0.47], dtick=45 if max(map(abs, _bode(measured, 1))) > 60 else None),
    )


def _bode(side: Mapping[str, Any], panel: int) -> list[float]:
    """Magnitude relative to the lowest frequency in dB (panel 0), or phase in degrees (panel 1)."""
    if panel:
        return [math.degrees(v) for v in side["phase"]]
    return [20 * math.log10(v / side["gain"][0]) for v in side["gain"]]


# --- where it fails --------------------------------------------------------------------------------------------------


def map_figure(
    rows: Sequence[str],
    columns: Sequence[str],
    values: Sequence[Sequence[float | None]],
    title: str,
    *,
    scale: bool = True,
) -> Figure:
    """Root-mean-square residual over noise of every test; numbers stand in the cells, so that no colour is needed.

    Args:
        values: per row, per column; None where no such test was run.
        title: of the columns.
        scale: whether a scale of the colours stands beside it.
    """
    shown = [[None if v is None else math.log10(max(v, 1.0)) for v in row] for row in values]
    text = [["" if v is None else f"{v:.1f}" if v < 99.5 else f"{v:.0f}" for v in row] for row in values]
    high = max([10.0, *(v for row in values for v in row if v is not None)])
    ticks = [t for t in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= high]
    bar: dict[str, Any] = {
        "title": {"text": "times noise", "side": "right"},
        "tickvals": [math.log10(t) for t in ticks],
    }
    bar |= {"ticktext": [f"{t:g}" for t in ticks], "thickness": 10, "outlinewidth": 0, "len": 1}
    heat: dict[str, Any] = {
        "type": "heatmap",
        "x": [plain(c) for c in columns],
        "y": [plain(r) for r in rows],
        "z": shown,
    }
    heat |= {"text": text, "texttemplate": "%{text}", "zmin": 0, "zmax": math.log10(high), "colorscale": "@heat"}
    heat |= {
        "colorbar": bar,
        "xgap": 2,
        "ygap": 2,
        "hoverongaps": False,
        "showscale": scale,
        "textfont": {"size": 11.5},
    }
    heat |= {"hovertemplate": "%{y}<br>%{x}: %{text} times the noise<extra></extra>"}
    return figure(
        [heat],
        xaxis=axis(title, type="category", showgrid=False, side="bottom"),
        yaxis=axis(type="category", autorange="reversed", showgrid=False, ticksuffix="  "),
        margin={"l": 40, "r": 10, "t": 10, "b": 46},
        showlegend=False,
    )


def missing_figure(missing: Mapping[str, Any]) -> Figure:
    """The missing term over what it depends on, with its 95 percent band."""
    shape = missing["shape"]
    unit_in, scale_in = shown_unit(shape["argument_unit"])
    unit_out, scale_out = shown_unit(shape["unit"])
    x = [v * scale_in for v in shape["argument"]]
    sides = {name: [v * scale_out for v in shape[name]] for name in ("value", "low", "high")}
    band: dict[str, Any] = {"x": [*x, *reversed(x)], "y": [*sides["high"], *reversed(sides["low"])], "fill": "toself"}
    band |= {"fillcolor": "@finalband", "line": {"width": 0}, "name": "95 % band", "hoverinfo": "skip", "mode": "lines"}
    line: dict[str, Any] = {"x": x, "y": sides["value"], "mode": "lines+markers", "name": "what would close the gap"}
    line |= {"line": {"color": "@final", "width": 2.5}, "marker": {"size": 6, "color": "@final"}}
    zero = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 0, "y1": 0, "line": {"color": "@line", "width": 1}}
    return figure(
        [band, line],
        xaxis=axis(f"{plain(missing['depends_on'])} ({unit_text(unit_in)})"),
        yaxis=axis(f"missing at {plain(missing['slot'])} ({unit_text(unit_out)})"),
        shapes=[zero],
    )


def parameters_figure(rows: Sequence[Mapping[str, Any]]) -> Figure:
    """Parameters before and after with their intervals, each on a scale between its bounds.

    Args:
        rows: `name`, `lower`, `upper`, and `before` and `after` as (value, low, high) or None.
    """
    data: list[dict[str, Any]] = []
    names = [plain(row["name"]) for row in rows]
    for key, words, colour, symbol, shift in (
        ("before", "before", "@base", "square", -0.17),
        ("after", "after", "@final", "circle", 0.17),
    ):
        own = [(k, row, row[key]) for k, row in enumerate(rows) if row.get(key)]
        if not own:
            continue
        share = [[_share(v, row["lower"], row["upper"]) for v in three] for _, row, three in own]
        error = {"type": "data", "symmetric": False, "thickness": 1.8, "width": 3, "color": colour}
        error |= {"array": [s[2] - s[0] for s in share], "arrayminus": [s[0] - s[1] for s in share]}
        hover = [f"{names[k]} {words}: {t[0]:.4g} ({t[1]:.4g} to {t[2]:.4g})" for k, _, t in own]
        data.append(
            {"x": [s[0] for s in share], "y": [k + shift for k, *_ in own], "mode": "markers", "name": words}
            | {"marker": {"color": colour, "size": 8, "symbol": symbol}, "error_x": error, "text": hover}
            | {"hovertemplate": "%{text}<extra></extra>"}
        )
    return figure(
        data,
        xaxis=axis("Place between its bounds (%)", range=[-3, 103]),
        yaxis=axis(tickvals=list(range(len(names))), ticktext=names, autorange="reversed", ticksuffix="  "),
        margin={"l": 40, "r": 18, "t": 30, "b": 46},
    )


def _share(value: float, lower: float, upper: float) -> float:
    """Percent of the way from the lower to the upper bound."""
    return 100 * (min(max(value, lower), upper) - lower) / (upper - lower)
