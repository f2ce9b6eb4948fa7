"""Declare how degrees of freedom are held, elastic or moved."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any, ClassVar, Literal, get_args

from pydantic import GetJsonSchemaHandler, SerializationInfo, model_serializer, model_validator
from pydantic_core import CoreSchema

from lambda_core.case.option import Section, option, quantity_of
from lambda_core.case.signals import AngleSignal, LengthSignal, SpeedSignal
from lambda_core.domain.errors import nearest
from lambda_core.domain.units import AngularDamping, AngularStiffness, Damping, Stiffness, parse, show

Mode = Literal["free", "locked", "prescribed"]
# Stiffness and damping at most, in SI: a cube of steel of a metre has 2e11 N/m; where one part is 1e20 as stiff as
# others, these are lost in rounding.
LARGEST = 1e15
_NUMBER = "+-.0123456789"  # what a number begins with


class Dof(Section):
    """One degree of freedom.

    It is "free", "locked", a stiffness, or a table of stiffness and damping, or of a motion.
    """

    damps_what_is_locked: ClassVar[bool] = False

    mode: Mode = option("free", "free, locked, or prescribed by a motion; stiffness, damping or motion say which")

    @model_validator(mode="before")
    @classmethod
    def _from_short_form(cls, value: Any) -> Any:
        if isinstance(value, str):
            text = value.strip()
            modes = get_args(cls.model_fields["mode"].annotation)
            return {"mode": text} if text in modes else cls._stiffness(text)
        if isinstance(value, Mapping) and "kind" in value:
            raise ValueError(
                "a motion over time is written { motion = { kind = ... } }"
                if "motion" in cls.model_fields
                else "cannot have a motion over time"
            )
        if isinstance(value, Mapping) and "motion" in value.keys() & cls.model_fields and "mode" not in value:
            return {"mode": "prescribed", **value}
        return value

    @classmethod
    def _stiffness(cls, text: str) -> dict[str, str]:
        """Return the table of a stiffness.

        A mistake names the texts that are allowed.
        """
        quantity = quantity_of(cls, "stiffness")
        names = ('"locked"', '"free"') if "locked" in get_args(cls.model_fields["mode"].annotation) else ('"free"',)
        try:
            stiffness = parse(text, quantity) if quantity else None
        except ValueError:
            stiffness = None
        if stiffness is not None and stiffness <= 0.0:
            raise ValueError(f'"{text}": a stiffness must be greater than 0; or write "free"')
        if stiffness is not None and stiffness > LARGEST:
            raise ValueError(
                f'"{text}": a stiffness must be at most {show(LARGEST, quantity)}; or write {" or ".join(names)}'
            )
        if stiffness is not None:
            return {"stiffness": text}
        if text[:1] in _NUMBER and cls._is_motion(text):
            raise ValueError(f'a motion is written {{ motion = "{text}" }}')
        known = [
            *names,
            *(["a stiffness"] if quantity else []),
            *(["a motion"] if "motion" in cls.model_fields else []),
        ]
        close = nearest(text, [name.strip('"') for name in names])
        hint = f"; nearest: {close[0]}" if close else ""
        raise ValueError(f'"{text}" is not allowed: write {" or ".join(known)}{hint}')

    @classmethod
    def _is_motion(cls, text: str) -> bool:
        """Tell whether a text is a constant motion."""
        quantity = quantity_of(cls, "motion")
        try:
            return bool(quantity) and parse(text, quantity) is not None
        except ValueError:
            return False

    @model_validator(mode="after")
    def _consistent(self) -> Dof:
        motion = getattr(self, "motion", None)
        elastic = getattr(self, "stiffness", 0.0) or getattr(self, "damping", 0.0)
        if self.damps_what_is_locked and self.mode == "locked":
            elastic = getattr(self, "stiffness", 0.0)
        if self.mode == "prescribed" and motion is None and "motion" in type(self).model_fields:
            raise ValueError('mode = "prescribed" needs a motion')
        if motion is not None and self.mode != "prescribed":
            raise ValueError(f'a motion needs mode = "prescribed", not "{self.mode}"; leave the mode out')
        if elastic and self.mode != "free":
            raise ValueError(f'stiffness and damping of a support need mode = "free", not "{self.mode}"')
        return self

    @model_serializer(mode="wrap")
    def _shorten(self, handler: Any, info: SerializationInfo) -> Any:
        written = handler(self)
        if self.model_fields_set <= {"mode"}:
            return self.mode
        if info.mode != "json" or not info.exclude_unset:
            return {"mode": self.mode, **written}
        if self.mode != "locked":  # what else is written says it
            written.pop("mode", None)
        return written["stiffness"] if set(written) == {"stiffness"} and self.hold else written

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        modes = {"enum": list(get_args(cls.model_fields["mode"].annotation))}
        quantity = quantity_of(cls, "stiffness")
        stiffness = [{"type": "string", "x-quantity": quantity, "description": "a stiffness"}] if quantity else []
        return {"anyOf": [modes, *stiffness, handler(schema)]}

    @property
    def hold(self) -> float:
        """Stiffness of the constraint [N/m, N m/rad].

        Inf where it is locked or prescribed, 0 where it is free.
        """
        return float(getattr(self, "stiffness", 0.0)) if self.mode == "free" else inf


class Translation(Dof):
    """Boundary condition along one axis."""

    motion: LengthSignal | None = option(None, "prescribed position over time")
    stiffness: Stiffness = option("0 N/m", "elastic support to ground", ge=0.0, le=LARGEST)
    damping: Damping = option("0 N s/m", "damping of the support", ge=0.0, le=LARGEST)


class Tilt(Dof):
    """Boundary condition of a rotation about y or z."""

    motion: AngleSignal | None = option(None, "prescribed angle over time")
    stiffness: AngularStiffness = option("0 N m/rad", "elastic support to ground", ge=0.0, le=LARGEST)
    damping: AngularDamping = option("0 N m s/rad", "damping of the support", ge=0.0, le=LARGEST)


class Roll(Dof):
    """Constraint of a body's rotation about x.

    The body does not turn with the shaft.
    """

    mode: Literal["free", "locked"] = option("free", "free or locked")
    stiffness: AngularStiffness = option("0 N m/rad", "elastic support to ground", ge=0.0, le=LARGEST)
    damping: AngularDamping = option("0 N m s/rad", "damping of the support", ge=0.0, le=LARGEST)


class Spin(Dof):
    """Boundary condition of the rotation about the body's own axis."""

    motion: SpeedSignal | None = option(None, "prescribed speed over time")
    damping: AngularDamping = option("0 N m s/rad", "resistance to the rotation", ge=0.0)


