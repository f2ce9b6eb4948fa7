"""Test compiled code on disk.

What is edited is seen by the next process, what is not is not compiled again.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from lambda_core.solver.core import core

if TYPE_CHECKING:
    from warm import Warm

LAW = """
from law_package import middle
from lambda_core.laws.law import law_of
from lambda_core.plugins import law

@law("asperity_load", "test-law", role_api=3, reference="own work")
def kernel(Lambda, par, out):
    out[0] = {factor} * middle.shape(Lambda)
    return 1

LAW = law_of(kernel)
"""
MIDDLE = """
from law_package.deep import scale

def shape(x, power=1):
    return scale(x) ** power
"""
DEEP = """
from law_package.constants import K

def scale(x):
    return K * x {more}
"""
CONSTANTS = "K = {value}\n"
ASK = """
import json
import numpy as np
from lambda_core.laws.kernels import compile_kernel
from law_package.law import LAW

said = []
compiled = compile_kernel(LAW, said.append)
out = np.full(1, np.nan)
status = compiled.dispatcher(np.array([2.0]), np.empty(0), out)
print(json.dumps(dict(status=status, value=out[0], cached=compiled.cached, key=compiled.key, said=said)))
"""


class Package:
    """A plugin's package on disk, edited between processes."""

    def __init__(self, root: Path, warm: Warm) -> None:
        self.root, self._warm = root, warm
        self.folder = root / "law_package"
        self.folder.mkdir()
        self.write("__init__", "")
        self.write("law", LAW.format(factor="1.0"))
        self.write("middle", MIDDLE)
        self.write("deep", DEEP.format(more=""))
        self.write("constants", CONSTANTS.format(value="3.0"))

    def write(self, module: str, text: str) -> None:
        (self.folder / f"{module}.py").write_text(text)

    def ask(self, code: str = ASK) -> dict[str, object]:
        """Call the law in a new process.

        It compiles or loads it; it has Numba loaded and does not know the law.
        """
        process = self._warm.start(f"import sys; sys.dont_write_bytecode = True\n{code}", cwd=self.root, env=self._env)
        out, err = process.communicate()
        return self._answer(process.returncode, out, err)

    def ask_afresh(self, **environment: str) -> dict[str, object]:
        """Ask in a new interpreter.

        Some settings are fixed when Numba or the folder for files is first used.
        """
        env = os.environ | self._env | {"PYTHONPATH": str(self.root)} | environment
        done = subprocess.run([sys.executable, "-c", ASK], env=env, capture_output=True, text=True, check=False)
        return self._answer(done.returncode, done.stdout, done.stderr)

    @property
    def _env(self) -> dict[str, str]:
        # two edits within a second would reuse stale bytecode
        return {"PYTHONDONTWRITEBYTECODE": "1", "LAMBDA_BEARING_CACHE": str(self.root / "cache")}

    @staticmethod
    def _answer(code: int | None, out: str, err: str) -> dict[str, object]:
        assert code == 0, err
        answer: dict[str, object] = json.loads(out)
        return answer


@pytest.fixture
def package(tmp_path: Path, warm: Warm) -> Package:
    return Package(tmp_path, warm)


LOADED = """
from lambda_core.solver.entry import build
(found,) = build("wrench").overloads.values()
library, symbol = found.library, found.fndesc.llvm_cfunc_wrapper_name
address = library.get_pointer_to_function(symbol)
assert address
assert library._shared_module is None, "LLVM's code was read"
assert library.get_pointer_to_function("nobody") == 0
assert symbol in [each.name for each in library._get_module_for_linking().functions if not each.is_declaration]
assert library.get_pointer_to_function(symbol) == address
"""


