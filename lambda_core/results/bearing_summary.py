"""Declare the summary of one bearing of a run."""

from __future__ import annotations

from pydantic import Field

from lambda_core.formulas.loading import Ring
from lambda_core.results.currents import Currents
from lambda_core.results.event_rows import EventSeen, ObserverNumber
from lambda_core.results.limits import Shoulder
from lambda_core.results.model_band import Banded
from lambda_core.results.quantity import FLOATING, quantity
from lambda_core.results.rating import Rating
from lambda_core.results.record import Record
from lambda_core.results.ring_deformation import RingDeformation
from lambda_core.results.verdict import Verdict


class Contact(Record):
    """Contact of an element with a raceway at the end."""

    element: int = Field(description="number of the ball or roller, from 1")
    ring: Ring
    azimuth_deg: float = Field(description="azimuth of the element from +y towards +z, 0..360")
    load_N: float
    contact_angle_deg: float
    film_um: float | None = Field(description="central film thickness; null without contact")
    capacitance_pF: float | None = Field(description="null where asperities short the contact")


CONTACT_UNITS = {
    "azimuth_deg": "deg", "load_N": "N", "contact_angle_deg": "deg", "film_um": "um", "capacitance_pF": "pF",
}  # fmt: skip


class StartState(Record):
    """The quasi-static state that the run started from."""

    loaded_elements: int = quantity(
        "rolling elements that the inner ring loads with more than 1 % of its largest contact load",
        label="rolling elements that the inner ring loads", column="loaded elements", decimals=0, group="contact",
    )  # fmt: skip
    max_load_N: float = quantity(
        "largest contact load, of both rings", "N", label="largest contact load of both rings", column="Q_max",
        decimals=0, digits=4, group="contact",
    )  # fmt: skip
    max_load_ring: Ring = Field(description="the ring with the largest contact load")
    max_pressure_GPa: float = quantity(
        "largest Hertzian pressure", "GPa", label="largest contact pressure", column="p_max", decimals=3,
        group="contact",
    )  # fmt: skip


