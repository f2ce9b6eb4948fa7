"""Test films that their own capacitance gives back."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.analysis.electric.contacts import equilibria
from lambda_core.analysis.electric.inversion import FilmModel
from lambda_core.domain.errors import UsageError


@pytest.mark.parametrize("law", ["schneider", "gap-integral"])
@pytest.mark.parametrize("scale", [0.3, 1.0, 2.0])
def test_own_film_is_found_again(law: str, scale: float) -> None:
    """Find the film to 1e-6 with its own law."""
    model = api.check("6208-axial-1300", ["loads.radial=1 kN", f"models.capacitance={law}"])
    films = FilmModel(equilibria(model, 2), 4e-12)
    assert films.scale(films.capacitance(scale)) == pytest.approx(scale, rel=1e-6)
    assert -1.0 <= films.slope(scale) < -0.4


@pytest.mark.full
def test_starved_bearing_is_recognised(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Recognise a film of 60 % in a flooded case.

    The given capacitance is that of the starved bearing.
    """
    starved = FilmModel(equilibria(api.check("6208-axial-1300", ["lubricant.starvation=0.6"]), 1), 0.0)
    rings = api.electric("6208-axial-1300", ["electric.duration=2 ms"]).circuit.bearings[0].rings
    value = 1e12 * (starved.capacitance(1.0) + rings)
    (tmp_path / "m.csv").write_text("time [s],capacitance [pF]\n" + "".join(f"{i},{value!r}\n" for i in range(5)))
    arguments = ["electric-film", "6208-axial-1300", str(tmp_path / "m.csv"), "--quiet"]
    assert main([*arguments, "--json", "--uncertainty", "0.05"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["starvation"] == pytest.approx(0.6, rel=2e-3)
    assert found["film_scale_uncertainty"] == pytest.approx(0.05 * 0.6 / abs(found["sensitivity"]), rel=2e-3)
    assert main(["electric-film", "6208-axial-1300", str(tmp_path / "m.csv"), "--quiet", "--units", "us"]) == 0
    text = capsys.readouterr().out
    assert " uin" in text
    assert " um" not in text
    omega = 6.283185307179586 * 1e4
    (tmp_path / "z.csv").write_text(
        "time [s],impedance [kOhm]\n" + "".join(f"{i},{1e-3 / (omega * value * 1e-12)!r}\n" for i in range(5))
    )
    assert main(["electric-film", "6208-axial-1300", str(tmp_path / "z.csv"), "--frequency", "10 kHz", "--quiet"]) == 0
    assert "starvation       0.6" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time [s],capacitance [pF]\n0,200\n1,200\n2,200\n500,200\n", "line 5: a gap"),
        (
            "time [s],capacitance [pF]\n0,200\n1,-3\n2,200\n",
            "line 3: a capacitance or impedance must be greater than 0",
        ),
        ("time [s],capacitance [pF]\n\n0,200\n\n1,-3\n2,200\n", "line 5: a capacitance or impedance must be"),
        ("time [s],capacitance [pF]\n0,2\n1,2\n2,2\n", "corresponds to no film"),
        ("time,capacitance\n0,2\n1,2\n2,2\n", "must name both columns with units"),
        ("time [s],impedance [kOhm]\n0,2\n1,2\n2,2\n", "give their frequency"),
    ],
)
def test_mistakes_are_named(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text(text)
    with pytest.raises(UsageError) as caught:
        api.film_from_capacitance("6208-axial-1300", tmp_path / "m.csv")
    assert words in str(caught.value)
