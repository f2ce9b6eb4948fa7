"""Build machines in Python.

The case file is the reference: a :class:`Machine` collects what stands in one, and every question is answered for the
case that it would write.
"""

from __future__ import annotations

import copy
import logging
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.errors import UsageError

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source
    from lambda_core.case.machine import MachineCase

log = logging.getLogger("lambda_core")


class Machine:
    """Describe a shaft in bearings, or one bearing.

    Values are written as in a case file: numbers with units as strings, ``"20 kN"``. Options that a method does not
    name are those of the case's section and are passed as keywords.

    Parameters
    ----------
    name : str
        Short name; files are named after it.
    speed : str or Mapping
        Speed of the shaft, ``"3000 rpm"``, or a function of time.
    oil : tuple of str, or Mapping
        Name and temperature, ``("FVA3", "70 degC")``, or the table ``[lubricant]``.
    **sections
        Further tables of the case: ``models``, ``solver``, ``thermal``, ...

    Examples
    --------
    >>> machine = Machine("gearbox", speed="3000 rpm", oil=("FVA3A", "70 degC"))
    >>> machine.shaft("30 mm x 40 mm", "110 mm x 48 mm", "30 mm x 30 mm")
    Machine('gearbox', speed='3000 rpm')
    >>> machine.bearing("left", "SKF 6208", at="21 mm")
    Machine('gearbox', speed='3000 rpm', bearings=['left'])
    """

    def __init__(
        self,
        name: str = "machine",
        *,
        speed: str | Mapping[str, Any],
        oil: Sequence[str] | Mapping[str, Any],
        **sections: Any,
    ) -> None:
        self._folder: Path | None = None
        self._tables: dict[str, Any] = {"name": name}
        self._tables["operation"] = {"speed": speed}
        self._tables["lubricant"] = _lubricant(oil)
        self._merge(sections)

    @classmethod
    def of_bearing(
        cls,
        designation: str,
        *,
        radial: str | None = None,
        axial: str | None = None,
        speed: str | Mapping[str, Any],
        oil: Sequence[str] | Mapping[str, Any],
        name: str | None = None,
        **sections: Any,
    ) -> Machine:
        """Describe one bearing under a load, without a shaft.

        Adding a part, such as a gear, writes it as a machine: its bearing is called ``bearing`` and is at 0 mm of a
        rigid shaft, its loads act there.

        Parameters
        ----------
        designation : str
            Bearing of the catalogue, ``"SKF 6208"``.
        radial, axial : str, optional
            Forces on the inner ring, with units.
        speed, oil, **sections
            As for the class.
        name : str, optional
            Default: made of the designation.
        """
        machine = cls(name or "-".join(designation.lower().split()).replace("/", "-"), speed=speed, oil=oil)
        machine._tables["bearing"] = {"designation": designation}
        loads = {"radial": radial, "axial": axial}
        machine._tables["loads"] = {key: load for key, load in loads.items() if load is not None}
        # a ring on a shaft in other bearings hardly tilts; give bodies.inner_ring for another support
        machine._tables["bodies"] = {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}}
        machine._merge(sections)
        return machine

    @classmethod
    def from_case(cls, source: Source) -> Machine:
        """Take a case file, a built-in name, tables or case.

        Raises
        ------
        UsageError, CaseError
            When there is no such case, or it has mistakes.
        """
        from lambda_core.case.case_io import read_case

        case = read_case(source)
        machine = cls.__new__(cls)
        machine._folder = case.folder
        machine._tables = case.written()
        return machine

    def shaft(self, *sections: str | Mapping[str, Any], **options: Any) -> Machine:
        """Give the shaft's pieces from left to right.

        They replace the shaft that there is, with what holds it.

        Parameters
        ----------
        *sections : str or Mapping
            ``"30 mm x 40 mm"``: length and diameter; ``"30 mm x 40 mm x 10 mm"``: bore, too; or a table.
        **options
            Options of ``[shaft]``, such as ``material``.

        Returns
        -------
        Machine
            This object, so that calls can follow each other.
        """
        pieces = [_section(piece) for piece in sections]
        self._expand()
        self._tables["shaft"] = ({"sections": pieces} if pieces else {}) | options
        return self

    def bearing(self, name: str, designation: str | None = None, at: str | None = None, **options: Any) -> Machine:
        """Add a bearing; options as in ``[bearings.NAME]``."""
        given = {} if designation is None else {"designation": designation}
        return self._add("bearings", name, at, given | options)

    def gear(self, name: str, at: str | None = None, **options: Any) -> Machine:
        """Add a gear; options as in ``[gears.NAME]``."""
        return self._add("gears", name, at, options)

    def disc(self, name: str, at: str | None = None, **options: Any) -> Machine:
        """Add a disc: wheel, rotor or coupling, with its mass."""
        return self._add("discs", name, at, options)

    def load(self, name: str, at: str | None = None, **options: Any) -> Machine:
        """Add a force or moment: ``force_x`` to ``moment_z``."""
        return self._add("loads", name, at, options)

    def body(self, name: str, **options: Any) -> Machine:
        """Add a rigid body, such as a flexibly mounted housing."""
        return self._add("bodies", name, None, options)

    def marker(self, name: str, **options: Any) -> Machine:
        """Add a named place on a body."""
        return self._add("markers", name, None, options)

    def connection(self, name: str, at: str | None = None, **options: Any) -> Machine:
        """Add a spring, damper or force law between two places."""
        return self._add("connections", name, at, options)

    def with_(self, **changes: Any) -> Machine:
        """Return a changed copy; None removes an option.

        Examples
        --------
        ``machine.with_(gears={"wheel": {"power": "20 kW"}})``
        """
        changed = copy.deepcopy(self)
        changed._merge(changes)
        return changed

    @property
    def name(self) -> str:
        """Short name; files are named after it."""
        return str(self._tables["name"])

    @property
    def folder(self) -> Path | None:
        """Folder of relative file names; None: the working directory."""
        return self._folder

    def written(self) -> dict[str, Any]:
        """Return a copy of the plain tables of the case."""
        return copy.deepcopy(self._tables)

    @property
    def case(self) -> Case | MachineCase:
        """The case, validated.

        Raises
        ------
        CaseError
            With everything that is wrong.
        """
        from lambda_core.case.case_io import read_case

        return read_case(self._tables, folder=self._folder)

    def save(self, path: str | Path | None = None) -> Path:
        """Write the case file and return its path; default ``NAME.toml``."""
        from lambda_core import api

        target = Path(path) if path is not None else Path(f"{self.name}.toml")
        api.save(self.case, target)
        return target

    def check(self) -> Any:
        """Resolve the machine; CaseError names every mistake."""
        return self._ask("check")

    def quasistatic(self) -> Any:
        """Solve the equilibrium without time: loads, lives, films, friction."""
        return self._ask("quasistatic")

    def modes(self) -> Any:
        """Compute natural frequencies and critical speeds of the shaft."""
        return self._ask("modes")

    def temperatures(self) -> Any:
        """Compute the temperatures that the machine's own losses cause."""
        return self._ask("thermal")

    def study(self, varies: Mapping[str, Sequence[Any]], asks: Iterable[str] = (), **options: Any) -> Any:
        """Vary options as :func:`lambda_core.api.study` does.

        Examples
        --------
        ``machine.study({"gears.wheel.power": ["5 kW", "15 kW"]}, asks=["system_life_h"])``
        """
        return self._ask("study", varies=varies, asks=asks, **options)

    def run(self, out: str | Path | None = None, **options: Any) -> Any:
        """Simulate the motion as :func:`lambda_core.api.run` does."""
        return self._ask("run", out=out, **options)

    def _ask(self, question: str, **options: Any) -> Any:
        from lambda_core import api

        return getattr(api, question)(self.case, **options)

    def _add(self, table: str, name: str, at: str | None, options: Mapping[str, Any]) -> Machine:
        self._expand()
        parts = self._tables.setdefault(table, {})
        if name in parts:
            raise UsageError(f'{table}.{name} exists already; choose another name, or change it with "with_"')
        parts[name] = ({} if at is None else {"at": at}) | dict(options)
        return self

    def _expand(self) -> None:
        """Write the case of one bearing as a machine.

        Parts can then be added to it.
        """
        if "bearing" not in self._tables:
            return
        from lambda_core.model.long_form import long_form

        found = long_form(self.case)
        for difference in found.differences:
            log.warning("%s: %s", self.name, difference)
        self._tables = found.tables

    def _merge(self, changes: Mapping[str, Any]) -> None:
        from lambda_core.case.written import merged

        self._tables = merged(self._tables, changes)

    def __repr__(self) -> str:
        parts = [repr(self._tables["name"])]
        parts.append(f"speed={self._tables.get('operation', {}).get('speed')!r}")
        for table in ("bearings", "gears", "discs", "loads"):
            if names := list(self._tables.get(table, {})):
                parts.append(f"{table}={names}")
        return f"Machine({', '.join(parts)})"


def _lubricant(oil: Sequence[str] | Mapping[str, Any]) -> dict[str, Any]:
    """Return the table ``[lubricant]`` of a name with a temperature."""
    if isinstance(oil, Mapping):
        return dict(oil)
    if isinstance(oil, str) or len(oil) != 2:
        raise UsageError(f'oil: give name and temperature, ("FVA3A", "70 degC"), not {oil!r}')
    return {"name": oil[0], "temperature": oil[1]}


def _section(piece: str | Mapping[str, Any]) -> dict[str, Any]:
    """Return a shaft's piece of ``"length x diameter"`` as table."""
    if isinstance(piece, Mapping):
        return dict(piece)
    if not isinstance(piece, str):
        raise UsageError(
            f"{type(piece).__name__} is not a section of a shaft; give each section as an argument of its own: "
            'shaft("30 mm x 40 mm", "50 mm x 30 mm")'
        )
    words: Iterable[str] = (word.strip() for word in piece.split(" x "))
    values = [word for word in words if word]
    if len(values) not in (2, 3):
        raise UsageError(f'"{piece}" is not a section of a shaft; write "length x diameter": "30 mm x 40 mm"')
    return dict(zip(("length", "diameter", "bore"), values, strict=False))
