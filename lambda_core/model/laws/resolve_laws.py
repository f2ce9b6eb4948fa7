"""Resolve the model and parameters of each role."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Protocol

from pydantic import ValidationError

from lambda_core.case.case import Case
from lambda_core.case.modelling import ForceElement
from lambda_core.case.problems import problems
from lambda_core.catalogue.protocol import LubricantRow
from lambda_core.domain.elements import ELEMENTS, RIBS
from lambda_core.domain.errors import LambdaError, unknown_name
from lambda_core.domain.installed import OWN
from lambda_core.domain.lubrication import MIXTURES
from lambda_core.domain.plugin_errors import describe
from lambda_core.domain.roles import CAGE, DEFAULT_MODELS, MOTION_ROLES
from lambda_core.domain.value_status import ValueStatus
from lambda_core.laws.law import Law
from lambda_core.laws.parameter import kind_defaults
from lambda_core.model.bearing_model import ChosenLaw
from lambda_core.model.laws.law_defaults import MEASURED, law_sentences, record_law, short
from lambda_core.model.laws.law_packages import law_called
from lambda_core.model.laws.oil_data import FROM_CASE, oil_data
from lambda_core.model.ledger import Ledger

NONE = "none"
BALL_BALL = "ball-ball"  # takes the place of the pockets when there is no cage
CONSTANT = "constant"  # permittivity law that needs no data
CAVITY_DRAG = "cavity-mixture"  # default law of drag where the balls run in a mixture of oil and air
SHARE_OF_OIL = "oil_share"  # its parameter that otherwise follows from the flow of oil
PRESCRIBED = "film_factor"  # parameter of the supply laws that take lubricant.starvation
# Element -> default model where the role's own default does not fit it.
LAND = "land-guidance"  # contact of the cage with the ring that guides it
LANDS = {"cage_inner": "inner ring", "cage_outer": "outer ring"}


class ModelSource(Protocol):
    """Registry functions that the resolution needs."""

    def names(self, role: str) -> tuple[str, ...]:
        """Return the names of the models for `role`."""

    def model(self, role: str, name: str) -> Law:
        """Return one model; LambdaError when there is none."""


@dataclass
class LawResolver:
    """Resolver that fills every role of every element.

    It takes every force element; problems go to the ledger.
    """

    case: Case
    registry: ModelSource
    lubricant: LubricantRow | None
    guidance: str
    ledger: Ledger
    kind: str = "deep groove"  # of the bearing
    defaults: Mapping[str, str] = field(default_factory=DEFAULT_MODELS.copy)  # by role
    _used: dict[str, set[str]] = field(default_factory=dict)  # role -> parameters some model took

    def resolve(self) -> dict[str, dict[str, ChosenLaw]]:
        """Return element -> role -> law.

        Complete unless the ledger holds problems.
        """
        self._check_names()
        laws: dict[str, dict[str, ChosenLaw]] = {}
        for element in self._elements():
            laws[element] = {}
            for role in (role for role in MOTION_ROLES.values() if element in role.elements):
                law = self.law(element, role.name)
                if law is not None:
                    laws[element][role.name] = law
        self._check_unused()
        self._explain(laws)
        return laws

    def _elements(self) -> tuple[str, ...]:
        """Return the existing force elements.

        Balls have pockets or, without a cage, each other.
        """
        absent = "ball_ball" if self.case.depth.cage else "ball_cage"
        return tuple(element for element in ELEMENTS if element != absent)

    def _check_names(self) -> None:
        """Note roles that an element does not have.

        It looks at [forces.ELEMENT] and [parameters].
        """
        for role in self.case.parameters:
            if role not in MOTION_ROLES:
                self.ledger.problem(f"parameters.{role}", unknown_name("role", role, MOTION_ROLES))
        for element in RIBS:
            if getattr(self.case.forces, element) != ForceElement():
                self.ledger.problem(f"forces.{element}", "this bearing has no ribs that guide rollers: leave it out")
        for element in ELEMENTS:
            own = getattr(self.case.forces, element)
            roles = [role.name for role in MOTION_ROLES.values() if element in role.elements]
            for role in (name for name in type(own.models).model_fields if getattr(own.models, name) is not None):
                if role not in roles:
                    self.ledger.problem(
                        f"forces.{element}.models.{role}", f"{element} has no such role; its roles: {', '.join(roles)}"
                    )
            for role in own.parameters:
                if role not in roles:
                    where = f"forces.{element}.parameters.{role}"
                    self.ledger.problem(where, f"{element} has no such role; its roles: {', '.join(roles)}")

    def law(self, element: str, role: str) -> ChosenLaw | None:
        """Return the law of a role with its parameters.

        None follows a problem.
        """
        name, where = self._choice(element, role)
        plain = name.removeprefix(f"{OWN}:")
        if plain == BALL_BALL and self.case.depth.cage:
            self.ledger.problem(where, f'"{name}" is the contact without a cage: it needs depth.cage = false')
            return None
        if plain == LAND and self.guidance != LANDS.get(element):
            self.ledger.problem(where, self._not_guided(element))
            return None
        try:
            chosen = law_called(self.registry, role, name, given=self._chosen_by(element, role) == "given")
        except LambdaError as error:
            self.ledger.problem(where, str(error))
            return None
        if chosen.contact == "line":
            self.ledger.problem(where, f'"{name}" is a law of line contacts: the contacts of balls are points')
            return None
        rows = self._lubricant_rows(role, chosen)
        case_texts = self._case_texts(element, role, chosen)
        if role == "supply" and self.case.lubricant.starvation < 1.0 and not self._prescribes(chosen, case_texts):
            return None
        texts: dict[str, Any] = kind_defaults(chosen.parameters, self.kind)
        texts |= {key: row.text() for key, row in rows.items()}
        texts.update({key: text for key, (text, _) in case_texts.items()})
        foreign = [key for key in texts if key not in chosen.parameters.model_fields]
        for key in foreign:
            # A plugin's parameters may be declared to ignore what they do not know; a typing slip is no less one.
            self._foreign_parameter(key, role, chosen, case_texts)
        if foreign:
            return None
        try:
            parameters = chosen.parameters.model_validate(texts)
        except ValidationError as error:
            self._parameter_problems(error, element, role, chosen, texts, case_texts)
            return None
        except (Exception, SystemExit) as error:  # a check of the plugin's own
            self.ledger.problem(where, f"{chosen.label}: its parameters cannot be read: {describe(error)}")
            return None
        if getattr(parameters, SHARE_OF_OIL, 0.0) is None and not self.case.thermal.oil_flow > 0.0:
            kind = self.case.lubricant.lubrication
            self.ledger.problem(
                "thermal.oil_flow",
                f"is required with {f'lubrication {kind}' if kind in MIXTURES else f'{role} {chosen.name}'}, such as "
                '"1 l/min": from this flow through the bearing follows the share of oil in which the balls move; or '
                f"give this share, 0 to 1: parameters.{role}.{SHARE_OF_OIL}",
            )
            return None
        origins = {}
        for key in type(parameters).model_fields:
            if key in case_texts or (key in rows and rows[key].source == FROM_CASE):
                origins[key] = FROM_CASE
            elif key in rows and self.lubricant:
                grade = MEASURED if rows[key].status == "measured" else ", grade "
                origins[key] = f"lubricant {self.lubricant.name} ({rows[key].source}{grade}{rows[key].grade})"
            else:
                origins[key] = "default"
        return ChosenLaw(chosen, parameters, origins)

    def _not_guided(self, element: str) -> str:
        """Report why no land guides the cage.

        The cage is in a force element.
        """
        if element in LANDS:
            ring = LANDS[element]
            return f'"{LAND}" needs a cage that the {ring} guides, not the {self.guidance}: bodies.cage.guidance'
        lands = " or ".join(f"forces.{name}.models.cage_contact" for name in LANDS)
        return f'"{LAND}" is a contact of cage and ring, not of ball and pocket: choose it under {lands}'

    def _prescribes(self, chosen: Law, case_texts: Mapping[str, tuple[Any, str]]) -> bool:
        """Report whether a supply law uses the prescribed film.

        The case prescribes it; the consequences are reported, too.
        """
        share, where = self.case.lubricant.starvation, "lubricant.starvation"
        if PRESCRIBED not in chosen.parameters.model_fields:
            self.ledger.problem(
                where, f'the supply law "{chosen.name}" computes the film itself: remove this option, or use "constant"'
            )
            return False
        if PRESCRIBED in case_texts:
            self.ledger.problem(where, f"{case_texts[PRESCRIBED][1]} gives the film, too: leave one out")
            return False
        self.ledger.assume(
            f"starved contacts: the films are {short(share)} of the flooded ones at every speed and load, as given; "
            "the rolling resistance is that of the inlet which leaves this film (Wolveridge et al. 1971; Biboulet and "
            "Houpert 2010, eq. 44; assumed: line contacts)"
        )
        return True

    def _choice(self, element: str, role: str) -> tuple[str, str]:
        """Return the model's name and its path.

        The choice was, or would be, made at the path.
        """
        own = getattr(getattr(self.case.forces, element).models, role)
        general = getattr(self.case.models, role)
        where = f"forces.{element}.models.{role}" if own else f"models.{role}"
        if not self.case.depth.cage and element in CAGE:
            return NONE, where
        if element == "ball_ball":
            return own or BALL_BALL, f"forces.{element}.models.{role}"
        if own is None and element in LANDS:
            # A general choice of the pocket's model says nothing about the lands.
            guided = self.guidance == LANDS[element]
            return (LAND if guided else NONE), f"forces.{element}.models.{role}"
        name = own or general
        if name is None:
            return self._default(role), where
        return (self._automatic(role) if name == "auto" and role == "rheology" else name), where

    def _chosen_by(self, element: str, role: str) -> ValueStatus:
        """Tell whether the case chooses this model.

        It names this model, or names none and gets the one that fits.
        """
        own = getattr(getattr(self.case.forces, element).models, role)
        general = None if element in LANDS or element == "ball_ball" else getattr(self.case.models, role)
        return "default" if (own or general) in (None, "auto") else "given"

    def _default(self, role: str) -> str:
        """Return the built-in default.

        A law of the oil is the one that the oil has data for.
        """
        if role == "fluid_drag" and self.case.lubricant.lubrication in MIXTURES:
            return CAVITY_DRAG
        name = self.defaults[role]
        if name == "auto":
            return self._automatic(role)
        if role != "permittivity" or self.lubricant is None or role in self.case.parameters:
            return name
        known = self.lubricant.parameters.get(role, {})
        if name not in known:
            other = next(iter(known), CONSTANT)
            self.ledger.assume(f"{role} model {other}: {self.lubricant.name} has no data for {name}")
            return other
        return name

    def _automatic(self, role: str) -> str:
        return self.lubricant.rheology if self.lubricant else NONE

    def _lubricant_rows(self, role: str, chosen: Law) -> Mapping[str, Any]:
        """Return the oil's data for a law, its properties included."""
        known = self._rows_of_law(role, chosen)
        return known if self.lubricant is None else oil_data(chosen, self.lubricant, known)

    def _rows_of_law(self, role: str, chosen: Law) -> Mapping[str, Any]:
        """Return the oil's rows for a law.

        Data of one of ours is not for another's of the same name.
        """
        known = self.lubricant.parameters.get(role, {}) if self.lubricant else {}
        if chosen.qualified in known or chosen.name not in known:
            return known.get(chosen.qualified, {})
        try:
            ours = self.registry.model(role, f"{OWN}:{chosen.name}")
        except LambdaError:
            return known[chosen.name]
        return known[chosen.name] if ours.qualified == chosen.qualified else {}

    def _case_texts(self, element: str, role: str, chosen: Law) -> dict[str, tuple[Any, str]]:
        """Return parameter -> (text, path) of the case.

        The element's own parameters come before the general ones.
        """
        texts: dict[str, tuple[Any, str]] = {}
        known = chosen.parameters.model_fields
        for key, text in self.case.parameters.get(role, {}).items():
            if key in known:
                texts[key] = (text, f"parameters.{role}.{key}")
                self._used.setdefault(role, set()).add(key)
        own = getattr(self.case.forces, element).parameters.get(role, {})
        for key, text in own.items():
            texts[key] = (text, f"forces.{element}.parameters.{role}.{key}")
        return texts

    def _parameter_problems(
        self,
        error: ValidationError,
        element: str,
        role: str,
        chosen: Law,
        texts: Mapping[str, Any],
        case_texts: Mapping[str, tuple[Any, str]],
    ) -> None:
        fields = chosen.parameters.model_fields
        missing = [key for key, info in fields.items() if info.is_required() and key not in texts]
        if len(missing) > 1 and self.lubricant is not None:
            self.ledger.problem(self._choice(element, role)[1], self._lacking(role, chosen, missing))
        for problem in problems(error, chosen.parameters, dict(texts)):
            if len(missing) > 1 and problem.where in missing and self.lubricant is not None:
                continue
            key, _, inside = problem.where.partition(".")
            where = (
                ".".join(filter(None, (case_texts[key][1], inside)))
                if key in case_texts
                else f"parameters.{role}.{problem.where}".rstrip(".")
            )
            message = f"{role} {chosen.name}: {problem.message}"
            if key not in texts and self.lubricant is not None:
                message = f"{role} {chosen.name} needs it, and the lubricant {self.lubricant.name} has no data for it"
            self.ledger.problem(where, message)

    def _lacking(self, role: str, chosen: Law, missing: list[str]) -> str:
        """Report what a law needs of the oil.

        The report is one sentence that names the laws for which the oil has data.
        """
        assert self.lubricant is not None
        known = [name for name in self.lubricant.parameters.get(role, {}) if name != chosen.name]
        others = f"; it has data for {', '.join(known)}" if known else ""
        return (
            f"{role} {chosen.name} needs {', '.join(missing)}, and the lubricant {self.lubricant.name} has no data for "
            f"them{others}; give them under parameters.{role}, or choose another law"
        )

    def _foreign_parameter(self, key: str, role: str, chosen: Law, case_texts: Mapping[str, tuple[Any, str]]) -> None:
        known = ", ".join(chosen.parameters.model_fields) or "none"
        if key in case_texts:
            where, whose = case_texts[key][1], ""
        else:
            where, whose = "lubricant.name", f'data of {self.lubricant.name if self.lubricant else ""}: "{key}" '
        self.ledger.problem(where, f"{whose}is not a parameter of {role} {chosen.name}; it has: {known}")

    def _check_unused(self) -> None:
        """Note general parameters that no chosen model knows.

        The models are those of the role.
        """
        for role, texts in self.case.parameters.items():
            for key in texts:
                if role in MOTION_ROLES and key not in self._used.get(role, set()):
                    chosen = self._chosen(role)
                    fields = sorted({f for model in chosen for f in model.parameters.model_fields})
                    names = ", ".join(dict.fromkeys(model.name for model in chosen))
                    self.ledger.problem(
                        f"parameters.{role}.{key}",
                        unknown_name(f"parameter of {role} {names}", key, fields),
                    )

    def _chosen(self, role: str) -> list[Law]:
        found = []
        for element in (each for each in self._elements() if each in MOTION_ROLES[role].elements):
            name, _ = self._choice(element, role)
            with suppress(LambdaError):  # told where it was chosen
                found.append(law_called(self.registry, role, name, given=self._chosen_by(element, role) == "given"))
        return found

    def _explain(self, laws: Mapping[str, Mapping[str, ChosenLaw]]) -> None:
        """Turn defaults and weak data into sentences.

        Each value has one sentence with its source and grade; the data are the lubricant's.
        """
        for element, roles in laws.items():
            for role, law in roles.items():
                record_law(self.ledger, element, role, law, self._chosen_by(element, role))
        for sentence in law_sentences(laws):
            self.ledger.assume(sentence)
