"""Test one FMU for several systems.

Mathematics of its own, libraries built from here, bits that are equal.
"""

from __future__ import annotations

import ctypes
import math
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.export.fmu.library import PLATFORMS, SOURCES, compiler
from lambda_core.laws.jit.portable import features

HERE = Path(__file__).parent
CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)


@pytest.fixture(scope="module", params=["rounded", "fused"])
def mathematics(
    request: pytest.FixtureRequest, c_compiler: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory
) -> ctypes.CDLL:
    """Return the elementary functions as a library of their own."""
    library = tmp_path_factory.mktemp("mathematics") / "own.so"
    options = ["-O3", "-shared", "-fPIC", "-ffp-contract=off", "-fno-builtin", "-fno-math-errno"]
    if request.param == "fused":
        if "fma" not in features():
            pytest.skip("this processor has no fused products")
        options.append("-DLB_FUSED")
    command = [*c_compiler, *options, str(SOURCES / "mathematics.c"), "-o", str(library)]
    subprocess.run(command, check=True)
    return ctypes.CDLL(str(library))


def called(library: ctypes.CDLL, name: str, count: int) -> Callable[..., float]:
    """Return one of its functions."""
    function = library[name]
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * count
    return function


@pytest.mark.parametrize(
    ("name", "ranges", "units"),
    [
        ("exp", [(-700, 700)], 1.0),
        ("log", [(1e-300, 10)], 1.0),
        ("pow", [(1e-9, 20), (-25, 25)], 1.0),
        ("pow", [(0.9, 1.1), (-5000, 5000)], 1.0),
        ("sin", [(-1e6, 1e6)], 1.0),
        ("cos", [(-1e6, 1e6)], 1.0),
        ("arctan2", [(-5, 5), (-5, 5)], 1.0),
        ("tan", [(-10, 10)], 2.5),
        ("expm1", [(-2, 2)], 2.5),
        ("log1p", [(-0.9, 3)], 2.5),
        ("sinh", [(-30, 30)], 2.5),
        ("cosh", [(-30, 30)], 2.5),
        ("tanh", [(-5, 5)], 2.5),
        ("arcsinh", [(-30, 30)], 2.5),
        ("arcsin", [(-1, 1)], 2.5),
        ("arccos", [(-1, 1)], 2.5),
        ("cbrt", [(-30, 30)], 2.5),
        ("hypot", [(-5, 5), (-5, 5)], 2.5),
    ],
)
def test_own_mathematics_is_right_to_the_last_place(
    mathematics: ctypes.CDLL, name: str, ranges: list[tuple[float, float]], units: float
) -> None:
    """Compare with 64-bit significands.

    Their error is a two-thousandth of a unit of the last place.
    """
    if np.finfo(np.longdouble).nmant < 60:
        pytest.skip("this numpy has no longer floats to compare with")
    rng = np.random.default_rng(7)
    places = [rng.uniform(*each, 4000) for each in ranges]
    own = called(mathematics, name.replace("arc", "a"), len(ranges))
    longer = [each.astype(np.longdouble) for each in places]
    exact = (np.power if name == "pow" else getattr(np, name))(*longer)
    found = np.array([own(*values) for values in zip(*places, strict=True)])
    off = np.abs(found - exact) / np.spacing(np.abs(exact.astype(float)))
    assert float(off[np.isfinite(off)].max()) < units
    assert np.isfinite(off).all()


@pytest.mark.parametrize(
    ("name", "values", "expected"),
    [
        ("exp", (-math.inf,), 0.0),
        ("exp", (800.0,), math.inf),
        ("exp", (-745.0,), 5e-324),
        ("log", (0.0,), -math.inf),
        ("log", (-1.0,), math.nan),
        ("log", (5e-324,), math.log(5e-324)),
        ("pow", (-2.0, 3.0), -8.0),
        ("pow", (-2.0, 0.5), math.nan),
        ("pow", (0.0, -1.0), math.inf),
        ("pow", (math.nan, 0.0), 1.0),
        ("atan2", (-0.0, -1.0), -math.pi),
        ("atan2", (1.0, 0.0), 0.5 * math.pi),
        ("sin", (math.inf,), math.nan),
        ("sin", (-0.0,), -0.0),
    ],
)
def test_own_mathematics_at_the_edges(
    mathematics: ctypes.CDLL, name: str, values: tuple[float, ...], expected: float
) -> None:
    """Follow the C standard (ISO/IEC 9899, annex F.10)."""
    found = called(mathematics, name, len(values))(*values)
    assert found == pytest.approx(expected, abs=0.0, rel=0.0, nan_ok=True)
    assert math.copysign(1.0, found) == math.copysign(1.0, expected) or math.isnan(expected)


