"""Test result files.

What other programs see in them, and what a damaged one is answered with.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import h5py
import pytest
from fake_engine import FakeEngine, MakeProvenance, Truth

from lambda_core.domain.channels import CHANNELS, LOSSES
from lambda_core.domain.errors import UsageError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.opening import ResultError, opened
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.runs.loop import run
from lambda_core.runs.progress import Progress


@pytest.fixture(scope="module")
def content(resolved: BearingModel, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the bytes of a finished result."""
    model = replace(resolved, solver=replace(resolved.solver, duration=0.12))
    path = tmp_path_factory.mktemp("content") / "r.h5"
    return run(FakeEngine(Truth(noise=0.1)), Provenance.alone(model, {"core": "abc"}), path).path.read_bytes()


@pytest.fixture
def result(content: bytes, tmp_path: Path) -> Result:
    path = tmp_path / "r.h5"
    path.write_bytes(content)
    return Result(path)


def test_every_channel_has_unit_meaning_and_named_dimensions(result: Result) -> None:
    found = {channel.name: channel for channel in result.channels}
    assert found == {channel.name: channel for channel in CHANNELS}
    with h5py.File(result.path) as file:
        growing = [item for item in _datasets(file) if item.maxshape and item.maxshape[0] is None]
        assert len(growing) > len(CHANNELS)
        for item in growing:
            assert item.attrs["units"]
            assert item.attrs["long_name"]
            assert item.is_scale or all(len(dim) == 1 for dim in item.dims), item.name


def test_a_block_that_has_a_result_open_does_not_open_it_again(result: Result) -> None:
    with opened(result.path) as outer:
        with opened(result.path) as inner:
            assert inner is outer
        with pytest.raises(ResultError, match="is damaged"), opened(result.path) as inner:
            inner["nothing"]
        assert outer  # open until the block ends that opened it
    assert not outer


def _datasets(file: h5py.File) -> list[h5py.Dataset]:
    found: list[h5py.Dataset] = []
    file.visititems(lambda _, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
    return found


@pytest.mark.full
def test_opens_with_xarray_in_one_line(result: Result) -> None:
    import xarray

    with xarray.open_dataset(result.path, engine="h5netcdf") as data:
        assert data["load"].dims == ("time", "ball", "ring")
        assert data["load"].attrs["units"] == "N"
        chosen = data["load"].sel(ball=2, ring="outer")
        assert (chosen.values == result["load"][:, 1, 1]).all()
        assert data["loss"].sel(mechanism="drag").values == pytest.approx(result["loss"][:, LOSSES.index("drag")])
    for group, size in (("integrals", "time"), ("revolutions", "revolution"), ("inputs/laws", "row")):
        with xarray.open_dataset(result.path, engine="h5netcdf", group=group) as data:
            assert data.sizes[size] > 1


def test_gives_xarray_and_pandas(result: Result) -> None:
    data = result.to_xarray()
    assert data["film_central"].attrs == {"units": "m", "long_name": "central film thickness, thermally corrected"}
    assert (data["film_central"].sel(ball=9, ring="inner").values == result["film_central"][:, 8, 0]).all()
    frame = result.to_pandas("load", "input_torque")
    assert (frame["load/2/outer"].to_numpy() == result["load"][:, 1, 1]).all()
    assert (frame.index.to_numpy() == result["time"]).all()
    assert len(result.to_pandas().columns) > 400


def test_carries_what_it_came_from(result: Result, resolved: BearingModel) -> None:
    assert result.values == resolved.values
    assert result.assumptions == resolved.assumptions
    assert result.case_toml == resolved.case_toml
    assert result.model["geometry"]["ball_diameter"] == resolved.geometry.ball_diameter
    assert result.model["solver"]["max_wall"] == "inf"
    assert result.kernel_keys == {"core": "abc"}
    assert {"numba", "h5py", "python", "lambda-bearing"} <= set(result.versions)
    laws = {(row["element"], row["role"]): row for row in result.laws}
    assert len(laws) == sum(len(roles) for roles in resolved.laws.values())
    assert laws["ball_inner", "traction"]["model"] == "ree-eyring"
    assert laws["ball_inner", "traction"]["reference"]


def test_summary_fields_are_attributes(result: Result) -> None:
    assert result.friction_torque_Nmm == result.summary().friction_torque_Nmm
    assert result.contacts[0].ring == "inner"
    with pytest.raises(AttributeError, match="a result has no frction"):
        _ = result.frction


def test_unknown_channel_names_the_nearest(result: Result) -> None:
    with pytest.raises(UsageError, match='"film_centrl" is not a known channel; nearest: film_central'):
        _ = result["film_centrl"]


def test_a_growing_result_is_read_by_another_process(provenance: MakeProvenance, tmp_path: Path) -> None:
    """Read a result between two flushes.

    The viewer has a process of its own.
    """
    path = tmp_path / "live.h5"
    seen: list[str] = []
    code = (
        "import sys; from lambda_core.results.reader import Result; r = Result(sys.argv[1]); "
        "s = r.summary(); print(s.state, r.status().alive(), len(r['time']) > 0, s.friction_torque_Nmm is not None)"
    )

    def look(progress: Progress) -> None:
        if not seen and progress.wall_s > 1.3:  # rows are flushed every second
            done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=False)
            seen.append(done.stdout.strip() + done.stderr)

    run(FakeEngine(Truth(slowness=5e-3)), provenance(duration=0.15), path, report=look)
    assert seen == ["running True True True"]


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"no\.h5 does not exist"):
        Result(tmp_path / "no.h5")
    with pytest.raises(ResultError, match="is a folder"):
        Result(tmp_path)


