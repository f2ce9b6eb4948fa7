"""Count code metrics: ``python docs/tools/code_metrics.py [TREE]``; ``--write`` renews docs/code-metrics.md.

Every figure is counted in the files that git tracks in a tree, so that two versions can be compared.
"""

from __future__ import annotations

import argparse
import ast
import re
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "code-metrics.md"
BEGIN, END = "<!-- metrics:begin -->\n", "<!-- metrics:end -->\n"
_FACES = ("cli", "gui")
_DOORS = ("api", "domain", "views")  # packages of the core that user interfaces may import
_DECLARED = "FloatArray = " + "NDArray"
_OURS = ("lambda_core", "plugins", "db", "gui", "cli")


class Tree:
    """The Python files of a checkout."""

    def __init__(self, root: Path) -> None:
        self.root = root
        listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout
        self.names = listed.splitlines()

    def files(self, *folders: str, suffix: str = ".py") -> dict[str, str]:
        """Return every file's text by name.

        They are below some folders.
        """
        heads = tuple(f"{folder}/" for folder in folders)
        wanted = [name for name in self.names if name.endswith(suffix) and name.startswith(heads)]
        return {name: (self.root / name).read_text(encoding="utf-8") for name in wanted if (self.root / name).exists()}

    @property
    def core(self) -> dict[str, str]:
        """The modules of the core."""
        return self.files("lambda_core")


@cache
def _nodes(text: str) -> tuple[ast.AST, ...]:
    """Return the nodes of a module, read once."""
    return tuple(ast.walk(ast.parse(text)))


def _lines(texts: dict[str, str], pattern: str) -> int:
    return sum(bool(re.search(pattern, line)) for text in texts.values() for line in text.splitlines())


def _with(texts: dict[str, str], pattern: str) -> int:
    return sum(bool(re.search(pattern, text)) for text in texts.values())


def _index_reads(tree: Tree) -> int:
    return _lines(tree.core, r"\w\[[A-Z]{1,2}_[A-Z0-9_]+")


def _parameters(tree: Tree) -> int:
    folders = ("plugins", "examples", "docs", "lambda_core")
    pages = {name: text for suffix in (".py", ".md") for name, text in tree.files(*folders, suffix=suffix).items()}
    return _lines({name: text for name, text in pages.items() if name != "docs/code-metrics.md"}, r"par\[[0-9]+\]")


def _imports(text: str) -> Iterator[str]:
    for node in _nodes(text):
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _past_the_api(tree: Tree) -> int:
    faces = tree.files(*_FACES)
    found = [name.split(".") for text in faces.values() for name in _imports(text) if name.startswith("lambda_core.")]
    return sum(name[1] not in _DOORS for name in found)


def _lines_of_core(tree: Tree) -> int:
    return sum(len(text.splitlines()) for text in tree.core.values())


def _statements(tree: Tree) -> int:
    """Return the core's code lines.

    No blank line, comment or docstring.
    """
    return sum(_code_lines(text) for text in tree.core.values())


def _code_lines(text: str) -> int:
    words: set[int] = set()
    for node in _nodes(text):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            words.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    lines = enumerate(text.splitlines(), 1)
    return sum(bool(line.strip()) and not line.strip().startswith("#") and n not in words for n, line in lines)


def _functions(tree: Tree) -> Iterator[int]:
    for text in tree.files(*_OURS).values():
        for node in _nodes(text):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                begin = node.body[1 if ast.get_docstring(node) and len(node.body) > 1 else 0].lineno
                yield (node.end_lineno or begin) - begin + 1


def _longest(tree: Tree) -> int:
    return max(len(text.splitlines()) for text in tree.files(*_OURS).values())


def _untyped(tree: Tree) -> int:
    """Return the core's functions with untyped arguments.

    Their number: Numba types them.
    """
    count = 0
    for text in tree.core.values():
        for node in _nodes(text):
            if isinstance(node, ast.FunctionDef):
                arguments = [a for a in node.args.args if a.arg not in ("self", "cls")]
                count += any(a.annotation is None for a in arguments)
    return count


def _kinds_outside(tree: Tree) -> int:
    """Return the files that test a bearing kind.

    Their number outside the elements.
    """
    texts = tree.files("lambda_core", "db", "gui", "cli", "plugins/lambda_plugins")
    names = "deep groove|angular contact|four-point|double row|self-aligning|NU|NJ|NUP|NCF|tapered|needle"
    kinds = rf'four_point|self_aligning|SPHERICAL|(?:[!=]=|\bin) \(?"(?:{names})"'
    return _with({name: text for name, text in texts.items() if "/elements/" not in name}, kinds)


def _engines(tree: Tree) -> int:
    return _with(tree.core, r"(?m)^class [A-Za-z]*Engine\b")


@dataclass(frozen=True)
class Figure:
    """One figure with its limit.

    And the reason where it is above the limit.
    """

    what: str
    limit: int | None
    count: Callable[[Tree], int]
    reason: str = ""


FIGURES = (
    Figure("lines of the core that read an array by a constant in place of a name", 0, _index_reads),
    Figure("lines that read a law's parameters by position", 0, _parameters),
    Figure(
        "files that declare the type of an array of floats", 1,
        lambda tree: _with(tree.files(*_OURS, "tests", "benchmarks"), _DECLARED),
    ),
    Figure(
        "files of the core that name the role `elastic_hysteresis`", 3,
        lambda tree: _with(tree.core, '"elastic_hysteresis"'),
    ),
    Figure(
        "files that start processes", 3,
        lambda tree: _with(tree.files("lambda_core", "gui", "plugins"), r"ProcessPoolExecutor|subprocess\.Popen"),
        "studies, compilation, and the check of plugins, which must stop a law that loops",
    ),
    Figure("imports of the user interfaces past api, domain and views", 0, _past_the_api),
    Figure("files outside `elements` that test a kind of ball bearing", 0, _kinds_outside),
    Figure("files of the core with an engine", None, _engines),
    Figure("lines of api.py", 120, lambda tree: _api(tree)),
    Figure("lines of the longest module", 500, _longest),
    Figure("lines of the longest function below its docstring", None, lambda tree: max(_functions(tree))),
    Figure(
        "functions of the core with arguments that only Numba types", None, _untyped,
        "Numba infers these types; each annotation could only be `Any`",
    ),
    Figure("lines of the core", None, _lines_of_core),
    Figure("lines of the core with code: no blank line, comment, docstring", None, _statements),
)  # fmt: skip


def _api(tree: Tree) -> int:
    return sum(len(text.splitlines()) for name, text in tree.core.items() if re.match(r"lambda_core/api[./]", name))


def counted(tree: Tree) -> list[int]:
    """Return every figure of a tree."""
    return [figure.count(tree) for figure in FIGURES]


def table(now: list[int]) -> str:
    """Return the table of the page."""
    lines = ["| figure | limit | now | remark |", "|---|---|---|---|"]
    for figure, value in zip(FIGURES, now, strict=True):
        lines.append(f"| {figure.what} | {'' if figure.limit is None else figure.limit} | {value} | {figure.reason} |")
    return "\n".join([*lines, ""])


def main() -> None:
    """Print the figures of a tree, or renew the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tree", nargs="?", type=Path, default=ROOT, help="a checkout, default this one")
    parser.add_argument("--write", action="store_true", help="renew docs/code-metrics.md")
    options = parser.parse_args()
    text = table(counted(Tree(options.tree)))
    if options.write:
        page = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(page.partition(BEGIN)[0] + BEGIN + text + END + page.partition(END)[2], encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
