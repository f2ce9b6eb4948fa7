"""Provide balls, and the kinds of bearings with them."""

from __future__ import annotations

from lambda_core.elements.ball import kinds
from lambda_core.elements.kind import POINT, ElementKind

BALL = ElementKind("ball", "balls", (POINT,), 9, kinds.kinds)
