"""Parts of the reference that the program knows better than a writer: commands, settings, effects, units, checks."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]


def table(heads: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    """A Markdown table."""

    def line(cells: Iterable[object]) -> str:
        return "| " + " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"

    heads = list(heads)
    return "\n".join([line(heads), line("---" for _ in heads), *map(line, rows)]) + "\n"


def code(text: object) -> str:
    """Text as it is typed; nothing for none."""
    return f"`{text}`" if str(text) else ""


def first_sentence(text: str | None) -> str:
    """The first sentence of a docstring, on one line."""
    return re.split(r"(?<=[.:])\s", " ".join((text or "").split()), maxsplit=1)[0].rstrip(".:")


def commands(here: Path) -> str:
    """Every command with its options, as `--help` has them."""
    from pysim.cli.main import registry

    parts = []
    for command in registry().values():
        parts += [_command(command, f"pysim {command.name}", "##")]
        parts += [_command(part, f"pysim {command.name} {part.name}", "###") for part in command.parts]
    return "\n".join(parts)


def _command(command: object, words: str, mark: str) -> str:
    from pysim.cli.command import Command

    assert isinstance(command, Command)
    rows = []
    for option in command.options:
        name = option.key if option.positional else option.flags[-1]
        value = option.metavar or ("" if option.positional else "\\|".join(option.allowed))
        shown = f"{name} {value}".strip() if not option.positional else (option.metavar or name)
        plain = isinstance(option.default, int | float | str) and option.default != ""
        rows.append((code(shown.replace("\\|", "|")), option.about, code(option.default) if plain else ""))
    options = table(("option", "what it does", "default"), rows) if rows else ""
    return f"{mark} {words}\n\n{command.about}\n\n{options}"


def effects(here: Path) -> str:
    """A card for each effect of the catalogue: its law, its curve and its parameters."""
    from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue

    found = read_catalogue(STANDARD_LIBRARY)
    parts = []
    for model in ("Pump.FreeGreyBox", "LoadCircuit.OpenTestBench"):
        name = f"HydraulicTestBench.{model}"
        cards = [_card(effect, name, here) for effect in fitting(found, name, [STANDARD_LIBRARY])]
        parts.append(f"## Effects of {model}\n\n:::::{{container}} cards\n" + "\n".join(cards) + ":::::\n")
    return "\n".join(parts)


def _card(effect: object, model: str, here: Path) -> str:
    from pysim.types import Effect

    assert isinstance(effect, Effect)
    picture = _picture(effect, model, here)
    law = f"```modelica\n{effect.law.strip()}\n```\n" if effect.law and len(effect.law) < 300 else ""
    rows = [
        (code(p.name), f"{p.min:g} to {p.max:g}", f"{p.nominal:g}", p.unit if p.unit != "1" else "-")
        for p in effect.parameters
    ]
    numbers = table(("parameter", "range", "usual", "unit"), rows)
    about = f"{effect.description.replace(f' ({effect.name})', '')}. Slot `{effect.slot}`."
    head = f":::{{container}} title\n{effect.name}\n:::"
    return f"::::{{container}} card\n{head}\n{about}\n\n{picture}{law}\n{numbers}::::\n"


def _picture(effect: object, model: str, here: Path) -> str:
    """The curve of an effect's law; nothing for a law that a few strokes cannot show."""
    from pysim.effects import STANDARD_LIBRARY, law_constants, law_sketch, slots
    from pysim.present.model import sketch_figure
    from pysim.present.render import render
    from pysim.types import Effect

    assert isinstance(effect, Effect)
    slot = next(one for one in slots(model, [STANDARD_LIBRARY]) if one.name == effect.slot)
    drawn = law_sketch(effect, slot, law_constants(effect, [STANDARD_LIBRARY]), {})
    if drawn is None:
        return ""
    folder = here / "generated"
    folder.mkdir(exist_ok=True)
    (folder / f"{effect.name}.png").write_bytes(render(sketch_figure(drawn, effect.name), "png"))
    return f"![{effect.name}: {drawn.words}](/generated/{effect.name}.png)\n\n"


def settings(here: Path) -> str:
    """Every number of the methods, with its unit, its meaning and its source."""
    from pysim.diagnosis import settings as diagnosis
    from pysim.identify.data_check import settings as data_check
    from pysim.identify.greybox import settings as greybox
    from pysim.types.setting import settings_of

    parts = []
    for module in (data_check, greybox, diagnosis):
        for name, kind in vars(module).items():
            if inspect.isclass(kind) and kind.__module__ == module.__name__:
                rows = [(code(s.name), s.value, s.unit, s.meaning, s.source) for s in settings_of(kind())]
                heads = ("setting", "value", "unit", "meaning", "source")
                about = f"{first_sentence(kind.__doc__)} (`{module.__name__}`)."
                parts.append(f"## {name}\n\n{about}\n\n{table(heads, rows)}")
    return "\n".join(parts)


def record_kinds(here: Path) -> str:
    """The kinds of logs that a data set may hold."""
    from pysim.types.record_kind import KINDS

    rows = [
        (code(kind.name), kind.about, ", ".join(map(code, kind.needs)) or "nothing", kind.compared.value)
        for kind in KINDS.values()
    ]
    return table(("kind", "what it is", "must give", "compared by"), rows)


def units(here: Path) -> str:
    """Every unit that a file may use, by the SI unit it becomes."""
    from pysim.types import SYNONYMS, UNITS, in_si

    def kin(si: str, spelled: bool) -> str:
        return " ".join(code(one) for one in UNITS if in_si(one)[0] == si and (one in SYNONYMS) == spelled)

    known = dict.fromkeys(in_si(one)[0] for one in UNITS)
    return table(("in SI", "in files", "also written"), [(code(si), kin(si, False), kin(si, True)) for si in known])


def forbidden_calls(here: Path) -> str:
    """Calls out of order that an FMU has to refuse."""
    from pysim.fmu_check.call_order import abuse_checks

    return "\n".join(f"- {name.partition(': ')[2]}" for name in abuse_checks())


def packages(here: Path) -> str:
    """The folders of `pysim` and what each is for."""
    import pysim

    def described() -> Iterator[tuple[str, str]]:
        for folder in sorted(Path(pysim.__file__).parent.iterdir()):
            head = folder / "__init__.py"
            if head.exists():
                text = re.match(r'"""(.*?)"""', head.read_text(encoding="utf-8"), re.DOTALL)
                yield code(f"pysim.{folder.name}"), first_sentence(text[1]) if text else ""

    return table(("package", "what it is for"), described())


def _included(path: Path) -> str:
    """A page of the repository without its heading, its links as text."""
    text = path.read_text(encoding="utf-8").partition("\n")[2]
    return re.sub(r"(?<!!)\[([^\]]+)\]\([^)\s]+\)", r"\1", text)


def subset(here: Path) -> str:
    """What of Modelica is compiled."""
    return _included(ROOT / "fmu_build" / "SUBSET.md")


def results(here: Path) -> str:
    """Every claim that holds or fails, as recorded."""
    return _included(ROOT / "validation" / "RESULTS.md")


PARTS: dict[str, Callable[[Path], str]] = {
    "commands": commands,
    "effects": effects,
    "settings": settings,
    "record-kinds": record_kinds,
    "units": units,
    "forbidden-calls": forbidden_calls,
    "packages": packages,
    "subset": subset,
    "results": results,
}
