"""Host an FMU with Python's standard library alone."""

from __future__ import annotations

import ctypes as c
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Sequence
from pathlib import Path

OK, ERROR = 0, 3
Log = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p)
Log3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)


class Callbacks(c.Structure):
    """fmi2CallbackFunctions."""

    _fields_ = (
        ("log", Log),
        ("allocate", c.c_void_p),
        ("free", c.c_void_p),
        ("step_finished", c.c_void_p),
        ("environment", c.c_void_p),
    )


class Unit:
    """An unpacked FMU."""

    def __init__(self, file: Path, folder: Path) -> None:
        with zipfile.ZipFile(file) as archive:
            archive.extractall(folder)
        root = ET.parse(folder / "modelDescription.xml").getroot()
        self.fmi = int(root.get("fmiVersion", "0")[0])
        self.token = root.get("guid" if self.fmi == 2 else "instantiationToken", "").encode()
        self.variables = {v.get("name", ""): v for v in root.iterfind("ModelVariables/*")}
        self.references = {name: int(v.get("valueReference", "-1")) for name, v in self.variables.items()}
        (self.file,) = (*folder.glob("binaries/linux64/*.so"), *folder.glob("binaries/x86_64-linux/*.so"))
        self.library = c.CDLL(str(self.file))

    def named(self, causality: str) -> list[str]:
        """Return the names of inputs or outputs that are reals."""
        of_kind = [v for v in self.variables.items() if v[1].get("causality") == causality]
        return [name for name, v in of_kind if v.tag != "Int64" and v.find("Integer") is None]


class Instance:
    """A bearing of an FMU."""

    def __init__(self, unit: Unit, start: float = 0.0, token: bytes = b"") -> None:
        self.unit, self.said, self.time = unit, list[str](), start
        self._prefix = f"fmi{unit.fmi}"
        self._log = Log(self._hear) if unit.fmi == 2 else Log3(self._hear)
        make = self._call("Instantiate" if unit.fmi == 2 else "InstantiateCoSimulation", c.c_void_p)
        token = token or unit.token
        if unit.fmi == 2:
            self._callbacks = Callbacks(self._log, None, None, None, None)
            self.handle = make(b"one", 1, token, b"", c.byref(self._callbacks), 0, 1)
        else:
            no, yes, none = c.c_bool(False), c.c_bool(True), c.c_void_p()
            self.handle = make(b"one", token, b"", no, yes, no, no, none, c.c_size_t(0), none, self._log, none)
        if not self.handle:
            return
        self.handle = c.c_void_p(self.handle)
        zero, no = c.c_double(0.0), c.c_int(0)
        if unit.fmi == 2:
            self.do("SetupExperiment", no, zero, c.c_double(start), no, zero)
            self.do("EnterInitializationMode")
        else:
            self.do("EnterInitializationMode", no, zero, c.c_double(start), no, zero)

    def _hear(self, *words: object) -> None:
        self.said.append(bytes(words[-1]).decode())  # type: ignore[arg-type]

    def _call(self, name: str, result: object = c.c_int) -> object:
        function = getattr(self.unit.library, self._prefix + name)
        function.restype = result
        return function

    def do(self, name: str, *arguments: object) -> int:
        """Call a function of the interface; returns its status."""
        return int(self._call(name)(self.handle, *arguments))  # type: ignore[operator]

    def ready(self) -> Instance:
        """End the initialisation."""
        assert self.do("ExitInitializationMode") == OK
        return self

    def get(self, names: Sequence[str]) -> list[float]:
        """Return reals by name."""
        n = len(names)
        which = (c.c_uint * n)(*(self.unit.references[name] for name in names))
        values = (c.c_double * n)()
        more = () if self.unit.fmi == 2 else (c.c_size_t(n),)
        name = "GetReal" if self.unit.fmi == 2 else "GetFloat64"
        assert self.do(name, which, c.c_size_t(n), values, *more) == OK, self.said
        return list(values)

    def set(self, name: str, value: float) -> int:
        """Set a real; returns the status."""
        which, values = (c.c_uint * 1)(self.unit.references[name]), (c.c_double * 1)(value)
        one = c.c_size_t(1)
        if self.unit.fmi == 2:
            return self.do("SetReal", which, one, values)
        return self.do("SetFloat64", which, one, values, one)

    def step(self, size: float) -> int:
        """Take a step; returns the status."""
        now, length = c.c_double(self.time), c.c_double(size)
        if self.unit.fmi == 2:
            status = self.do("DoStep", now, length, 1)
        else:
            flags = [c.c_bool() for _ in range(3)]
            status = self.do("DoStep", now, length, c.c_bool(True), *map(c.byref, flags), c.byref(c.c_double()))
        if status == OK:
            self.time += size
        return status

    def save(self) -> c.c_void_p:
        """Return the state."""
        state = c.c_void_p()
        assert self.do(f"Get{self._state}", c.byref(state)) == OK
        return state

    def restore(self, state: c.c_void_p, time: float) -> None:
        """Go back to a state and free it."""
        assert self.do(f"Set{self._state}", state) == OK
        assert self.do(f"Free{self._state}", c.byref(state)) == OK
        self.time = time

    def packed(self) -> bytes:
        """Return the state as bytes that may leave the process."""
        state, size = self.save(), c.c_size_t()
        assert self.do(f"Serialized{self._state}Size", state, c.byref(size)) == OK
        bytes_ = (c.c_char * size.value)()
        assert self.do(f"Serialize{self._state}", state, bytes_, size) == OK
        assert self.do(f"Free{self._state}", c.byref(state)) == OK
        return bytes(bytes_)

    def unpack(self, data: bytes, time: float) -> int:
        """Go to a state from outside.

        Return the status of reading it.
        """
        state = c.c_void_p()
        name = "DeSerialize" if self.unit.fmi == 2 else "Deserialize"
        status = self.do(name + self._state, data, c.c_size_t(len(data)), c.byref(state))
        if status == OK:
            self.restore(state, time)
        return status

    def slope(self, unknown: str, known: str, along: float = 1.0) -> float:
        """Return an output's derivative with an input.

        Directional; ArithmeticError when the library refuses.
        """
        u, k = (c.c_uint * 1)(self.unit.references[unknown]), (c.c_uint * 1)(self.unit.references[known])
        one, seed, found = c.c_size_t(1), (c.c_double * 1)(along), (c.c_double * 1)()
        if self.unit.fmi == 2:
            status = self.do("GetDirectionalDerivative", u, one, k, one, seed, found)
        else:
            status = self.do("GetDirectionalDerivative", u, one, k, one, seed, one, found, one)
        if status != OK:
            raise ArithmeticError(self.said[-1])
        return float(found[0])

    @property
    def _state(self) -> str:
        return "FMUstate" if self.unit.fmi == 2 else "FMUState"
