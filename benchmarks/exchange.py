"""Exchange every law in a run of the 6319.

``python -m benchmarks.exchange``: one law at a time.

Everything else stays as it is. Where the standard run would not ask a role (a full film carries no load on asperities),
or a law needs an oil with data of its own, the whole table of the role has another set-up, which it names.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.roles import MOTION_ROLES
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import solve

PAGE = Path(__file__).parent.parent / "docs" / "models-exchanged.md"
CASE = "6319-cp10-1500"
BEGIN, END = 0.1, 0.5  # [s] one turn of the cage is left out, four are averaged


@dataclass(frozen=True)
class Law:
    """One law of a role.

    With the changes that make a case use it.
    """

    name: str
    overrides: tuple[str, ...] = ()  # in addition to the choice of the model
    chosen_by: str = ""  # the option that chooses it, where it is not models.ROLE
    note: str = ""


@dataclass(frozen=True)
class Exchange:
    """Laws of one role.

    The others are compared with the first of them.
    """

    role: str
    laws: tuple[Law, ...]
    setup: tuple[str, ...] = ()
    why: str = ""  # the set-up in words


ROUGH = ("surface.roughness=0.8 um",)
IN_ROUGH = "Set-up: composite roughness 0.8 um, so that asperities carry a part of the load."
SHARED = (*ROUGH, "models.asperity_load=zhou-hoeprich")
IN_SHARED = IN_ROUGH[:-1] + "; asperity_load = zhou-hoeprich, a share of the load."
SCHEUERMANN = ("parameters.elastic_hysteresis.coefficient=2e-7", "parameters.elastic_hysteresis.exponent=1.33")
OUTER = "forces.ball_outer"
RING_GUIDED = ("bodies.cage.guidance=outer ring", "bodies.cage.land_clearance=0.3 mm")

EXCHANGES: tuple[Exchange, ...] = (
    Exchange("normal_contact", (Law("hamrock-brewe"), Law("hertz-exact"))),
    Exchange("damping", (Law("squeeze-film"), Law("cubic"), Law("hunt-crossley"), Law("none"))),
    Exchange(
        "rheology",
        (
            Law("vogel-dicke"),
            Law("roelands"),
            Law("barus-limited"),
            Law("bode", ("lubricant.name=bode-mineral",), note="another oil of ISO VG 100: FVA3A has no data for it"),
        ),
    ),
    Exchange("film_thickness", (Law("chittenden"), Law("hamrock-dowson"))),
    Exchange("thermal_correction", (Law("murch-wilson"), Law("zhu-cheng"), Law("none"))),
    Exchange(
        "supply",
        (
            Law("skf-replenishment"),
            Law("constant"),
            Law("inlet-distance", ("parameters.supply.distance=2",), note="inlet meniscus two semi-axes b ahead"),
            Law("oil-layer", ("parameters.supply.layer=0.5 um",), note="a layer of 0.5 um on the track"),
            Law(
                "side-flow",
                ("parameters.supply.layer=5 um", "parameters.supply.time=10 min"),
                note="ten minutes on a layer of 5 um that nothing renews",
            ),
        ),
    ),
    Exchange("contact_temperature", (Law("shear-heating"), Law("isothermal"))),
    Exchange("traction", (Law("ree-eyring"), Law("bair-winer"), Law("newtonian"))),
    Exchange(
        "rolling_resistance",
        (
            Law("biboulet-houpert"),
            Law("biboulet-houpert-point"),
            Law("goksem-hargreaves"),
            Law("matsuyama"),
            Law("zhou-hoeprich"),
            Law("aihara"),
            Law("none"),
        ),
    ),
    Exchange(
        "elastic_hysteresis",
        (
            Law("loss-factor"),
            Law("houpert"),
            Law("scheuermann", SCHEUERMANN, note="c_r 2e-7 N m, e_r 1.33: chosen for this table, none are published"),
            Law("none"),
        ),
    ),
    Exchange("asperity_load", (Law("spikes-olver"), Law("zhou-hoeprich"), Law("none")), ROUGH, IN_ROUGH),
    Exchange("boundary_friction", (Law("micro-slip"), Law("cubic"), Law("coulomb-regularised")), ROUGH, IN_ROUGH),
    Exchange("mixing", (Law("load-share"), Law("contact-area")), SHARED, IN_SHARED),
    Exchange(
        "cage_contact",
        (
            Law("spherical-pocket"),
            Law(
                "cylindrical-pocket",
                RING_GUIDED,
                "forces.ball_cage.models.cage_contact",
                "with the outer ring's land, clearance 0.3 mm: alone it would not hold the cage",
            ),
            Law("land-guidance", RING_GUIDED, "forces.cage_outer.models.cage_contact", "with spherical pockets"),
            Law("ball-ball", ("depth.cage=false",), "forces.ball_ball.models.cage_contact", "no cage"),
            Law(
                "none",
                ("depth.cage=false",),
                "forces.ball_ball.models.cage_contact",
                "no cage, and balls that do not feel each other",
            ),
        ),
    ),
    Exchange(
        "fluid_drag",
        (
            Law("skf-catalogue"),
            Law("schaeffler-catalogue"),
            Law("sphere-drag"),
            Law(
                "cavity-mixture",
                ("parameters.fluid_drag.oil_share=0.05",),
                note="oil in 5 % of the cavity, as a jet leaves it",
            ),
            Law("none"),
        ),
    ),
    Exchange(
        "permittivity",
        (Law("bode"), Law("constant")),
        ("lubricant.name=bode-mineral",),
        "Set-up: the oil of Table 5 of the paper, the only one with Bode's data.",
    ),
    Exchange("capacitance", (Law("schneider"), Law("constant-factor"), Law("gap-integral"))),
    Exchange(
        "surface",
        (
            Law("none"),
            Law(
                "waviness",
                (f"{OUTER}.parameters.surface.waves=9", f"{OUTER}.parameters.surface.amplitude=1 um"),
                f"{OUTER}.models.surface",
                "outer ring, 9 waves of 1 um",
            ),
            Law(
                "defect",
                (f"{OUTER}.parameters.surface.width=1 mm", f"{OUTER}.parameters.surface.depth=20 um"),
                f"{OUTER}.models.surface",
                "outer ring, in the middle of the load, 1 mm long",
            ),
        ),
    ),
)


@dataclass(frozen=True)
class Numbers:
    """Compared numbers of a run."""

    quasistatic: float  # friction torque of the equilibrium, without cage [N mm]
    torque: float  # friction torque [N mm]
    pressure: float  # largest p_max [GPa]
    film: float  # smallest central film [um]
    temperature: float  # highest mean temperature of a film [degC]
    capacitance: float  # of the bearing, mean [nF]
    cage: float  # slip: 1 less the speed of the cage, or of the balls without one, over the epicyclic speed [%]


COLUMNS = (
    "quasi-static torque N mm",
    "torque N mm",
    "p_max GPa",
    "film um",
    "film degC",
    "capacitance nF",
    "cage slip %",
)


def overrides(exchange: Exchange, law: Law) -> tuple[str, ...]:
    """Return what turns the built-in case into this one."""
    choice = f"{law.chosen_by or f'models.{exchange.role}'}={law.name}"
    return (*exchange.setup, *law.overrides, choice)


def quasistatic_torque(changes: Sequence[str]) -> float:
    """Return the friction torque of the equilibrium [N mm]."""
    found = solve(api.check(CASE, changes))
    return 1e3 * float(found.losses.sum()) / found.relative_speed


def measure(changes: Sequence[str]) -> Numbers:
    """Run the case with these overrides."""
    model = api.check(CASE, changes)
    engine = BearingEngine(model)
    before = _advance(engine, BEGIN)
    engine.samples()
    after = _advance(engine, END)
    samples, spent = engine.samples(), {name: after[name] - before[name] for name in after}
    loaded = samples["load"] > 0.01 * samples["load"].max()
    ratio = model.geometry.ball_diameter / model.geometry.pitch_diameter
    capacitance = samples["bearing_capacitance"]
    return Numbers(
        quasistatic_torque(changes),
        1e3 * sum(spent[f"loss.{name}"] for name in LOSSES) / spent["relative_angle"],
        1e-9 * float(samples["max_pressure"].max()),
        1e6 * float(samples["film_central"][loaded].min()),
        float(samples["film_temperature"][loaded].max()) - 273.15,
        1e9 * float(np.mean(capacitance[np.isfinite(capacitance)])) if np.isfinite(capacitance).any() else math.nan,
        100.0 * (1.0 - spent["cage_angle"] / spent["inner_angle"] / (0.5 * (1.0 - ratio))),
    )


def _advance(engine: BearingEngine, until: float) -> dict[str, float]:
    done = engine.advance(until)
    if not done.ok:
        raise RuntimeError(done.message)
    return engine.integrals()


def _row(name: str, found: Numbers, base: Numbers | None) -> str:
    """Return a line of the table.

    Numbers of the first law, then the changes by the others.
    """
    if base is None:
        texts = [f"{found.quasistatic:.1f}", f"{found.torque:.1f}", f"{found.pressure:.3f}", f"{found.film:.3f}"]
        texts += [f"{found.temperature:.1f}", _number(found.capacitance), f"{found.cage:.2f}"]
        return f"| **{name}** | {' | '.join(texts)} |"
    texts = [_change(getattr(found, key), getattr(base, key)) for key in ("quasistatic", "torque", "pressure", "film")]
    texts += [_shift(found.temperature - base.temperature, "K"), _change(found.capacitance, base.capacitance)]
    return f"| {name} | {' | '.join([*texts, _shift(found.cage - base.cage, '', 2)])} |"


def _number(value: float) -> str:
    return f"{value:.4f}" if math.isfinite(value) else "shorted"


def _change(value: float, base: float) -> str:
    if not math.isfinite(value) or not math.isfinite(base):
        return _number(value)
    change = 100.0 * (value / base - 1.0)
    return "=" if abs(change) < 0.05 else f"{change:+.1f} %"


def _shift(value: float, unit: str, digits: int = 1) -> str:
    return "=" if abs(value) < 0.5 * 10.0**-digits else f"{value:+.{digits}f} {unit}".rstrip()


def section(exchange: Exchange) -> list[str]:
    """Return the page's part of a role.

    Runs every law of the role.
    """
    summary = MOTION_ROLES[exchange.role].summary
    lines = [f"## {exchange.role}", "", f"{summary[:1].upper()}{summary[1:]}."]
    lines += [exchange.why] if exchange.why else []
    lines += ["", f"| law | {' | '.join(COLUMNS)} |", f"|---|{'---|' * len(COLUMNS)}"]
    base: Numbers | None = None
    for law in exchange.laws:
        found = measure(overrides(exchange, law))
        lines.append(_row(law.name, found, base))
        base = base or found
    notes = [f"- {law.name}: {law.note}." for law in exchange.laws if law.note]
    return [*lines, "", *notes, *([""] if notes else [])]


def page() -> str:
    """Run everything and return the page."""
    text = [
        "# Effect of each law",
        "",
        "This page shows the effect of every law, for readers who choose one. The built-in case",
        f"`{CASE}` (6319, 16 kN radial, 1500 rpm, FVA3A at 62.5 degC) ran once for every law",
        "of every role, while all other roles kept theirs. The first line of a table has the numbers, the others what",
        f"changes; `=` is below the last digit. Runs are averaged from {BEGIN:g} to {END:g} s, four turns of the cage;",
        "the torque of such a run is known to about 0.3 %. `film` is the smallest central film, `film degC` the",
        "highest mean temperature of a film, which scatters by 0.3 K with the impacts of the cage and by 1 K with a",
        "defect, capacitance that of the bearing, cage slip what the speed of the cage (without one, of the balls)",
        "lacks of the epicyclic speed. Written by `python -m benchmarks.exchange --write`.",
        "",
    ]
    for exchange in EXCHANGES:
        text += section(exchange)
    return "\n".join(text).rstrip() + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the page, or write it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.exchange", description=__doc__)
    parser.add_argument("roles", nargs="*", metavar="ROLE", help="print only these roles")
    parser.add_argument("--write", action="store_true", help="write docs/models-exchanged.md")
    options = parser.parse_args(arguments)
    unknown = sorted(set(options.roles) - {exchange.role for exchange in EXCHANGES})
    if unknown:
        parser.error(f"there is no role {', '.join(unknown)}; roles: {', '.join(MOTION_ROLES)}")
    if options.write:
        PAGE.write_text(page(), encoding="utf-8")
    elif options.roles:
        for exchange in EXCHANGES:
            if exchange.role in options.roles:
                print("\n".join(section(exchange)))
    else:
        print(page(), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
