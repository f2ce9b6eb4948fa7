"""Test machine code in the wheel.

Used as it is, without the compiler, where sources and processor are those it is for.
"""

from __future__ import annotations

import ctypes
import os
import platform
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from lambda_core import api
from lambda_core.laws.jit.words import Array, by_reference
from lambda_core.laws.pack import Function, kind_from, other_code
from lambda_core.results.opening import ResultError

ROOT = Path(__file__).parents[2]
CASE = "6208-axial-700"
LINUX = pytest.mark.skipif(
    (sys.platform, platform.machine()) != ("linux", "x86_64"), reason="packs are built on Linux x86-64"
)
BUILD = "import sys, hatch_build; hatch_build.build_{kind}(sys.argv[1])"
SAY = """
import sys
from lambda_core.laws.pack import code
print(code())
"""
RUN = """
import sys
from lambda_cli.main import main
status = main(sys.argv[1:])
print(status, "numba" in sys.modules)
"""
LAW = """
from lambda_core.plugins import OK, law

@law("asperity_load", "half", role_api=3, reference="own work")
def kernel(Lambda, par, out):
    out[0] = 0.5 if Lambda < 1.0 else 0.0
    return OK
"""

ROLLERS = """
name = "nu-208"
bearing = { designation = "SKF NU 208 ECP" }
lubricant = { name = "FVA3", temperature = "70 degC" }
loads = { radial = "5 kN" }
operation = { speed = "3000 rpm" }
"""


