"""Plain English: no private words in what people read, and short sentences in README and docs.

The rules: the subject first, one thought a sentence, the field's word for each thing.
"""

import ast
import re
import statistics
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("**/*.md"))]
CASES = [*sorted((ROOT / "validation").glob("**/README.md")), ROOT / "tests" / "known_answers" / "README.md"]
PACKAGES = ("pysim", "fmu_build")
PRIVATE = (
    r"told", r"bent", r"dents?", r"prices?", r"footprints?", r"blam(?:e|es|ed|ing)", r"ledgers?", r"staircases?",
    r"journals?", r"rulers?", r"stor(?:y|ies)",
)  # fmt: skip
_PRIVATE = re.compile(rf"\b(?:{'|'.join(PRIVATE)})\b", re.IGNORECASE)
MEDIAN, NINE_IN_TEN, FOLDS = 15, 28, 0.25  # words; words; colons and semicolons a sentence
# Words with code and tables, but without generated parts and the cells of notebooks; lines.
LONGEST_PAGE, ALL_PAGES, README_LINES = 1000, 16_000, 110
_CELLS = re.compile(r"^```\{code-cell\}.*?^```$", re.DOTALL | re.MULTILINE)


def prose(text: str) -> Iterator[str]:
    """Paragraphs and items of lists of a Markdown page: no code, tables, headings, comments or targets of links."""
    text = re.sub(r"\A---\n.*?\n---\n", "", text, flags=re.DOTALL)
    text = re.sub(r"^(`{3,}|:{3,})[^\n]*\n.*?^\1[ \t]*$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`\n]*`", "CODE", text)
    for block in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", text):
        block = re.sub(r"^\s*(?:[-*]|\d+\.) ", "", block.strip())
        if block and not block.startswith(("|", "#")):
            yield " ".join(re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", block).split())


def sentences(text: str) -> list[str]:
    """The sentences of a page; an item of a list without a full stop is one."""
    short = re.compile(r"\b(?:Eq|e\.g|i\.e|vs|cf)\.$")
    found: list[str] = []
    for block in prose(text):
        parts: list[str] = []
        for part in re.split(r"(?<=[.!?])\s+", block):
            if parts and short.search(parts[-1]):
                parts[-1] += f" {part}"
            else:
                parts.append(part)
        found += [part for part in parts if re.search(r"\w", part)]
    return found


def words(sentence: str) -> int:
    return len(re.findall(r"[\w'’.%/-]*\w[\w'’.%/-]*", sentence))


def private(text: str) -> list[str]:
    return _PRIVATE.findall(text.replace("Journal", ""))  # that of a reference has a capital letter


def read_by_people(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of docstrings, and of the texts that a module of the command line or of words has."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, documented) and ast.get_docstring(node):
            yield getattr(node, "lineno", 1), ast.get_docstring(node) or ""
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value.strip():
            yield node.lineno, re.sub(r"\{[^}]*\}", "", node.value)


def page_name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", [*PAGES, *CASES], ids=page_name)
def test_pages_have_no_private_words(page: Path) -> None:
    assert [one for one in sentences(page.read_text(encoding="utf-8")) if private(one)] == []


@pytest.mark.parametrize("package", PACKAGES)
def test_docstrings_help_and_messages_have_no_private_words(package: str) -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {text.strip()[:100]}"
        for path in sorted((ROOT / package).rglob("*.py"))
        for line, text in read_by_people(path)
        if private(text)
    ]
    assert found == []


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_sentences_are_short(page: Path) -> None:
    found = sentences(page.read_text(encoding="utf-8"))
    if len(found) < 4:
        pytest.skip("hardly any prose")
    lengths = sorted(map(words, found))
    folds = sum(len(re.findall(r"[:;](?=\s|$)", one)) for one in found) / len(found)
    ninth = lengths[int(0.9 * (len(lengths) - 1))]
    print(f"{len(found)} sentences, median {statistics.median(lengths):g}, nine in ten {ninth}, {folds:.2f} folds")
    assert statistics.median(lengths) <= MEDIAN
    assert ninth <= NINE_IN_TEN, max(found, key=words)
    assert folds <= FOLDS, [one for one in found if re.search(r"[:;](?=\s|$)", one)]


def test_pages_are_short() -> None:
    texts = {page_name(page): _CELLS.sub("", page.read_text(encoding="utf-8")) for page in PAGES}
    counts = {name: len(re.findall(r"\S*\w\S*", text)) for name, text in texts.items()}
    docs = sum(count for name, count in counts.items() if name != "README.md")
    print(f"{docs} words in {len(counts) - 1} pages; README {counts['README.md']}")
    assert {name: count for name, count in counts.items() if count > LONGEST_PAGE} == {}
    assert docs <= ALL_PAGES
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= README_LINES


def test_the_counts_see_what_they_are_to_see() -> None:
    page = "# A head: no\n\nOne two. It was told: `a; b` [here](x;y) and\ngo on.\n\n| a; b |\n\n- an item\n"
    page += "\n```\ncode; told\n```\n"
    assert sentences(page) == ["One two.", "It was told: CODE here and go on.", "an item"]
    assert words("It was told: CODE here and go on.") == 8
    assert private("The Journal of the Society told a story in its journal") == ["told", "story", "journal"]
    assert private("foretold prices") == ["prices"]