class BearingSummary(Banded):
    """Averages of one bearing and its end state.

    The averages cover whole cage revolutions.

    A number that does not exist yet (an average before the first whole cage revolution) is null.
    """

    title: str
    headline: str = Field(
        description="lines: bearing and oil; loads, speed and depth; laws of plugins, where there are any"
    )
    converged: bool = Field(description="whether its averages are known as well as the run needs them")
    reasons: list[str] = Field(description="why they are not; empty when they are")
    full_complement: bool = Field(
        description="whether rollers have no cage: then numbers of the cage are those of the rollers as they go round, "
        "and its friction is that of neighbours",
        default=False,
    )

    friction_torque_Nmm: float | None = quantity(
        "dissipated power over |Omega_i - Omega_o|",
        "N mm",
        label="friction torque",
        column="friction torque",
        digits=4,
        group="friction",
    )
    friction_torque_ci_Nmm: float | None = quantity(
        "95 % confidence half-width of friction_torque_Nmm", "N mm",
        label="95 % confidence half-width of the friction torque", decimals=2,
    )  # fmt: skip
    power_loss_W: float | None = quantity(
        "mean dissipated power",
        "W",
        label="power loss",
        column="power loss",
        decimals=FLOATING,
        digits=3,
        group="friction",
    )
    input_torque_Nmm: float | None = quantity(
        "work of what prescribes rotations over the relative angle; null where a torque drives", "N mm",
        label="input torque", digits=4, group="friction",
    )  # fmt: skip
    support_power_W: float | None = quantity(
        "mean power of dampers to the ground (of a machine, of all), no part of power_loss_W; null for none",
        "W", label="power of dampers to the ground", column="dampers", decimals=FLOATING, digits=3, group="friction",
        default=None,
    )  # fmt: skip
    friction_breakdown_Nmm: dict[str, float | None] = Field(description="parts of friction_torque_Nmm; they add up")
    cage_speed_ratio: float | None = quantity(
        "mean cage speed over inner ring speed", label="cage speed over inner ring speed",
        column="cage over inner ring", decimals=4, digits=4, group="cage",
    )  # fmt: skip
    cage_speed_over_epicyclic: float | None = quantity(
        "cage_speed_ratio over epicyclic_ratio", label="cage speed over kinematic speed", column="  over epicyclic",
        decimals=4, digits=4, group="cage",
    )  # fmt: skip
    second_cage_speed_ratio: float | None = quantity(
        "mean speed of the second row's cage over inner ring speed; null where one cage holds all balls",
        label="speed of the second row's cage over inner ring speed", column="  second row", decimals=4, digits=4,
        group="cage", default=None,
    )  # fmt: skip
    epicyclic_ratio: float | None = quantity(
        "cage speed over inner ring speed without slip: of balls that roll at both raceways at their "
        "contact angles about their own axes, weighted by load",
        label="kinematic cage speed over inner ring speed", decimals=4, group="cage",
    )  # fmt: skip
    contacts: list[Contact] = Field(description="every contact with a raceway at the end state")
    inner_ring_displacement_um: list[float | None] = quantity(
        "mean position x, y, z", "um", label="inner ring displacement", column="inner ring x, y, z", decimals=2,
        group="place", axes="xyz",
    )  # fmt: skip
    inner_ring_tilt_mrad: list[float | None] = quantity(
        "mean tilt about y and z", "mrad", label="inner ring tilt about", column="tilt y, z", decimals=2,
        group="place", axes="yz",
    )  # fmt: skip
    bent: list[RingDeformation] = Field(description="elastic rings and cage; empty where all are rigid", default=[])
    max_pressure_GPa: float | None = quantity(
        "largest Hertzian pressure of the averaging window", "GPa", label="largest contact pressure", column="p_max",
        decimals=2, group="contact",
    )  # fmt: skip
    min_film_um: float | None = quantity(
        "smallest minimum film under load in the averaging window", "um", label="smallest film under load",
        column="smallest film", decimals=2, group="film",
    )  # fmt: skip
    film_um: list[float] = quantity(
        "smallest and largest central film under load at the end state", "um", label="central films under load",
        column="central film", decimals=2, group="film",
    )  # fmt: skip
    film_parameter: list[float] = quantity(
        "smallest and largest Lambda under load at the end state", label="Lambda, central film over roughness",
        column="Lambda", group="film",
    )  # fmt: skip
    contact_capacitance_pF: list[float] = quantity(
        "smallest and largest under load at the end state", "pF", label="capacitances of contacts",
        column="C of contacts", decimals=0, group="capacitance",
    )  # fmt: skip
    bearing_capacitance_nF: float | None = quantity(
        "at the end state", "nF", label="capacitance of the bearing", column="C of bearing", decimals=3,
        group="capacitance",
    )  # fmt: skip
    capacitance_note: str = Field(description="which contacts asperities short, where they do", default="")
    currents: Currents | None = Field(description="of a case with a circuit; null without one", default=None)
    observed: list[ObserverNumber] = Field(description="numbers of the observers of the case", default=[])
    events: list[EventSeen] = Field(description="events that the case looks out for", default=[])
    verdict: Verdict | None = Field(description="against required life and limits", default=None)
    rating: Rating | None = Field(description="life, safety and catalogue friction of the case at its start")
    shoulders: list[Shoulder] = Field(description="how near contacts came to the shoulders, the worst on each ring")
    force_N: list[float] = Field(description="mean force of a machine's bearing on the shaft: x, y, z", default=[])
    force_swing_N: list[float] = Field(
        description="half of what lies between the smallest and largest value of that force: x, y, z", default=[]
    )
    moment_Nm: list[float] = Field(
        description="mean moment of a machine's bearing on the shaft about y and z", default=[]
    )
    warnings: list[str] = Field(description="where case or run left what bearing, oil and laws are made for")
    revolutions_discarded: int = Field(description="whole cage revolutions before averaging")
    revolutions_averaged: int = Field(description="whole cage revolutions averaged")
    wall_per_revolution_s: float | None = quantity(
        "wall time per revolution of the inner ring against the outer", "s", label="wall time per revolution",
        decimals=FLOATING, digits=3,
    )  # fmt: skip
    equilibrium: StartState
    assumptions: list[str]