@pytest.mark.parametrize("other", [b"", b"name = 'a case'\n", bytes(range(256)) * 40])
def test_a_file_that_is_not_hdf5(other: bytes, tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    path.write_bytes(other)
    with pytest.raises(ResultError, match="is not a result file"):
        Result(path)


def test_an_hdf5_file_of_another_program(tmp_path: Path) -> None:
    path = tmp_path / "other.h5"
    with h5py.File(path, "w") as file:
        file["x"] = 1.0
    with pytest.raises(ResultError, match="is an HDF5 file, but not a result of lambda-bearing"):
        Result(path)


def test_a_file_without_the_energy_of_dampers_to_the_ground_is_read(result: Result) -> None:
    """Read files from before an energy integral existed.

    They were called damaged.
    """
    before = result.summary()
    with h5py.File(result.path, "r+") as file:
        for group in ("integrals", "revolutions"):
            del file[f"bearings/bearing/{group}/support"]
        del file["bearings/bearing/support_power"]
    again = Result(result.path)
    assert again.summary() == before
    assert "friction torque" in again.summary().text()


def test_a_layout_of_another_version(result: Result) -> None:
    with h5py.File(result.path, "r+") as file:
        file.attrs["lambda_bearing_layout"] = 99
    with pytest.raises(ResultError, match="has layout 99; this program reads layout 2"):
        Result(result.path)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999])
def test_a_truncated_file_says_so_wherever_it_is_cut(share: float, result: Result) -> None:
    data = result.path.read_bytes()
    result.path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(ResultError, match=r"r\.h5 (is damaged|cannot be read)"):
        _read_everything(result.path)


@pytest.mark.parametrize("seed", range(20))
def test_a_garbled_file_gives_values_or_a_message(seed: int, result: Result) -> None:
    """Garble a file by four kilobytes of noise.

    HDF5 finds it or it lies in the samples; there is no other exception.
    """
    import random

    chance = random.Random(seed)
    data = bytearray(result.path.read_bytes())
    start = chance.randrange(0, len(data) - 4096)
    data[start : start + 4096] = chance.randbytes(4096)
    result.path.write_bytes(bytes(data))
    try:
        _read_everything(result.path)
    except ResultError as error:
        assert "r.h5" in str(error)  # noqa: PT017


def _read_everything(path: Path) -> None:
    found = Result(path)
    found.summary()
    for channel in found.channels:
        _ = found[channel.name]
    _ = (found.values, found.laws, found.case_toml, found.assumptions, found.checkpoint(), found.integrals())
