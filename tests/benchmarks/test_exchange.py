"""Test the page of exchanged laws.

No law left out, and the numbers are those of today's program.
"""

from __future__ import annotations

import re

import pytest

from benchmarks.exchange import EXCHANGES, PAGE, main, overrides, quasistatic_torque
from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.installed import OWN
from lambda_core.domain.roles import MOTION_ROLES


def of_role(role: str) -> list[str]:
    return [
        name
        for name, law in registry().models(role).items()
        if registry().origin(role, name).split(" ")[0] == OWN and law.contact != "line"
    ]


def test_every_built_in_law_of_every_role_is_exchanged() -> None:
    # a role of which the program has one law, contact_state, has nothing to exchange
    assert [exchange.role for exchange in EXCHANGES] == [role for role in MOTION_ROLES if len(of_role(role)) > 1]
    for exchange in EXCHANGES:
        assert sorted(law.name for law in exchange.laws) == sorted(of_role(exchange.role))


def sections() -> dict[str, dict[str, list[str]]]:
    """Return role -> law -> cells.

    They are those of its line on the page.
    """
    found: dict[str, dict[str, list[str]]] = {}
    for part in PAGE.read_text(encoding="utf-8").split("\n## ")[1:]:
        role, _, rest = part.partition("\n")
        rows = [line.strip("| ").split(" | ") for line in rest.splitlines() if line.startswith("| ")][1:]
        found[role] = {cells[0].strip("*"): cells[1:] for cells in rows}
    return found


def test_every_law_is_on_the_page() -> None:
    found = sections()
    for exchange in EXCHANGES:
        assert list(found[exchange.role]) == [law.name for law in exchange.laws]
        assert all(len(cells) == 7 for cells in found[exchange.role].values())


@pytest.mark.parametrize("exchange", EXCHANGES, ids=lambda exchange: exchange.role)
def test_the_choice_reaches_the_force_elements(exchange: object) -> None:
    for law in exchange.laws:  # type: ignore[attr-defined]
        model = api.check("6319-cp10-1500", overrides(exchange, law))  # type: ignore[arg-type]
        names = [roles[exchange.role].model.name for roles in model.laws.values() if exchange.role in roles]  # type: ignore[attr-defined]
        assert law.name in names


@pytest.mark.parametrize("role", ["film_thickness", "elastic_hysteresis", "traction", "asperity_load", "fluid_drag"])
def test_the_page_is_of_today(role: str) -> None:
    """Compute quasi-static torques for some roles and compare the page.

    `python -m benchmarks.exchange --write` renews it.
    """
    exchange = next(each for each in EXCHANGES if each.role == role)
    rows = sections()[role]
    base = quasistatic_torque(overrides(exchange, exchange.laws[0]))
    assert base == pytest.approx(float(rows[exchange.laws[0].name][0]), rel=1e-3)
    for law in exchange.laws[1:]:
        text = rows[law.name][0]
        printed = 0.0 if text == "=" else float(re.sub("[ %]", "", text))
        change = 100.0 * (quasistatic_torque(overrides(exchange, law)) / base - 1.0)
        assert change == pytest.approx(printed, abs=0.1 + 0.01 * abs(change))


def test_one_role_alone_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["contact_temperature"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("## contact_temperature\n")
    assert "| **shear-heating** |" in out
    assert "| isothermal |" in out
    with pytest.raises(SystemExit):
        main(["tracton"])
    assert "there is no role tracton" in capsys.readouterr().err
