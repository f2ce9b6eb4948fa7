"""Test FMUs.

The bits of the program without the program, states, bad use, and the standard.
"""

from __future__ import annotations

import json
import math
import re
import shutil
import subprocess
import zipfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.domain.roles import ROLES
from lambda_core.laws.kernels import compile_kernel

HERE = Path(__file__).parent
CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)
STEP = 1e-4  # [s]
PUSHED = "inner_ring.force_z"
# Of the C library and its start-up code; everything else would have to come from somewhere.
PLAIN = re.compile(
    r"_ITM_\w+|__gmon_start__|__cxa_finalize|__stack_chk_fail|__errno_location|"
    r"a?(sin|cos|tan)h?|sincos|atan2|exp2?|expm1|log(2|10|1p)?|pow|f(min|max|mod|abs)|hypot|cbrt|"
    r"(m|c)alloc|free|mem(cpy|set|move|cmp)|str(cmp|cpy|ncmp|ncpy|len)|__?\w*(snprintf|str\w*|mem\w*)_chk|vsnprintf"
)
Export = Callable[[int, str], Path]


def unit_of(host: Any, exported: Export, tmp_path: Path, fmi: int = 2, couple: str = "force") -> Any:
    """Return an unpacked FMU."""
    return host.Unit(exported(fmi, couple), tmp_path / f"{couple}{fmi}")


def seen(step: Any) -> dict[str, float]:
    """Return an FMU's outputs after a step.

    The step is one of the program.
    """
    loads, films, parameters = step["load"], step["film_minimum"], step["film_parameter"]
    return {
        "inner_ring.x": step["body_position"][0, 0],
        "inner_ring.z_rate": step["body_velocity"][0, 2],
        "inner_ring.tilt_y": step["body_tilt"][0, 0],
        "cage.spin": step["body_spin"][2],
        "outer_ring.reaction_force_z": step.reactions["outer_ring"][2],
        "inner_ring.reaction_moment_y": step.reactions["inner_ring"][4],
        "bearing.load": loads.max(),
        "bearing.film_minimum": films[films > 0.0].min(),
        "bearing.film_parameter": parameters[parameters > 0.0].min(),
        "bearing.max_pressure": step["max_pressure"].max(),
        "bearing.capacitance": step["bearing_capacitance"],
    }


