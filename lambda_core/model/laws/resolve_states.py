"""Check the states of contacts that laws read and keep."""

from __future__ import annotations

from collections.abc import Mapping

from lambda_core.domain.elements import RACEWAYS
from lambda_core.domain.errors import nearest
from lambda_core.laws.state import ROLE, State
from lambda_core.model.bearing_model import ChosenLaw, ChosenObserver
from lambda_core.model.ledger import Ledger


def check_states(
    laws: Mapping[str, Mapping[str, ChosenLaw]], observers: Mapping[str, ChosenObserver], ledger: Ledger
) -> None:
    """Note states that nobody keeps.

    It also notes states that have two units, or the name of an observer's channel.
    """
    known: dict[str, State] = {}
    for element in RACEWAYS:
        roles = laws.get(element, {})
        keeper = roles[ROLE].model if ROLE in roles else None
        for state in keeper.states if keeper else ():
            other = known.setdefault(state.name, state)
            if other.unit != state.unit:
                ledger.problem(
                    f"models.{ROLE}",
                    f"{state.name} is kept in {other.unit} and in {state.unit}: choose laws with one unit",
                )
        kept, whose = ([state.name for state in keeper.states], keeper.label) if keeper else ([], "")
        for role, law in roles.items():
            for name in law.model.reads:
                if name not in kept:
                    ledger.problem(f"models.{role}", _not_kept(law, name, element, whose, kept))
    if known:
        ledger.assume(f"in the quasi-static equilibrium states of contacts stand at their start: {', '.join(known)}")
    for name, chosen in observers.items():
        for channel in chosen.item.written():
            if channel.name in known:
                message = f"writes the channel {channel.name}, the name of a state of the contacts"
                ledger.problem(f"observers.{name}", message)


def _not_kept(law: ChosenLaw, name: str, element: str, keeper: str, kept: list[str]) -> str:
    close = nearest(name, kept)
    what = f"; {keeper} keeps {', '.join(kept)}" if kept else f': choose a law that does, models.{ROLE} = "..."'
    hint = f"; nearest: {close[0]}" if close else ""
    return f"{law.model.label} reads the state {name}, which no law keeps at {element}{what}{hint}"