def call(*arguments: str, cwd: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run Python in another folder.

    With environment variables of its own.
    """
    environment = {name: value for name, value in os.environ.items() if not name.startswith("LAMBDA_BEARING_CODE")}
    command = [sys.executable, "-W", "ignore", *arguments]
    return subprocess.run(command, cwd=cwd, env=environment | variables, capture_output=True, text=True, check=False)


@by_reference(Array(np.dtype(np.float64)))
class Numbers(NamedTuple):
    """A tuple that is handed over by its address."""

    line: Any


def test_values_are_handed_over_word_by_word() -> None:
    """Pass numbers, arrays, tuples and pointers.

    An array as its seven words, a tuple field by field or by its address, a pointer as three words.
    """
    seen: list[Any] = []
    numbers, line, rows = Numbers(np.zeros(3)), np.arange(4.0), np.zeros((2, 3), dtype=np.int64)
    kinds = [kind_from(each) for each in ("float", "int", ["float64", 1], {"tuple": [["int64", 2], "float"]})]
    kinds += ["address_Numbers", "function"]
    words = [ctypes.c_double, *[ctypes.c_int64] * 17, ctypes.c_double, *[ctypes.c_int64] * 4]
    counted = ctypes.CFUNCTYPE(ctypes.c_int64, *words)(lambda *found: seen.extend(found) or 7)
    address = ctypes.cast(counted, ctypes.c_void_p).value
    assert address is not None
    function = Function(address, kinds)
    assert function(0.5, -2, line, (rows, 1.5), numbers, function) == 7
    assert seen[:2] == [0.5, -2]
    assert seen[2:9] == [0, 0, 4, 8, line.ctypes.data, 4, 8]
    assert seen[9:19] == [0, 0, 6, 8, rows.ctypes.data, 2, 3, 24, 8, 1.5]
    assert seen[19:] == [numbers.address_Numbers, address, 0, 0]  # type: ignore[attr-defined]


@pytest.mark.parametrize("wrong", [np.zeros(4, dtype=np.float32), np.zeros((2, 2)), np.zeros(8)[::2]])
def test_an_array_of_another_type_is_refused(wrong: Any) -> None:
    nothing = ctypes.CFUNCTYPE(ctypes.c_int64, *[ctypes.c_int64] * 7)(lambda *_: 0)
    function = Function(ctypes.cast(nothing, ctypes.c_void_p).value or 0, [kind_from(["float64", 1])])
    with pytest.raises(TypeError, match="where compiled code takes float64"):
        function(wrong)


def test_a_code_that_is_none_is_refused_with_those_that_are(tmp_path: Path) -> None:
    said = call("-m", "lambda_cli", "quasistatic", CASE, cwd=tmp_path, LAMBDA_BEARING_CODE="fast")
    assert said.returncode == 2
    assert 'LAMBDA_BEARING_CODE is "fast": set it to pack or native' in said.stderr


def test_where_there_is_no_pack_nobody_gets_one_by_asking(tmp_path: Path) -> None:
    said = call("-m", "lambda_cli", "quasistatic", CASE, cwd=tmp_path, LAMBDA_BEARING_CODE="pack")
    assert said.returncode == 2
    assert "this installation has none: install a wheel with a pack, or set LAMBDA_BEARING_CODE=native" in said.stderr


def test_packs_of_other_compilers_do_not_continue_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    here = "pack linux x86-64-v3 numba 0.68.1 llvmlite 0.50.0"
    monkeypatch.setattr("lambda_core.laws.pack.code", lambda: here)
    assert other_code(here) == ""
    for there in (here.replace("v3", "v4"), here.replace("0.68.1", "0.67.0"), here.replace("0.50.0", "0.49.0")):
        said = other_code(there)
        assert said.startswith(f"it was computed by other machine code ({there}; this is {here})")
        assert said.endswith("take the installation that began it")


def test_a_run_does_not_go_on_under_other_code(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Refuse other code before anything is compiled.

    The message names the code that began the run, and how to choose it.
    """
    path = tmp_path / "run.h5"
    assert api.run(CASE, ["solver.duration=0.2 ms"], out=path).kernel_keys["code"] == "native"
    monkeypatch.setattr("lambda_core.laws.pack.code", lambda: "pack linux x86-64-v3 numba 0.0")
    with pytest.raises(
        ResultError, match=r"other machine code \(native; this is pack .* set LAMBDA_BEARING_CODE=native"
    ):
        api.resume(path, ["solver.duration=0.4 ms"])


@pytest.mark.parametrize("kind", ["editable", "sdist"])
def test_neither_an_sdist_nor_an_editable_install_compiles(kind: str, tmp_path: Path) -> None:
    made = call("-c", BUILD.format(kind=kind), str(tmp_path), cwd=ROOT, LAMBDA_BEARING_CACHE=str(tmp_path / "cache"))
    assert made.returncode == 0, made.stderr
    assert not (tmp_path / "cache").exists()
    (built,) = tmp_path.iterdir()
    if kind == "editable":
        names = zipfile.ZipFile(built).namelist()
    else:
        with tarfile.open(built) as archive:
            names = archive.getnames()
        assert [name for name in names if name.endswith("/hatch_build.py")]  # which builds the wheel from it
    assert not [name for name in names if "/pack/" in name]


def test_a_wheel_with_a_pack_needs_what_the_program_needs(tmp_path: Path) -> None:
    """Require only hatchling without a pack.

    The build alone needs it.
    """
    code = "import hatch_build; print(*hatch_build.get_requires_for_build_wheel())"
    asked = [call("-c", code, cwd=ROOT, LAMBDA_BEARING_PACK=wanted).stdout.split() for wanted in ("1", "0")]
    assert [name.split(">=")[0] for name in asked[0][:3]] == ["numpy", "scipy", "numba"]
    assert asked[1] == []


def test_a_wheel_without_a_c_compiler_has_no_pack_and_says_so(tmp_path: Path) -> None:
    made = call("-c", BUILD.format(kind="wheel"), str(tmp_path), cwd=ROOT, PATH=str(tmp_path))
    assert made.returncode == 0, made.stderr
    assert "there is no C compiler" in made.stderr
    assert "the wheel has no machine code, and the program compiles where it is installed" in made.stderr
    (wheel,) = tmp_path.glob("*.whl")
    assert not [name for name in zipfile.ZipFile(wheel).namelist() if "/pack/" in name]


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the wheel with its pack.

    In a folder of its own; libraries come from the environment of the tests.
    """
    folder = tmp_path_factory.mktemp("packed")
    options = ["-q", "--no-deps", "--no-index"]
    built = call("-m", "pip", "wheel", *options, "--no-build-isolation", "-w", str(folder), str(ROOT), cwd=folder)
    assert built.returncode == 0, built.stderr
    (wheel,) = folder.glob("*.whl")
    assert "lambda_core/pack/linux.so" in zipfile.ZipFile(wheel).namelist()
    assert wheel.stat().st_size < 8e6
    done = call("-m", "pip", "install", *options, "--target", str(folder / "site"), str(wheel), cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder / "site"


def edited(installed: Path, tmp_path: Path) -> Path:
    """Return a copy of the installation."""
    copy = tmp_path / "site"
    shutil.copytree(installed, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_wheel_runs_without_the_compiler_to_the_numbers_of_native_code(installed: Path, tmp_path: Path) -> None:
    """Run a wheel without the compiler.

    Equal to a part in a million after a millisecond; nothing is compiled into an empty cache.
    """
    cache, found = tmp_path / "cache", {}
    run = ["run", CASE, "--duration", "1 ms", "--progress", "none", "--out"]
    done = call("-c", RUN, *run, "pack.h5", cwd=tmp_path, PYTHONPATH=str(installed), LAMBDA_BEARING_CACHE=str(cache))
    assert done.stdout.splitlines()[-1] == "5 False", done.stderr  # a millisecond is no converged run
    assert not list(cache.rglob("*.nbc"))
    native = call("-c", RUN, *run, "native.h5", cwd=tmp_path, LAMBDA_BEARING_CODE="native")
    assert native.stdout.splitlines()[-1] == "5 True", native.stderr
    for code in ("pack", "native"):
        result = api.result(tmp_path / f"{code}.h5")
        assert result.kernel_keys["code"].split()[0] == code
        found[code] = result["input_torque"]
    assert found["pack"].size > 1
    np.testing.assert_allclose(found["pack"], found["native"], rtol=1e-6)


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_rollers_run_without_the_compiler_to_the_numbers_of_native_code(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "roller.toml").write_text(ROLLERS)
    cache, powers = tmp_path / "cache", []
    run = ["run", "roller.toml", "--duration", "0.5 ms", "--progress", "none", "--band", "none", "--out"]
    for code, needs_numba, variables in (
        ("pack", False, {"PYTHONPATH": str(installed), "LAMBDA_BEARING_CACHE": str(cache)}),
        ("native", True, {"LAMBDA_BEARING_CODE": "native"}),
    ):
        done = call("-c", RUN, *run, f"{code}.h5", cwd=tmp_path, **variables)
        assert done.stdout.splitlines()[-1] == f"5 {needs_numba}", done.stderr
        powers.append(api.result(tmp_path / f"{code}.h5")["input_torque"])
    assert not list(cache.rglob("*.nbc"))
    np.testing.assert_allclose(*powers, rtol=1e-6)


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_damaged_pack_is_refused_aloud(installed: Path, tmp_path: Path) -> None:
    """Change one bit of library and manifest."""
    for name in ("linux.so", "manifest.json"):
        copy = edited(installed, tmp_path / name)
        file = copy / "lambda_core" / "pack" / name
        content = bytearray(file.read_bytes())
        content[len(content) // 2] ^= 1
        file.write_bytes(content)
        said = call("-c", SAY, cwd=tmp_path, PYTHONPATH=str(copy))
        assert said.stdout == "native\n"
        assert f"{name} is damaged, install the program again; it is compiled here" in said.stderr


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_an_edited_source_leaves_the_pack_out(installed: Path, tmp_path: Path) -> None:
    assert call("-c", SAY, cwd=tmp_path, PYTHONPATH=str(installed)).stdout.startswith("pack linux x86-64-v3 numba ")
    copy = edited(installed, tmp_path)
    file = copy / "lambda_plugins" / "traction.py"
    file.write_text(file.read_text() + "# edited\n")
    said = call("-c", SAY, cwd=tmp_path, PYTHONPATH=str(copy))
    assert (said.stdout, said.stderr) == ("native\n", "")


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_law_of_ones_own_is_compiled_alone_and_runs_in_the_packed_solver(installed: Path, tmp_path: Path) -> None:
    law, cache = tmp_path / "half.py", tmp_path / "cache"
    law.write_text(LAW)
    run = ["run", CASE, "--plugin", str(law), "--set", "models.asperity_load=half", "--duration", "0.2 ms"]
    run += ["--progress", "none", "--out", "own.h5"]
    done = call("-c", RUN, *run, cwd=tmp_path, PYTHONPATH=str(installed), LAMBDA_BEARING_CACHE=str(cache))
    assert done.stdout.splitlines()[-1] == "5 True", done.stderr
    (compiled,) = cache.rglob("*.nbc")
    assert compiled.parent.name.startswith("asperity_load-")


@LINUX
@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_a_run_of_the_pack_is_resumed_by_the_pack_alone(installed: Path, tmp_path: Path) -> None:
    packed = {"PYTHONPATH": str(installed)}
    run = ["run", CASE, "--duration", "0.5 ms", "--progress", "none", "--out", "run.h5"]
    assert call("-c", RUN, *run, cwd=tmp_path, **packed).stdout.splitlines()[-1] == "5 False"
    resume = ["resume", "run.h5", "--duration", "1 ms", "--progress", "none"]
    refused = call("-c", RUN, *resume, cwd=tmp_path, **packed, LAMBDA_BEARING_CODE="native")
    assert "set LAMBDA_BEARING_CODE=pack" in refused.stderr
    assert call("-c", RUN, *resume, cwd=tmp_path, **packed).stdout.splitlines()[-1] == "5 False"