class InnerSpin(Dof):
    """Rotation of the inner ring.

    Its speed over time is operation.speed.
    """

    damping: AngularDamping = option("0 N m s/rad", "resistance to the rotation", ge=0.0)


class ShaftSpin(Dof):
    """Resistance to the rotation of a driven shaft.

    A torque drives the shaft.
    """

    mode: Literal["free"] = option("free", "free; [operation] has the speed or the torque of the shaft")
    damping: AngularDamping = option("0 N m s/rad", "resistance to the rotation", ge=0.0, le=LARGEST)


class SeatTranslation(Translation):
    """Support of a ring along one axis.

    The damping of a locked ring counts where its housing is elastic.
    """

    damps_what_is_locked: ClassVar[bool] = True


class SeatTilt(Tilt):
    """Support of a ring about y or z."""

    damps_what_is_locked: ClassVar[bool] = True


class TranslationSpring(Dof):
    """Spring and damper along one axis; "free" is none."""

    mode: Literal["free"] = option("free", "free of both where neither is written")
    stiffness: Stiffness = option("0 N/m", "stiffness", ge=0.0, le=LARGEST)
    damping: Damping = option("0 N s/m", "damping", ge=0.0, le=LARGEST)


class RotationSpring(Dof):
    """Spring and damper of rotation about one axis.

    "free" is none.
    """

    mode: Literal["free"] = option("free", "free of both where neither is written")
    stiffness: AngularStiffness = option("0 N m/rad", "stiffness", ge=0.0, le=LARGEST)
    damping: AngularDamping = option("0 N m s/rad", "damping", ge=0.0, le=LARGEST)