@pytest.mark.full
def test_a_part_of_the_solver_comes_from_its_machine_code_alone() -> None:
    core()  # whatever is compiled anew is on disk then
    done = subprocess.run([sys.executable, "-c", LOADED], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_second_process_loads_from_disk(package: Package) -> None:
    cold, warm = package.ask(), package.ask()
    assert cold["said"] == ["compiling asperity_load/test-law (once)"]
    assert warm["said"] == []
    assert (cold["cached"], warm["cached"]) == (False, True)
    assert (cold["status"], cold["value"]) == (warm["status"], warm["value"]) == (1, 6.0)
    assert cold["key"] == warm["key"]


@pytest.mark.full
@pytest.mark.parametrize(
    ("module", "text", "value"),
    [
        ("law", LAW.format(factor="10.0"), 60.0),
        ("middle", MIDDLE.replace("power=1", "power=2"), 36.0),
        ("deep", DEEP.format(more="+ 1.0"), 7.0),
        ("constants", CONSTANTS.format(value="5.0"), 10.0),
    ],
    ids=["law", "default-in-a-helper", "helper-two-files-down", "imported-constant"],
)
def test_an_edit_is_seen_by_the_next_process(package: Package, module: str, text: str, value: float) -> None:
    before = package.ask()
    package.write(module, text)
    after = package.ask()
    assert before["value"] == 6.0
    assert after["value"] == value
    assert after["cached"] is False
    assert after["key"] != before["key"]


def test_a_comment_or_a_new_date_compiles_nothing(package: Package) -> None:
    package.ask()
    package.write("deep", DEEP.format(more="  # a remark"))
    os.utime(package.folder / "law.py", (1, 1))
    assert package.ask()["cached"] is True


@pytest.mark.full
def test_bounds_checked_code_has_a_folder_of_its_own(package: Package) -> None:
    package.ask()
    assert package.ask_afresh(NUMBA_BOUNDSCHECK="1")["cached"] is False
    assert package.ask_afresh(NUMBA_BOUNDSCHECK="1")["cached"] is True


def test_damaged_files_are_compiled_anew(package: Package) -> None:
    package.ask()
    for path in (package.root / "cache").rglob("*.nb*"):
        path.write_bytes(path.read_bytes()[:40])
    again = package.ask()
    assert (again["value"], again["cached"]) == (6.0, False)


@pytest.mark.full
@pytest.mark.parametrize("place", [0.1, 1.0])
def test_c3_flipped_bytes_in_compiled_code_are_compiled_anew_and_mended(package: Package, place: float) -> None:
    package.ask()
    for path in (package.root / "cache").rglob("*.nbc"):
        data = bytearray(path.read_bytes())
        at = round(place * (len(data) - 17))
        data[at : at + 16] = bytes(byte ^ 0xFF for byte in data[at : at + 16])
        path.write_bytes(data)
    again = package.ask()
    assert (again["value"], again["cached"]) == (6.0, False)
    assert package.ask()["cached"] is True


@pytest.mark.full
def test_code_that_nobody_used_for_months_is_dropped(package: Package) -> None:
    package.ask()
    (old,) = (package.root / "cache" / "kernels").iterdir()
    os.utime(old, (1, 1))
    package.ask()
    assert old.exists()  # used again: dated anew
    os.utime(old, (1, 1))
    package.write("law", LAW.format(factor="2.0"))
    package.ask()
    (new,) = (package.root / "cache" / "kernels").iterdir()
    assert new != old


@pytest.mark.full
def test_c3_a_read_only_cache_does_not_stop_anything(package: Package) -> None:
    (package.root / "cache").write_text("a file where a folder should be")
    temporary = package.root / "temporary"
    temporary.mkdir()
    assert package.ask_afresh(TMPDIR=str(temporary))["value"] == 6.0
    assert not list(temporary.glob("lambda-bearing-*"))


def test_a_cached_helper_is_refused_by_name(package: Package) -> None:
    package.write("deep", "from numba import njit\n\n@njit(cache=True)\ndef scale(x):\n    return 3.0 * x\n")
    code = f"""
import json
from lambda_core.domain.errors import LambdaError
try:
    {ASK.replace(chr(10), chr(10) + "    ")}
except LambdaError as error:
    print(json.dumps(str(error)))
"""
    message = str(package.ask(code))
    assert "asperity_load/test-law" in message
    assert "law_package.deep.scale is compiled with cache=True" in message


def test_a_function_without_a_source_file_compiles(package: Package) -> None:
    code = """
import json
import numpy as np
from lambda_core.laws.law import Law
from lambda_core.laws.kernels import compile_kernel

exec("def kernel(Lambda, par, out):\\n    out[0] = 4.0 * Lambda\\n    return 1", globals())
compiled = compile_kernel(Law("asperity_load", "typed-in", kernel, role_api=3, reference="own work"))
out = np.zeros(1)
compiled.dispatcher(np.array([2.0]), np.empty(0), out)
print(json.dumps(dict(value=out[0], cached=compiled.cached)))
"""
    assert package.ask(code) == {"value": 8.0, "cached": False}
    assert package.ask(code) == {"value": 8.0, "cached": True}


HOST = """
import json
from pathlib import Path
from numba import types
import numpy as np
from lambda_core.laws.kernels import compile_host, compile_kernel, signature
from lambda_core.laws import kernels
from host_package import core
from law_package.law import LAW

said = []
pointer = types.FunctionType(signature("asperity_load"))
host = compile_host(
    core.twice,
    types.float64(types.NamedUniTuple(pointer, 2, core.Laws), types.float64[::1]),
    (Path(core.__file__).parent,),
    said.append,
)
law = compile_kernel(LAW).pointer
print(json.dumps(dict(value=host.dispatcher(core.Laws(law, law), np.empty(2)), cached=host.cached, said=said)))
"""
CORE = """
from typing import Any, NamedTuple
import numpy as np
from numba import njit
from host_package.part import part
from outside import OFFSET

class Laws(NamedTuple):
    first: Any
    second: Any

def twice(laws, out):
    ratio, found = out[:1], out[1:]
    ratio[0] = 1.0
    laws.first(ratio, found, found)
    total = found[0]
    ratio[0] = 10.0
    laws.second(ratio, found, found)
    return total + found[0] + part(0.0) + OFFSET
"""
PART = """
from numba import njit

@njit(error_model="numpy")
def part(x):
    return x + {number}
"""


@pytest.fixture
def host(package: Package) -> Package:
    folder = package.root / "host_package"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "core.py").write_text(CORE)
    (folder / "part.py").write_text(PART.format(number=0))
    (package.root / "outside.py").write_text("OFFSET = 0.0\n")
    return package


