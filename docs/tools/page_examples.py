"""Run the examples of the pages and compare their output.

A page is followed from top to bottom in an empty folder:

* a ``console`` block: lines that begin with ``$ `` are typed, all others are what the program said;
* a ``python`` block: executed after the Python blocks before it; a ``text`` block right below it is what it prints;
* any other block below a line that is only a file's name in backticks and a colon is written to that file.

``...`` stands for anything: a part of a line, or, alone, any number of lines. Numbers agree within 1 %, or within
one unit of their last decimal. ``$ echo $?`` shows an exit code, which otherwise has to be 0. Above a block,
``<!-- slow -->`` puts the page's rest among the slow tests and ``<!-- not run: why -->`` leaves one block out.
``<!-- before: COMMAND -->`` runs a command that readers need not see.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

DOCS = Path(__file__).parents[1]
PROGRAMS = Path(sys.executable).parent
ELSEWHERE = {"plugins.md", "plugin-reference.md"}  # tests/plugins follows them
_BLOCK = re.compile(
    r"(?:^<!-- before: (?P<before>.+?) -->$)|(?:^(?P<head>[^\n]*)\n+)?^```(?P<language>\w*)\n(?P<body>.*?)^```$",
    re.M | re.S,
)
_FILE = re.compile(r"^`([^`\s]+)`:$")
_NOT_RUN = re.compile(r"^<!-- not run: (.+) -->$")
_NUMBER = r"(?<![\w.])(?<!\w-)[-+]?\d+(?: \d{3})*(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\d])"
_RELATIVE = 0.01
_ASK = "echo $?"  # how a page shows an exit code


@dataclass
class Step:
    """One step of a page.

    Write a file, type a command, execute Python.
    """

    kind: str  # "file", "command", "python"
    text: str
    expected: list[str]  # lines on the page; empty: nothing is shown
    name: str = ""  # of the file
    slow: bool = False


@dataclass(frozen=True)
class Difference:
    """A step that did not say what the page prints."""

    step: Step
    said: str
    reason: str

    def __str__(self) -> str:
        return (
            f"{self.reason}\n--- typed\n{self.step.text}\n--- page\n{_join(self.step.expected)}\n--- said\n{self.said}"
        )


def pages() -> list[Path]:
    """Return every page that has something to follow."""
    return [path for path in sorted(DOCS.rglob("*.md")) if path.name not in ELSEWHERE and steps(path)]


def not_run(path: Path) -> list[str]:
    """Return why blocks of a page are left out."""
    return re.findall(r"^<!-- not run: (.+?) -->$", path.read_text(encoding="utf-8"), re.M)


def steps(path: Path) -> list[Step]:
    """Return the steps of a page in order."""
    found: list[Step] = []
    slow = False
    for match in _BLOCK.finditer(path.read_text(encoding="utf-8")):
        if match["before"]:
            found.append(Step("command", match["before"], [], slow=slow))
            continue
        head, language, body = match["head"] or "", match["language"], match["body"]
        slow = slow or head == "<!-- slow -->"
        file = _FILE.match(head)
        if _NOT_RUN.match(head):
            continue
        if file:
            found.append(Step("file", body, [], file[1], slow))
        elif language == "console":
            found += [Step("command", command, lines, slow=slow) for command, lines in _commands(body)]
        elif language == "python":
            found.append(Step("python", body, [], slow=slow))
        elif language == "text" and found and found[-1].kind == "python" and not head.strip():
            found[-1].expected = body.splitlines()
    return found


def _commands(body: str) -> Iterator[tuple[str, list[str]]]:
    command, lines = "", []
    for line in body.splitlines():
        if command.endswith("\\"):
            command = f"{command}\n{line}"
        elif line.startswith("$ "):
            if command:
                yield command, lines
            command, lines = line[2:], []
        else:
            lines.append(line)
    if command:
        yield command, lines


def follow(path: Path, folder: Path, slow: bool, programs: Path = PROGRAMS) -> list[Difference]:
    """Follow a page in `folder`.

    Return where it did not turn out as printed.

    Parameters
    ----------
    slow : bool
        Whether to go on where the slow part begins.
    programs : Path
        Folder of the program and of Python.
    """
    differences: list[Difference] = []
    todo = [step for step in steps(path) if slow or not step.slow]
    environment = _environment(folder, programs)
    python = Interpreter(folder, environment)
    last = 0
    for index, step in enumerate(todo):
        if step.kind == "file":
            (folder / step.name).parent.mkdir(parents=True, exist_ok=True)
            (folder / step.name).write_text(step.text, encoding="utf-8")
            continue
        if step.text == _ASK:
            last, said = 0, f"{last}\n"
        elif step.kind == "command":
            last, said = _type(step.text, folder, environment)
        else:
            last, said = python.run(step.text)
        asked = index + 1 < len(todo) and todo[index + 1].text == _ASK
        if last != 0 and not asked:
            differences.append(Difference(step, said, f"ended with exit code {last}"))
        elif step.expected and compare(step.expected, said.splitlines()) is None:
            differences.append(Difference(step, said, "said something else"))
    python.close()
    return differences


class Interpreter:
    """Python process in a folder.

    The blocks of one page share their names.
    """

    _LOOP = (
        "import contextlib, io, json, sys, traceback\n"
        "names = {'__name__': '__main__'}\n"
        "for line in sys.stdin:\n"
        "    said, code = io.StringIO(), 0\n"
        "    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):\n"
        "        try:\n"
        "            exec(json.loads(line), names)\n"
        "        except BaseException:\n"
        "            traceback.print_exc()\n"
        "            code = 1\n"
        "    print(json.dumps([code, said.getvalue()]), flush=True)\n"
    )

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        self._process = subprocess.Popen(
            ["bash", "-c", 'exec python -c "$0"', self._LOOP],
            cwd=folder,
            env=environment,
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )

    def run(self, block: str) -> tuple[int, str]:
        """Execute a block.

        Return 0 or 1 and what it printed.
        """
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{json.dumps(block)}\n")
        self._process.stdin.flush()
        code, said = json.loads(self._process.stdout.readline())
        return code, said

    def close(self) -> None:
        """End the process."""
        self._process.communicate()


def _environment(folder: Path, programs: Path) -> dict[str, str]:
    return os.environ | {
        "PATH": os.pathsep.join([str(programs), str(PROGRAMS), os.environ["PATH"]]),
        "NO_COLOR": "1",
        "COLUMNS": "100",
        "LAMBDA_BEARING_DATA": str(folder / ".data"),
        "MPLBACKEND": "Agg",
    }


def _type(command: str, folder: Path, environment: dict[str, str]) -> tuple[int, str]:
    """Run a command line.

    Return its exit code and its output on both streams.
    """
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=environment,
        text=True,
        check=False,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.returncode, done.stdout


def compare(expected: list[str], said: list[str], exact: bool = False) -> list[str] | None:
    """Return the lines with today's numbers.

    None when the two do not agree.

    Parameters
    ----------
    expected : list of str
        Lines of the page.
    said : list of str
        Lines of the program.
    exact : bool
        False: numbers have to agree within the tolerance; True: they may be any.
    """
    if not expected:
        return [] if not [line for line in said if line.strip()] else None
    head, *rest = expected
    if head.strip() == "...":
        for skip in range(len(said) + 1):
            found = compare(rest, said[skip:], exact) if rest else []
            if found is not None:
                return [head, *found]
        return None
    if not said:
        return None
    line = _agree(head, said[0], exact)
    if line is None:
        return None
    found = compare(rest, said[1:], exact)
    return None if found is None else [line, *found]


def _agree(expected: str, said: str, exact: bool) -> str | None:
    """Return a line with today's numbers.

    None when the lines do not agree.
    """
    # Every second part is a number or "...".
    parts = re.split(rf"({_NUMBER}|\.\.\.)", expected)
    pattern = "".join(_mark(part) if index % 2 else _words(part) for index, part in enumerate(parts))
    match = re.fullmatch(rf"\s*{pattern}\s*", said)
    if match is None:
        return None
    numbers = iter(match.groups())
    for index in range(1, len(parts), 2):
        if parts[index] != "...":
            number = next(numbers)
            if not exact and not _close(parts[index], number):
                return None
            parts[index] = number
    return "".join(parts)


def _mark(part: str) -> str:
    return ".*?" if part == "..." else f"({_NUMBER})"


def _words(part: str) -> str:
    return r"\s+".join(re.escape(word) for word in re.split(r"\s+", part))


def _close(expected: str, said: str) -> bool:
    one, other = (float(text.replace(" ", "")) for text in (expected, said))
    mantissa = re.split(r"[eE]", expected)[0]
    decimals = len(mantissa.partition(".")[2])
    power = int(re.split(r"[eE]", expected)[1]) if re.search(r"[eE]", expected) else 0
    unit = 10.0 ** (power - decimals) if "." in mantissa else 0.0
    return abs(one - other) <= max(_RELATIVE * abs(one), 1.0001 * unit)


def renewed(path: Path, folder: Path) -> str:
    """Return a page with today's numbers.

    Those of its examples; lines that changed otherwise stay.
    """
    text = path.read_text(encoding="utf-8")
    for difference in follow(path, folder, slow=True):
        old = difference.step.expected
        new = compare(old, difference.said.splitlines(), exact=True)
        if new is None:
            print(f"{path.name}: to be edited by hand: {difference}", file=sys.stderr)
        elif old:
            text = text.replace(_join(old), _join(new), 1)
    return text


def _join(lines: list[str]) -> str:
    return "\n".join(lines)
