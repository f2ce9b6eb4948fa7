"""Test a shaft's result of a stranger.

What its texts say to a terminal is shown, and does nothing.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core.model.machine_templates import shaft_text

ESCAPE = "\x1b]0;owned\x07\x9b2J\u202e"
MORE = """
[bodies.box]
x = "100 mm"
length = "50 mm"
diameter = "20 mm"
[bodies.box.support]
x = "locked"
y = "locked"
z = "1 N/um"
tilt_x = "locked"
tilt_y = "locked"
tilt_z = "locked"
[markers.tip]
x = "150 mm"
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a run of a tenth of a millisecond."""
    found = tmp_path_factory.mktemp("escapes")
    (found / "box.toml").write_text(shaft_text("geared-shaft", "box") + MORE)
    arguments = ["--quiet", "--out", str(found / "run.h5"), "--duration", "0.1 ms"]
    assert main(["run", str(found / "box.toml"), *arguments]) == 5
    return found / "run.h5"


def texts(file: h5py.File) -> Iterator[tuple[str, str]]:
    """Yield every text of a file.

    Of a dataset, or of an object and attribute.
    """
    objects = [("/", file)]
    file.visititems(lambda name, item: objects.append((name, item)))
    for name, item in objects:
        yield from ((name, key) for key, value in item.attrs.items() if isinstance(value, str))
        if isinstance(item, h5py.Dataset) and (h5py.check_string_dtype(item.dtype) or item.dtype.kind == "S"):
            yield name, ""


def spoil(file: h5py.File, name: str, key: str) -> None:
    """Put an escape into a text.

    Everywhere in a file.
    """
    item = file[name]
    if key:
        item.attrs[key] = f"{item.attrs[key]}{ESCAPE}"
    elif item.dtype.kind == "S":
        changed = {"message": ESCAPE, "statistics": {ESCAPE: 1.0}, "faults": [ESCAPE]}
        item[()] = json.dumps(json.loads(item[()]) | changed, ensure_ascii=False).encode()
    elif not item.shape:
        item[()] = f"{item.asstr()[()]}{ESCAPE}"
    else:
        item[()] = np.array([f"{text}{ESCAPE}" for text in item.asstr()[()]], dtype=object)


@pytest.mark.full
def test_no_text_of_a_machine_s_result_drives_the_terminal(
    made: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Show or refuse control characters in each text.

    Every command then writes all texts that are shown.

    The second bearing has the texts of the first.
    """
    with h5py.File(made) as file:
        names = dict.fromkeys(text for text in texts(file) if text[1] not in ("units", "long_name"))
        found = [text for text in names if "inputs/" not in text[0] or "machine/" in text[0]]
    found = [text for text in found if not text[0].startswith("bearings/right")]
    assert len(found) > 12
    driven, shown, run = [], [], tmp_path / "run.h5"

    def ask(spoilt: list[tuple[str, str]], *commands: list[str]) -> int:
        shutil.copy(made, run)
        with h5py.File(run, "r+") as file:
            for text in spoilt:
                spoil(file, *text)
        for command in commands:
            code = main([*command, str(run)])
            assert code in (0, 2, 3, 5), (spoilt, command)
            said = "".join(capsys.readouterr())
            driven.extend((spoilt, command) for sign in "\x1b\x07\x9b\u202e" if sign in said)
        return code

    for text in found:
        if ask([text], ["show"]) == 0:
            shown.append(text)
        else:
            ask([text], ["resume", "--quiet"])
    assert shown
    ask(shown, ["show", "--json"], ["show", "--bearing", "left"], ["cite"], ["resume", "--quiet"])
    assert not driven
