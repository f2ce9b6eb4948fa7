"""Count the order of the house: ``python docs/tools/house_counts.py [TREE]``; ``--write`` renews docs/house.md.

Every figure is counted in the files that git tracks in a tree, so that two versions can stand side by side.
"""

from __future__ import annotations

import argparse
import ast
import re
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "house.md"
BEGIN, END = "<!-- house:begin -->\n", "<!-- house:end -->\n"
BEFORE = "b7aec9b"
WRITTEN_SINCE = {"elastic", "electric", "elements", "fmu", "shaft", "thermal"}  # rooms that are new to the core
_FACES = ("cli", "gui")
_DOORS = ("api", "domain", "views")  # rooms of the core that faces may import
_DECLARED = "FloatArray = " + "NDArray"
_OURS = ("lambda_core", "plugins", "db", "gui", "cli")


class Tree:
    """The Python files of a checkout."""

    def __init__(self, root: Path) -> None:
        self.root = root
        listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout
        self.names = listed.splitlines()

    def files(self, *rooms: str, suffix: str = ".py") -> dict[str, str]:
        """Return the text of every file below some folders, by name."""
        heads = tuple(f"{room}/" for room in rooms)
        wanted = [name for name in self.names if name.endswith(suffix) and name.startswith(heads)]
        return {name: (self.root / name).read_text(encoding="utf-8") for name in wanted if (self.root / name).exists()}

    @property
    def core(self) -> dict[str, str]:
        """The modules of the core."""
        return self.files("lambda_core")


def _lines(texts: dict[str, str], pattern: str) -> int:
    return sum(bool(re.search(pattern, line)) for text in texts.values() for line in text.splitlines())


def _with(texts: dict[str, str], pattern: str) -> int:
    return sum(bool(re.search(pattern, text)) for text in texts.values())


def _index_reads(tree: Tree) -> int:
    return _lines(tree.core, r"\w\[[A-Z]{1,2}_[A-Z0-9_]+")


def _parameters(tree: Tree) -> int:
    rooms = ("plugins", "examples", "docs", "lambda_core")
    pages = {name: text for suffix in (".py", ".md") for name, text in tree.files(*rooms, suffix=suffix).items()}
    return _lines({name: text for name, text in pages.items() if name != "docs/house.md"}, r"par\[[0-9]+\]")


def _imports(text: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _past_the_api(tree: Tree) -> int:
    faces = tree.files(*_FACES)
    found = [name.split(".") for text in faces.values() for name in _imports(text) if name.startswith("lambda_core.")]
    return sum(name[1] not in _DOORS for name in found)


def _lines_of_core(tree: Tree) -> int:
    return sum(len(text.splitlines()) for text in tree.core.values())


def _lines_of_before(tree: Tree) -> int:
    texts = {name: text for name, text in tree.core.items() if name.split("/")[1] not in WRITTEN_SINCE}
    return sum(len(text.splitlines()) for text in texts.values())


def _statements(tree: Tree) -> int:
    """Return the lines of the core that hold code: no blank line, comment or docstring."""
    return sum(_code_lines(text) for text in tree.core.values())


def _code_lines(text: str) -> int:
    words: set[int] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            words.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    lines = enumerate(text.splitlines(), 1)
    return sum(bool(line.strip()) and not line.strip().startswith("#") and n not in words for n, line in lines)


def _paper(tree: Tree) -> int:
    return sum(len(text.splitlines()) for name, text in tree.core.items() if "/reproduce/" in name)


def _functions(tree: Tree) -> Iterator[int]:
    for text in tree.files(*_OURS).values():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                begin = node.body[1 if ast.get_docstring(node) and len(node.body) > 1 else 0].lineno
                yield (node.end_lineno or begin) - begin + 1


def _longest(tree: Tree) -> int:
    return max(len(text.splitlines()) for text in tree.files(*_OURS).values())


def _untyped(tree: Tree) -> int:
    """Return how many functions of the core have an argument without a type: those that Numba types."""
    count = 0
    for text in tree.core.values():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef):
                arguments = [a for a in node.args.args if a.arg not in ("self", "cls")]
                count += any(a.annotation is None for a in arguments)
    return count