def test_a_system_without_its_compiler_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lambda_core.export.fmu.library.find_spec", lambda name: None)
    with pytest.raises(UsageError, match=r"for Windows on x86-64 .* the extra fmu: pip install"):
        compiler("windows")
    with pytest.raises(UsageError, match="windows"):
        api.export_fmu(CASE, CHANGES, platforms=["window"])


def ran(command: list[str], unit: Any, library: Path, environment: dict[str, str]) -> list[list[float]]:
    """Return a C host's outputs.

    It loads a library: 100 steps with a push after the half.
    """
    names = ["inner_ring.x", "inner_ring.z", "bearing.film_minimum", "cage.spin", "bearing.loss", "bearing.energy_lost"]
    words = [str(library), unit.token.decode(), "100", "1e-4", str(unit.references["inner_ring.force_z"]), "-250"]
    words += [str(unit.references[name]) for name in names]
    done = subprocess.run([*command, *words], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [[float.fromhex(word) for word in line.split()] for line in done.stdout.splitlines()]


@pytest.mark.full
def test_a_processor_without_the_features_is_told_so(
    host: Any, exported: Callable[[int, str], Path], tmp_path: Path, c_compiler: tuple[str, ...]
) -> None:
    """Refuse a processor of 2008, which QEMU plays.

    There is no instance, and a message instead of an illegal instruction.
    """
    emulator = shutil.which("qemu-x86_64")
    if emulator is None or "avx2" not in features():
        pytest.skip("QEMU for x86-64 is not installed, or this processor lacks AVX2 itself")
    unit, program = host.Unit(exported(2, "force"), tmp_path / "unit"), tmp_path / "host"
    subprocess.run([*c_compiler, "-O1", str(HERE / "plain_host.c"), "-o", str(program), "-ldl"], check=True)
    words = [emulator, "-cpu", "Nehalem", str(program), str(unit.file), unit.token.decode(), "1", "1e-4", "1", "0"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 3
    assert "this processor lacks what the bearing was exported for" in done.stderr


@pytest.mark.slow
@pytest.mark.timeout(1500)
def test_other_systems_run_it(host: Any, tmp_path: Path) -> None:
    """Run Windows under Wine and ARM under QEMU.

    Both have the bits of Linux; libraries for macOS are built and not run.
    """
    pytest.importorskip("ziglang", reason="the extra fmu is not installed")
    chosen = ["linux", "windows", "linux-arm", "mac-arm", "mac-intel"]
    file = api.export_fmu(CASE, CHANGES, out=tmp_path / "all.fmu", platforms=chosen, processor="native")
    unit = host.Unit(file, tmp_path / "unit")
    with zipfile.ZipFile(file) as archive:
        held = {name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")}
    assert held == {PLATFORMS[name].folders[2] for name in chosen}
    assert file.stat().st_size < 3e6
    zig, source = [sys.executable, "-m", "ziglang", "cc", "-O1"], str(HERE / "plain_host.c")

    def library(platform: str) -> Path:
        (found,) = (tmp_path / "unit" / "binaries" / PLATFORMS[platform].folders[2]).iterdir()
        return found

    subprocess.run([*compiler(), "-O1", source, "-o", str(tmp_path / "host"), "-ldl"], check=True)
    here = ran([str(tmp_path / "host")], unit, library("linux"), {})
    tried = 0
    if wine := shutil.which("wine"):
        built = tmp_path / "host.exe"
        subprocess.run([*zig, "-target", PLATFORMS["windows"].zig, source, "-o", str(built)], check=True)
        quiet = {"WINEDEBUG": "-all", "WINEPREFIX": str(tmp_path / "wine"), "PATH": "/usr/bin:/bin"}
        assert ran([wine, str(built)], unit, library("windows"), quiet) == here
        tried += 1
    libraries = Path("/usr/aarch64-linux-gnu")
    if (emulator := shutil.which("qemu-aarch64")) and libraries.exists():
        built = tmp_path / "host_arm"
        subprocess.run([*zig, "-target", PLATFORMS["linux-arm"].zig, source, "-o", str(built), "-ldl"], check=True)
        there = ran([emulator, "-L", str(libraries), str(built)], unit, library("linux-arm"), {})
        assert there == here
        tried += 1
    if not tried:
        pytest.skip("neither Wine nor QEMU with the C library of ARM is installed")


def test_libraries_of_other_systems_have_the_names_of_the_standard() -> None:
    """Compare names with FMI 3.0, section 2.5.1.4.

    x86_64 or aarch64, and linux, windows or darwin.
    """
    for platform in PLATFORMS.values():
        assert re.fullmatch(r"(x86_64|aarch64)-(linux|windows|darwin)", platform.folders[3])