def test_host_code_calls_laws_by_pointer_and_stays_on_disk(host: Package) -> None:
    cold = host.ask(HOST)
    host.write("law", LAW.format(factor="2.0"))
    edited_law = host.ask(HOST)
    assert cold == {"value": 33.0, "cached": False, "said": ["compiling twice (once)"]}
    assert edited_law == {"value": 66.0, "cached": True, "said": []}  # the solver is not compiled again


def test_an_edited_host_helper_or_outside_constant_is_seen(host: Package) -> None:
    host.ask(HOST)
    (host.root / "host_package" / "part.py").write_text(PART.format(number=100))
    assert host.ask(HOST)["value"] == 133.0
    (host.root / "outside.py").write_text("OFFSET = 1000.0\n")
    assert host.ask(HOST)["value"] == 1133.0


def test_what_was_compiled_is_frozen_when_a_python_call_ends() -> None:
    """Drop the collector's last search from calls.

    The command dropped it, and a call from Python took a quarter longer.
    """
    code = "import atexit, gc; atexit.register(lambda: print(gc.get_freeze_count() > 10_000)); "
    run = [sys.executable, "-c", code + "import lambda_core.laws.jit.machine_code"]
    assert subprocess.run(run, capture_output=True, text=True, check=True).stdout.strip() == "True"
