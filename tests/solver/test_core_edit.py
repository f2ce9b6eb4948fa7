"""Test that the next process sees edits of the core."""

from __future__ import annotations

import io
import json
import keyword
import os
import shutil
import subprocess
import sys
import tokenize
from pathlib import Path
from typing import Any

import pytest

import lambda_core
from lambda_core.laws.executable import executable_key, executed
from lambda_core.solver import entry
from lambda_core.solver.contact import contact_kinematics
from lambda_core.solver.motion import steps
from lambda_core.solver.roller import units

# One small function of the core, compiled as the solver's parts are, and the names under which those are looked up.
ONE_FUNCTION = """
import json
from pathlib import Path
from numba import types
from lambda_core.solver.contact import contact_kinematics as kinematics
from lambda_core.solver.entry import SOURCES, UNITS
from lambda_core.laws.kernels import compile_host, host_key

folder = Path(kinematics.__file__).parent
host = compile_host(kinematics.axis_x.py_func, types.float64(types.float64, types.float64), SOURCES)
keys = {name: host_key(function, SOURCES) for name, (function, _) in UNITS.items()}
print(json.dumps(dict(folder=str(folder), keys=keys, value=host.dispatcher(1.0, 0.0), cached=host.cached)))
"""
# The whole solver.
SOLVE = """
import json
from pathlib import Path
from lambda_core import api
from lambda_core.solver.contact import contact_kinematics as kinematics
from lambda_core.solver.drivers.equilibrium import solve

print(json.dumps(dict(folder=str(Path(kinematics.__file__).parent), value=solve(api.check("6319-cp10-1500")).orbit)))
"""


class Copy:
    """Editable copy of the package.

    It is in a folder of its own.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        shutil.copytree(
            Path(lambda_core.__file__).parent, root / "lambda_core", ignore=shutil.ignore_patterns("__pyc*")
        )
        self.file = root / "lambda_core" / "solver" / "contact" / "contact_kinematics.py"

    def edit(self, old: str, new: str) -> None:
        text = self.file.read_text()
        assert text.count(old) == 1
        self.file.write_text(text.replace(old, new))

    def ask(self, code: str) -> dict[str, Any]:
        """Run in a new process.

        With a cache of its own.
        """
        own = {"LAMBDA_BEARING_CACHE": str(self.root / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", code],
            cwd=self.root,
            env=os.environ | own | {"PYTHONPATH": str(self.root)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        answer: dict[str, Any] = json.loads(done.stdout)
        assert Path(answer["folder"]) == self.file.parent  # the copy answered, not the installed package
        return answer


@pytest.mark.full
def test_an_edited_constant_of_the_core(tmp_path: Path) -> None:
    copy = Copy(tmp_path)
    before, again = copy.ask(ONE_FUNCTION), copy.ask(ONE_FUNCTION)
    copy.file.write_text(f"# A remark.\n\n{copy.file.read_text()}")  # moves every function
    told = copy.ask(ONE_FUNCTION)
    assert told["cached"]
    assert told["keys"] == before["keys"]
    copy.edit("1e-12", "0.25")
    after = copy.ask(ONE_FUNCTION)
    assert (before["cached"], again["cached"], after["cached"]) == (False, True, False)
    assert before["value"] == again["value"] == pytest.approx(1e-6)
    assert after["value"] == pytest.approx(0.5)
    assert before["keys"] == again["keys"]
    assert all(after["keys"][name] != key for name, key in before["keys"].items())  # every part of the solver


def test_every_module_of_the_core_counts(tmp_path: Path) -> None:
    """Change each module and compare the hash.

    The cache on disk has a hash of all modules as its key.
    """
    solver = tmp_path / "solver"
    shutil.copytree(Path(entry.__file__).parent, solver, ignore=shutil.ignore_patterns("__pyc*"))
    sources = [solver / path.name for path in entry.SOURCES]
    keys = {executable_key(tmp_path, *sources)}
    modules = [path for path in solver.rglob("*.py") if not {"drivers", "roller"} & set(path.parts)]
    for path in modules:
        text = path.read_text()
        path.write_text(text + "_ = 1\n")
        keys.add(executable_key(tmp_path, *sources))
        path.write_text(text)
    assert len(keys) == len(modules) + 1 > 30


def test_every_token_counts_but_no_docstring_and_no_comment() -> None:
    text = Path(steps.__file__).read_text()
    lines, keys, edits = text.splitlines(keepends=True), {executed(text.encode())}, 0
    for number, token in enumerate(tokenize.generate_tokens(io.StringIO(text).readline)):
        other = {"+": "-", "*": "/"}.get(token.string, "")
        if token.type in (tokenize.NAME, tokenize.NUMBER) and not keyword.iskeyword(token.string):
            other = f"{token.string}7"
        elif token.type == tokenize.COMMENT:
            other = f"{token.string} {number}"
        if other:
            row, line = token.start[0], token.line
            edited = line[: token.start[1]] + other + line[token.end[1] :]
            keys.add(executed("".join([*lines[: row - 1], edited, *lines[row:]]).encode()))
            edits += token.type != tokenize.COMMENT
    assert len(keys) == edits + 1 > 80
    assert executed(text.replace('"""', '"""Again: ', 1).encode()) == executed(text.encode())


def test_a_damaged_table_of_hashes_is_made_anew(tmp_path: Path) -> None:
    place = Path(contact_kinematics.__file__)
    key = executable_key(tmp_path, place)
    (table,) = tmp_path.iterdir()
    kept = table.read_bytes()
    for damaged in (b"", kept[:-5], b"\xff" + kept[1:], kept.replace(b'": "', b'": "g')):
        table.write_bytes(damaged)
        assert executable_key(tmp_path, place) == key
        assert table.read_bytes() == kept


@pytest.mark.parametrize("groups", [entry.GROUPS, entry.FINER_GROUPS], ids=["few", "many"])
def test_every_part_is_compiled_by_one_process(groups: tuple[tuple[str, ...], ...]) -> None:
    assert sorted(name for group in groups for name in group) == sorted(entry.UNITS)
    assert sorted(entry.OF_ROLLERS) == sorted(units.UNITS)


PLAIN_RUN = """
import sys
from lambda_core import api
from lambda_core.solver import entry

asked = []
build = entry.build
entry.build = lambda name, *more: asked.append(name) or build(name, *more)
api.run("6208-axial-1300", ["solver.duration=0.1 ms", f"solver.accuracy={sys.argv[1]}"], out=sys.argv[2])
print(*asked)
"""


@pytest.mark.full
@pytest.mark.parametrize(("accuracy", "needs"), [("averages", False), ("vibration", True)])
def test_the_one_step_formula_is_compiled_for_vibrations_alone(accuracy: str, needs: bool, tmp_path: Path) -> None:
    """Compile the one-step formula for vibrations only.

    A run for averages neither compiles nor loads it.
    """
    command = [sys.executable, "-W", "ignore", "-c", PLAIN_RUN, accuracy, str(tmp_path / "run.h5")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert ("advance_finely" in done.stdout.split()) is needs
    assert "advance" in done.stdout.split()


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_an_edited_solver_finds_another_equilibrium(tmp_path: Path) -> None:
    """Move contacts to the ball's own surface.

    They are in the middle of the penetration otherwise; the balls orbit at another speed.
    """
    copy = Copy(tmp_path)
    before = copy.ask(SOLVE)["value"]
    copy.edit("dist = system.ball_radius - 0.5 * delta", "dist = system.ball_radius - 0.0 * delta")
    after = copy.ask(SOLVE)["value"]
    assert after != before
    assert after == pytest.approx(before, rel=1e-2)