def assert_bits_in_c(unit: Any, program: Path, case: Path | str, steps: int) -> None:
    """Compare an FMU in a host without Python.

    The other side is the program. A push of 250 N comes after half of the steps of 0.1 ms.
    """
    bearing = api.iterate(case, CHANGES, exact=True)
    expected, time = [], 0.0
    for k in range(steps):
        bearing.push((0.0, 0.0, 0.0 if k < steps // 2 else -250.0))
        expected.append(seen(bearing.step_to(time + STEP)))
        time += STEP
    names = [name for name in expected[0] if name in unit.references]  # full complements have no cage
    words = [str(unit.file), unit.token.decode(), str(steps), str(STEP), str(unit.references[PUSHED]), "-250"]
    words += [str(unit.references[name]) for name in names]
    done = subprocess.run([str(program), *words], env={}, capture_output=True, text=True, check=False, cwd="/")
    assert done.returncode == 0, done.stderr
    found = [[float.fromhex(word) for word in line.split()] for line in done.stdout.splitlines()]
    for k, values in enumerate(expected):
        assert dict(zip(names, found[k], strict=True)) == {name: values[name] for name in names}, f"step {k}"


@pytest.fixture(scope="module")
def plain_host(c_compiler: tuple[str, ...], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a host without Python."""
    program = tmp_path_factory.mktemp("plain") / "plain_host"
    subprocess.run([*c_compiler, "-O1", str(HERE / "plain_host.c"), "-o", str(program), "-ldl"], check=True)
    return program


@pytest.mark.full
@pytest.mark.parametrize("steps", [100, pytest.param(1000, marks=pytest.mark.slow)])
def test_a_host_in_c_without_python_has_the_bits_of_the_program(
    host: Any, exported: Export, tmp_path: Path, plain_host: Path, steps: int
) -> None:
    """Run a 6208 in an empty environment."""
    assert_bits_in_c(unit_of(host, exported, tmp_path), plain_host, CASE, steps)


@pytest.mark.full
@pytest.mark.parametrize(
    ("bearing", "axial"),
    [("SKF NU 208", "0 N"), ("SKF NJ 208", "300 N"), ("SKF NCF 3008", "0 N"), ("SKF 32216", "6 kN")],
)
def test_rollers_in_a_host_in_c_have_the_bits_of_the_program(
    host: Any, plain_host: Path, tmp_path: Path, bearing: str, axial: str
) -> None:
    """Compare the code of rollers in another process.

    It stands behind addresses, which processes do not share.
    """
    case = api.init_case("one", bearing=bearing, path=tmp_path / "one.toml", changes=[f"loads.axial={axial}"])
    file = api.export_fmu(case, CHANGES, out=tmp_path / "one.fmu", processor="native")
    assert_bits_in_c(host.Unit(file, tmp_path / "one"), plain_host, case, 30)


@pytest.mark.full
def test_the_temperature_of_an_fmu_of_rollers_varies(host: Any, c_compiler: tuple[str, ...], tmp_path: Path) -> None:
    """Warm the oil from 60 to 70 degC.

    What is left of the start at 60 degC after 3 ms is below 1 %.
    """
    case = api.init_case(
        "one", bearing="SKF NJ 208", path=tmp_path / "one.toml", changes=["lubricant.temperature=60 degC"]
    )
    vary = ("lubricant.temperature=40..80 degC",)
    file = api.export_fmu(case, CHANGES, out=tmp_path / "one.fmu", vary=vary, processor="native")
    instance = host.Instance(host.Unit(file, tmp_path / "one"))
    assert instance.set("lubricant.temperature", 343.15) == host.OK
    instance.ready()
    assert [instance.step(STEP) for _ in range(30)] == [host.OK] * 30
    warm = api.iterate(case, (*CHANGES, "lubricant.temperature=70 degC"), exact=True).step_to(30 * STEP)
    cold = api.iterate(case, CHANGES, exact=True).step_to(30 * STEP)
    for name in ("bearing.film_minimum", "bearing.film_parameter"):
        assert seen(warm)[name] < 0.9 * seen(cold)[name]
        assert instance.get([name])[0] == pytest.approx(seen(warm)[name], rel=0.01)


@pytest.mark.full
@pytest.mark.parametrize("couple", ["force", "motion"])
def test_the_next_version_has_the_same_bits(host: Any, exported: Export, tmp_path: Path, couple: str) -> None:
    units = [unit_of(host, exported, tmp_path, fmi, couple) for fmi in (2, 3)]
    (old, new), both = (unit.references for unit in units), units[0].references.keys() & units[1].references.keys()
    assert {name: old[name] for name in both} == {name: new[name] for name in both}
    outputs = [name for name in units[1].named("output") if name in both]
    assert len(outputs) > 30
    bearings = [host.Instance(unit).ready() for unit in units]
    name = PUSHED if couple == "force" else "inner_ring.z_rate"
    for bearing in bearings:
        assert [bearing.set(name, -1e-3), *(bearing.step(STEP) for _ in range(20))] == [0] * 21
    assert bearings[0].get(outputs) == bearings[1].get(outputs)


@pytest.mark.full
def test_a_prescribed_ring_has_the_bits_of_the_program(host: Any, exported: Export, tmp_path: Path) -> None:
    unit = unit_of(host, exported, tmp_path, 3, "motion")
    unit = host.Instance(unit).ready()
    bearing = api.iterate(CASE, CHANGES, exact=True, couple="motion")
    (z,) = unit.get(["inner_ring.z"])
    reactions = [f"{ring}.reaction_force_{axis}" for ring in ("inner_ring", "outer_ring") for axis in "xyz"]
    for k in range(30):
        rate = -2e-3 * math.sin(0.2 * k)
        for suffix, value in (("", z), ("_rate", rate), ("_acceleration", 0.5)):
            assert unit.set(f"inner_ring.z{suffix}", value) == host.OK
        bearing.give("inner_ring.z", z, rate, 0.5)
        z += rate * STEP
        expected = bearing.step_to(unit.time + STEP)
        assert unit.step(STEP) == host.OK
        assert unit.get(reactions) == [*expected.reactions["inner_ring"][:3], *expected.reactions["outer_ring"][:3]]
    assert unit.get(["bearing.friction_torque"])[0] == pytest.approx(1e-3 * expected.friction_torque_Nmm, rel=1e-12)


@pytest.mark.slow
def test_elastic_parts_have_the_bits_of_the_program(host: Any, c_compiler: tuple[str, ...], tmp_path: Path) -> None:
    """Push an elastic ring and cage on their way."""
    changes = (
        *CHANGES, "elastic.outer_ring.housing_stiffness=100 N/um", "elastic.outer_ring.orders=3",
        "elastic.cage.section_height=2 mm",
    )  # fmt: skip
    out = tmp_path / "elastic.fmu"
    api.export_fmu(CASE, changes, out=out, processor="native")
    unit = host.Unit(out, tmp_path / "elastic")
    instance, bearing = host.Instance(unit).ready(), api.iterate(CASE, changes, exact=True)
    for k in range(60):
        if k == 20:
            bearing.push((0.0, 0.0, -250.0))
            assert instance.set(PUSHED, -250.0) == host.OK
        expected = seen(bearing.step_to(instance.time + STEP))
        assert instance.step(STEP) == host.OK
        assert dict(zip(expected, instance.get(list(expected)), strict=True)) == expected, f"step {k}"


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
def test_states_and_instances(host: Any, exported: Export, tmp_path: Path, fmi: int) -> None:
    """Save, step, restore and step again.

    The bytes and another instance give the same; ten instances do not mix.
    """
    unit = unit_of(host, exported, tmp_path, fmi)
    outputs = unit.named("output")
    first = host.Instance(unit).ready()
    for _ in range(5):
        first.step(STEP)
    kept, bytes_, begin = first.save(), first.packed(), first.time
    first.set(PUSHED, -300.0)
    first.step(STEP)
    after = first.get(outputs)
    first.restore(kept, begin)
    assert first.packed() == bytes_
    first.set(PUSHED, -300.0)
    first.step(STEP)
    assert first.get(outputs) == after
    others = [host.Instance(unit).ready() for _ in range(10)]
    for k, other in enumerate(others):
        assert other.unpack(bytes_, begin) == host.OK
        other.set(PUSHED, -300.0 + k)
    for other in reversed(others):
        other.step(STEP)
    found = [other.get(outputs) for other in others]
    assert found[0] == after
    assert len({tuple(each) for each in found}) == len(others)
    assert first.unpack(bytes_[:-1], begin) == host.ERROR
    assert first.unpack(b"?" * len(bytes_), begin) == host.ERROR
    assert first.said[-1] == "these bytes are no state of this bearing"
    signs = (64 + 7, 64 + 8 * 900 + 7)  # of two numbers at once
    for places in ((64,), (len(bytes_) // 2,), (len(bytes_) - 1,), (60,), signs):  # 60: in the sum itself
        damaged = bytearray(bytes_)
        for place in places:
            damaged[place] ^= 0x80
        assert first.unpack(bytes(damaged), begin) == host.ERROR
        assert "damaged on its way" in first.said[-1]
    assert first.do("Reset") == host.OK


@pytest.mark.full
def test_two_threads_step_their_own_bearings_at_once(host: Any, exported: Export, tmp_path: Path) -> None:
    """Step two bearings in two threads in parallel.

    ctypes releases the other threads during a call.
    """
    unit = unit_of(host, exported, tmp_path)
    outputs = unit.named("output")

    def run(push: float) -> list[float]:
        bearing = host.Instance(unit).ready()
        assert bearing.set(PUSHED, push) == host.OK
        assert [bearing.step(STEP) for _ in range(40)] == [host.OK] * 40
        return list(bearing.get(outputs))

    pushes = [-100.0, -300.0]
    with ThreadPoolExecutor(2) as threads:
        at_once = list(threads.map(run, pushes))
    assert at_once == [run(push) for push in pushes]


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
def test_bad_use_is_answered_with_a_sentence(host: Any, exported: Export, tmp_path: Path, fmi: int) -> None:
    unit = unit_of(host, exported, tmp_path, fmi)
    stranger = host.Instance(unit, token=b"{other}")
    assert not stranger.handle
    assert "export the bearing again" in stranger.said[-1]
    calls = [stranger.step(STEP), stranger.set(PUSHED, 1.0), stranger.do("Reset"), stranger.do("Terminate")]
    assert [*calls, stranger.do("ExitInitializationMode")] == [host.ERROR] * 5  # a host that goes on without one
    bearing = host.Instance(unit)
    early = bearing.step(STEP)
    bearing.ready()
    lost = bearing.step(1e-320)
    assert bearing.step(STEP) == host.OK
    trials = {
        "between initialisation and the end": early,
        "inner_ring.force_z is to be nan N: must be finite": bearing.set(PUSHED, math.nan),
        "bearing.loss is no input": bearing.set("bearing.loss", 1.0),
        "must be positive and finite": bearing.step(-STEP),
        "from t = 0 s is lost in rounding": lost,
        "a step of 1e+300 s: 1000 s is the longest at once": bearing.step(1e300),
    }
    bearing.time -= STEP
    trials["but the bearing stands at 0.0001 s: to go back, restore a state"] = bearing.step(STEP)
    bearing.time += 2 * STEP
    trials["but the bearing stands at 0.0001 s: steps follow each other without a gap"] = bearing.step(STEP)
    bearing.time -= STEP
    unit.references["nothing"] = 999
    trials["there is no real variable with the value reference 999"] = bearing.set("nothing", 0.0)
    trials["initialisation has not begun"] = bearing.do("ExitInitializationMode")
    assert set(trials.values()) == {host.ERROR}
    for sentence in trials:
        assert any(sentence in said for said in bearing.said), sentence
    for along in (math.nan, math.inf):
        with pytest.raises(ArithmeticError, match=r"a slope along .* of inner_ring.force_z: must be finite"):
            bearing.slope("inner_ring.z", PUSHED, along)
    assert bearing.step(STEP) == host.OK  # none of this has harmed it
    assert bearing.set(PUSHED, 1e300) == host.OK
    assert bearing.step(STEP) == host.ERROR
    assert re.search(r"at t = \S+ s ", bearing.said[-1])
    assert bearing.do("Terminate") == host.OK
    assert bearing.set(PUSHED, 0.0) == host.ERROR
    assert bearing.said[-1] == "the simulation has ended: nothing can be set any more"


@pytest.mark.full
def test_time_may_begin_anywhere(host: Any, exported: Export, tmp_path: Path) -> None:
    unit = unit_of(host, exported, tmp_path)
    late, early = host.Instance(unit, start=5.0).ready(), host.Instance(unit).ready()
    assert [late.step(2.0**-13), early.step(2.0**-13)] == [host.OK, host.OK]
    assert late.get(["time"]) == [5.0 + 2.0**-13]
    assert late.get(["bearing.load"]) == early.get(["bearing.load"])


@pytest.mark.full
def test_what_no_bearing_takes_ends_with_a_sentence(host: Any, exported: Export, tmp_path: Path) -> None:
    """Refuse a force in other units with a message.

    Steps of picoseconds lead nowhere, however long a step the host asks for.
    """
    unit = unit_of(host, exported, tmp_path)
    bearing = host.Instance(unit).ready()
    kept = bearing.packed()
    for length in (2e-5, 1.0):
        assert bearing.set("inner_ring.force_x", 1e9) == host.OK
        assert bearing.step(length) == host.ERROR
        (spent,) = re.findall(r"(\d+) iterations are spent \(contact pressure", bearing.said[-1])
        assert 5000 < int(spent) < 10_000
        assert "are loads in N" in bearing.said[-1]
        assert bearing.unpack(kept, 0.0) == host.OK
    assert bearing.step(STEP) == host.OK


@pytest.mark.full
def test_the_library_asks_for_the_c_library_alone(exported: Export, tmp_path: Path) -> None:
    if shutil.which("nm") is None:
        pytest.skip("the program nm is not installed")
    for fmi, couple in ((2, "force"), (3, "motion")):
        with zipfile.ZipFile(exported(fmi, couple)) as archive:
            (name,) = (name for name in archive.namelist() if name.endswith(".so"))
            library = Path(archive.extract(name, tmp_path))
        listed = subprocess.run(["nm", "-D", "-u", str(library)], capture_output=True, text=True, check=True).stdout
        wanted = [line.split()[-1].partition("@")[0] for line in listed.splitlines()]
        assert [symbol for symbol in wanted if not PLAIN.fullmatch(symbol)] == []
        assert len(wanted) > 5
        command = ["nm", "-D", "--defined-only", str(library)]
        defined = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
        own = {line.split()[-1] for line in defined}
        assert {name for name in own if not name.startswith(f"fmi{fmi}")} == set()  # two bearings do not meet
        assert str(Path.cwd()).encode() not in library.read_bytes()  # and knows no folder of this machine
        assert library.stat().st_size < 1.5e6


@pytest.mark.full
@pytest.mark.parametrize(("fmi", "couple"), [(2, "force"), (3, "force"), (2, "motion"), (3, "motion")])
def test_the_standard_is_kept(exported: Export, fmi: int, couple: str) -> None:
    validation = pytest.importorskip("fmpy.validation", reason="FMPy is not installed: pip install fmpy")
    assert validation.validate_fmu(str(exported(fmi, couple))) == []


@pytest.mark.full
@pytest.mark.parametrize("fmi", [2, 3])
def test_fmpy_simulates_it(exported: Export, fmi: int) -> None:
    fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed: pip install fmpy")
    found = fmpy.simulate_fmu(str(exported(fmi, "force")), stop_time=5e-3, step_size=STEP, output_interval=STEP)
    bearing = api.iterate(CASE, CHANGES, exact=True)
    for row in found[1:]:
        step = bearing.step_to(row["time"])
        assert row["inner_ring.x"] == pytest.approx(step["body_position"][0, 0], rel=1e-9)


@pytest.mark.full
def test_units_say_what_one_of_them_is_in_si(host: Any, exported: Export, tmp_path: Path) -> None:
    """Define a unit for every variable, values in SI."""
    unit = unit_of(host, exported, tmp_path)
    values = dict(zip(names := unit.named("output"), host.Instance(unit).ready().get(names), strict=True))
    assert 100.0 < values["bearing.load"] < 2000.0  # [N]
    assert 1e9 < values["bearing.max_pressure"] < 3e9  # [Pa]
    assert 1e-8 < values["bearing.film_minimum"] < 5e-6  # [m]
    assert values["inner_ring.reaction_force_x"] == pytest.approx(-1300.0, rel=1e-3)
    text = (tmp_path / "force2" / "modelDescription.xml").read_text()
    used, defined = set(re.findall(r' unit="([^"]+)"', text)), set(re.findall(r'<Unit name="([^"]+)"', text))
    assert used
    assert used <= defined


@pytest.mark.full
def test_the_command_writes_it(c_compiler: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "bearing.fmu"
    command = ["export", "fmu", CASE, "-o", str(target), "--processor", "native", "--json", "--quiet"]
    assert main(command) == 0
    said = capsys.readouterr()
    assert json.loads(said.out) == {"file": str(target)}
    assert "this FMU has no parameters; --vary PATH=LOW..HIGH makes" in said.err
    assert main(command) == 2
    assert "overwrite it (--force" in capsys.readouterr().err
    with zipfile.ZipFile(target) as archive:
        assert {"modelDescription.xml", "resources/case.toml"} <= set(archive.namelist())


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"fmi": 1}, "FMI 1 is not supported: choose 2 or 3"),
        ({"couple": "forces"}, 'give "force" or "motion"'),
        ({"processor": "x86-64-v5"}, "nearest: x86-64-v"),
    ],
)
def test_what_cannot_be_exported_is_said(
    c_compiler: tuple[str, ...], tmp_path: Path, changes: dict[str, Any], words: str
) -> None:
    with pytest.raises(UsageError, match=words):
        api.export_fmu(CASE, out=tmp_path / "no.fmu", **changes)
    assert not list(tmp_path.iterdir())


def test_a_place_that_takes_no_file_is_refused_before_the_work(c_compiler: tuple[str, ...], tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not exist"):
        api.export_fmu(CASE, out=tmp_path / "nowhere" / "no.fmu", announce=pytest.fail)
    for overwrite in (False, True):
        with pytest.raises(UsageError, match="it is a folder"):
            api.export_fmu(CASE, out=tmp_path, overwrite=overwrite, announce=pytest.fail)


def test_code_that_needs_python_is_refused() -> None:
    """Refuse a function that needs Python.

    A stub in its place would silently give wrong numbers.
    """
    import llvmlite.binding as llvm

    from lambda_core.laws.jit.portable import _without_python

    text = "declare double @numba_gamma(double)\ndefine double @f(double %x) {\n"
    text += " %y = call double @numba_gamma(double %x)\n ret double %y\n}"
    with pytest.raises(LambdaError, match="my_law calls numba_gamma, which is not there without Python"):
        _without_python(llvm.parse_assembly(text), {"numba_gamma": "my_law"})


def test_every_law_runs_without_python() -> None:
    from lambda_core.laws.jit.portable import unknown

    laws = [law for role in ROLES for law in api.registry().models(role).values()]
    found = {law.label: unknown(compile_kernel(law).pointer) for law in laws}
    assert {label: names for label, names in found.items() if names} == {}


@pytest.mark.slow
def test_the_compiler_of_the_extra_builds_the_same(
    host: Any, exported: Export, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("ziglang", reason="the extra fmu is not installed")
    monkeypatch.setattr("lambda_core.export.fmu.library._COMPILERS", ())
    file = api.export_fmu(CASE, CHANGES, out=tmp_path / "zig.fmu", processor="native")
    units = unit_of(host, exported, tmp_path), host.Unit(file, tmp_path / "zig")
    bearings = [host.Instance(unit).ready() for unit in units]
    assert [bearing.step(STEP) for bearing in bearings for _ in range(20)] == [host.OK] * 40
    outputs = units[0].named("output")
    assert bearings[0].get(outputs) == pytest.approx(bearings[1].get(outputs), rel=1e-6, abs=1e-12)


@pytest.mark.slow
def test_another_processor_has_the_bits_of_its_own_program(host: Any, c_compiler: Any, tmp_path: Path) -> None:
    """Compile all anew for x86-64-v3.

    Only the last digits differ from the code of this machine.
    """
    unit = host.Unit(api.export_fmu(CASE, CHANGES, out=tmp_path / "v3.fmu"), tmp_path / "v3")
    bearing, here = host.Instance(unit).ready(), api.iterate(CASE, CHANGES, exact=True)
    for _ in range(10):
        step = here.step_to(bearing.time + STEP)
        assert bearing.step(STEP) == host.OK
    assert bearing.get(["inner_ring.x"])[0] == pytest.approx(float(step["body_position"][0, 0]), rel=1e-6)
    assert np.isfinite(bearing.get(unit.named("output"))).all()
