"""Provide form rows with the case around them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, cast

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.roles import MOTION_ROLES
from lambda_core.domain.value_status import ESTIMATED
from lambda_gui.nodes import Keys
from lambda_gui.rows import Surroundings

if TYPE_CHECKING:
    from lambda_core.api import Draft, ValueReport

Name = Literal["bearing", "lubricant", "material", "cage"]


class CaseContext(Surroundings):
    """Resolved values and names of the catalogue.

    The values are those of the last check without mistakes.
    """

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self._values: dict[str, ValueReport] = {}
        self._names: dict[str, list[str]] = {}

    def learn(self, values: Sequence[ValueReport]) -> None:
        """Take new values.

        A case with mistakes keeps those it had.
        """
        if values:
            self._values = {value.path: value for value in values}

    def forget_names(self) -> None:
        """Read the catalogue's names anew: it has changed."""
        self._names.clear()

    def resolved(self, keys: Keys) -> str:
        """Return the value in effect.

        It has ≈ and the grade where it is estimated or assumed.
        """
        value = self.value(keys)
        if value is None or value.text == "None":
            return ""
        if value.path.startswith("forces.") and ".models." in value.path:
            return value.text
        mark = "≈ " if value.status in ESTIMATED else ""
        return f"{mark}{value.text}{f' ({value.grade})' if value.grade else ''}"

    def origin(self, keys: Keys) -> str:
        """Return the value in effect with where it comes from."""
        value = self.value(keys)
        if value is None or value.text == "None" or value.source in ("", "case"):
            return ""
        return f"{self.resolved(keys)}: {value.source}"

    def table(self, prefix: str) -> list[ValueReport]:
        """Return the values in effect directly under a table."""
        return [v for path, v in self._values.items() if path.rpartition(".")[0] == prefix]

    def value(self, keys: Keys) -> ValueReport | None:
        """Return the resolved value of a missing option.

        The case does not write the option.
        """
        if self.draft.get(*keys) is not None:
            return None
        return self._values.get(_path(keys))

    def names(self, kind: str) -> list[str]:
        """Return the names of one kind in the catalogue."""
        if kind not in self._names:
            from contextlib import closing

            from lambda_core import api

            try:
                with closing(api.catalogue()) as catalogue:
                    self._names[kind] = catalogue.names(cast(Name, kind))
            except LambdaError:
                return []
        return self._names[kind]

    def is_changed(self, keys: Keys) -> bool:
        """Tell whether an option differs from the file."""
        return self.draft.is_changed(*keys)


def _path(keys: Keys) -> str:
    """Return where the report has the value of an option."""
    first = keys[0]
    if keys[:2] in (("bearing", "geometry"), ("lubricant", "properties")):
        keys = (first, *keys[2:])
    if first == "bearings" and keys[2:3] == ("geometry",):
        keys = (*keys[:2], *keys[3:])
    if first in ("models", "parameters") and keys[1] in MOTION_ROLES:
        keys = ("forces", MOTION_ROLES[keys[1]].elements[0], *keys)
    return ".".join(keys)