@dataclass(frozen=True)
class Figure:
    """One thing that is counted, what was asked of it, and what stands against that."""

    what: str
    asked: str
    count: Callable[[Tree], int]
    most: int | None = None
    reason: str = ""


FIGURES = (
    Figure("lines of the core that read an array by a constant that stands for a name", "0", _index_reads, 0),
    Figure("lines that read a law's parameters by position", "0", _parameters, 0),
    Figure(
        "files that declare the type of an array of floats", "1",
        lambda tree: _with(tree.files(*_OURS, "tests", "benchmarks"), _DECLARED), 1,
    ),
    Figure(
        "files of the core that know the role `elastic_hysteresis`", "2",
        lambda tree: _with(tree.core, '"elastic_hysteresis"'), 2,
        "its declaration, and the names of what compiled code keeps of a fault",
    ),
    Figure(
        "files that start processes", "2",
        lambda tree: _with(tree.files("lambda_core", "gui", "plugins"), r"ProcessPoolExecutor|subprocess\.Popen"), 3,
        "batches, the compile step, and the check of plugins, whose process is killed when a law loops",
    ),
    Figure("imports of the faces past api, domain and views", "0", _past_the_api, 0),
    Figure("lines of the paper inside the core", "0", _paper, 0),
    Figure("lines of api.py", "<= 120", lambda tree: _api(tree), 120),
    Figure("lines of the longest module", "<= 500", _longest, 500),
    Figure("lines of the longest function below its docstring", "", lambda tree: max(_functions(tree))),
    Figure(
        "functions of the core with arguments that only Numba types", "0", _untyped, None,
        "Python's types cannot say what Numba infers: each could only become `Any`",
    ),
    Figure(
        "lines of the core", "<= 24 000", _lines_of_core, None, "see below",
    ),
    Figure("of these lines, outside the new elastic, electric, elements, fmu, shaft, thermal", "", _lines_of_before),
    Figure("of all these lines, with code: no blank line, comment, docstring", "", _statements),
)  # fmt: skip


def _api(tree: Tree) -> int:
    return sum(len(text.splitlines()) for name, text in tree.core.items() if re.match(r"lambda_core/api[./]", name))


def counted(tree: Tree) -> list[int]:
    """Return every figure of a tree."""
    return [figure.count(tree) for figure in FIGURES]


def table(now: list[int], before: list[str]) -> str:
    """Return the table of the page."""
    lines = ["| counted | asked | before | now | |", "|---|---|---|---|---|"]
    for figure, value, old in zip(FIGURES, now, before, strict=True):
        missed = figure.reason and not (figure.asked.isdigit() and value <= int(figure.asked))
        note = f"missed: {figure.reason}" if missed else ""
        lines.append(f"| {figure.what} | {figure.asked} | {old} | {value} | {note} |")
    return "\n".join([*lines, ""])


def before_on_page() -> list[str]:
    """Return the column of the version before, as the page has it."""
    rows = PAGE.read_text(encoding="utf-8").partition(BEGIN)[2].partition(END)[0].splitlines()[2:]
    return [row.split("|")[3].strip() for row in rows if row.startswith("|")]


def main() -> None:
    """Print the figures of a tree, or renew the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tree", nargs="?", type=Path, default=ROOT, help="a checkout, default this one")
    parser.add_argument("--before", type=Path, metavar="TREE", help=f"checkout of {BEFORE}, if not as on the page")
    parser.add_argument("--write", action="store_true", help="renew docs/house.md")
    options = parser.parse_args()
    before = [str(n) for n in counted(Tree(options.before))] if options.before else before_on_page()
    text = table(counted(Tree(options.tree)), before)
    if options.write:
        page = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(page.partition(BEGIN)[0] + BEGIN + text + END + page.partition(END)[2], encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
