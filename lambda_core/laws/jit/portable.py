"""Write compiled code as an object file without Python.

What Numba made of each function, optimised, is linked as it is: optimised again it would round otherwise, and the
library would not have the bits of a run. Numba adds to every function a wrapper by which Python calls it; the wrappers
are removed, with all that they need of Python. A function that needs Python or Numba when it runs is refused.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,attr-defined"
from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm  # type: ignore[import-untyped]
from llvmlite import ir
from numba import config
from numba.core import types
from numba.core.registry import cpu_target

from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.laws.jit.emission import Target, exact, machine_code
from lambda_core.laws.jit.machine_code import Pointer, environment_key
from lambda_core.laws.jit.plain import is_plain
from lambda_core.laws.jit.references import Reference

# Functions of Python and Numba in wrappers and on paths that compiled kernels never take: they raise errors.
_PYTHON = re.compile(
    r"Py(Err|Exc|Bytes|Unicode|Import|Long|Object|_DecRef)\w*|_Py_\w+|numba_(gil|do_raise|unpickle|runtime_build)\w*"
)
# What the library may ask of the C library; intrinsics become calls of it, too.
_LIBM = {
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "copysign", "cos", "cosh", "erf",
    "erfc", "exp", "exp2", "expm1", "fabs", "floor", "fmod", "hypot", "ldexp", "lgamma", "log", "log10", "log1p",
    "log2", "pow", "rint", "round", "sin", "sinh", "sqrt", "tan", "tanh", "tgamma", "trunc",
}  # fmt: skip
# What Numba's memory management asks for, in a few lines of C; the equilibrium allocates its workspaces.
MEMORY_SOURCE = Path(__file__).with_name("portable_memory.c")
_MEMORY = {"NRT_MemInfo_alloc_aligned", "NRT_MemInfo_call_dtor", "NRT_Free"}
# Of these no own version is written, see fmu/source/mathematics.c.
_UNLIKE = {"erf", "erfc", "lgamma", "tgamma"}
_RESULT = {"void": "", "ptr": "null", "double": "0.0"}
_DECLARED = re.compile(r"declare (?:\w+ )*?(\w+) @\S+?(\(.*?\))")
_TEXT = "text"  # what errors would say, with the paths of files here: left out
_TEXTS = re.compile(rf"^(@{_TEXT}\w+ = internal (?:unnamed_addr )?constant) (?:\[|\{{).*?(?=, align|$)", re.MULTILINE)
BYTE, WORD, REAL = ir.IntType(8), ir.IntType(64), ir.DoubleType()


@dataclass(frozen=True)
class Entry:
    """A function of the library: ``int64 name(char *image, more...)``.

    Attributes
    ----------
    pointer : Pointer
        What it calls.
    arguments : tuple
        In order: the place in the image where an argument's words stand; or the type of an argument of the library's
        function, which is handed on; or a number.
    """

    name: str
    pointer: Pointer
    arguments: tuple[Any, ...]


def known_processor() -> str:
    """Return the processor of compiled code.

    The code is that of this process.
    """
    return str(cpu_target.target_context.codegen()._get_host_cpu_name())


def features() -> frozenset[str]:
    """Return the processor features of compiled code.

    Compiled code of this process may use them.
    """
    if config.CPU_FEATURES is not None:
        return frozenset(name[1:] for name in config.CPU_FEATURES.split(",") if name[:1] == "+")
    return frozenset(name for name, has in llvm.get_host_cpu_features().items() if has)


def fuses() -> bool:
    """Tell whether code fuses products and sums.

    Code for several systems rounds them as one where the least processor can.
    """
    return "fma" in features()


def words_of(kind: Any) -> int:
    """Return the number of words of a value.

    A word has eight bytes; compiled code gets the value.
    """
    if isinstance(kind, Reference):
        return kind.words
    context = cpu_target.target_context
    return int(context.get_abi_sizeof(context.get_value_type(kind))) // 8


def symbol(pointer: Pointer) -> str:
    """Return the name of compiled code for C."""
    return str(_compiled(pointer).fndesc.llvm_cfunc_wrapper_name)


def object_codes(
    entries: Sequence[Entry], table: Sequence[Pointer], cache: Path, targets: Sequence[Target], *, alike: bool
) -> list[dict[str, bytes]]:
    """Return object files by name, per target.

    They have the entries and all that these call.

    Each function has a file of its own: what was made of it once serves every library that it is in.

    Parameters
    ----------
    entries : sequence of Entry
    table : sequence of Pointer
        Functions that an image points to, for ``lb_functions``, an array of their addresses.
    cache : Path
        Folder of compiled code, where these files are kept.
    alike : bool
        Whether the code is to have the same bits on every system: functions that they compute differently are refused.

    Raises
    ------
    SolverError
        When something in it cannot run without Python.
    """
    names: dict[str, str] = {}
    made: list[dict[str, bytes]] = [{} for _ in targets]
    for pointer in [*table, *(entry.pointer for entry in entries)]:
        if symbol(pointer) in names:
            continue
        name = names[symbol(pointer)] = f"lb_{_content(pointer)[:24]}"
        for found, code in zip(made, _kept(pointer, name, cache, targets, alike=alike), strict=True):
            found[f"{name}.o"] = code
    codegen = cpu_target.target_context.codegen()
    module = llvm.parse_assembly(str(_module_of_entries(codegen, names, entries, table)))
    for name in ("lb_functions", *(entry.name for entry in entries), *names.values()):
        _within(module, name)
    for found, target in zip(made, targets, strict=True):
        found["entries.o"] = machine_code(module, target)
    return made


def _kept(pointer: Pointer, name: str, cache: Path, targets: Sequence[Target], *, alike: bool) -> list[bytes]:
    """Return a function's object file per target.

    It comes from the cache where it is there.
    """
    part, made = None, []
    for target in targets:
        file = cache / f"portable-{name[3:]}" / f"{target.triple or 'here'}{'-alike' if alike else ''}.o"
        with suppress(OSError):
            made.append(file.read_bytes())
            continue
        part = part or _alone(pointer, name, alike=alike)
        made.append(machine_code(part, target))
        with suppress(OSError):  # a cache that cannot be written costs time only
            file.parent.mkdir(parents=True, exist_ok=True)
            temporary = file.with_name(f"{os.getpid()}.part")
            temporary.write_bytes(made[-1])
            temporary.replace(file)
    return made


def _alone(pointer: Pointer, name: str, *, alike: bool) -> Any:
    """Return a module with one function.

    It has a name, and all that it calls, without Python.
    """
    part = _part(pointer, name)
    caller = _compiled(pointer).fndesc.qualname
    _without_python(part, dict.fromkeys(_unknown(part), caller))
    part = llvm.parse_assembly(_TEXTS.sub(r"\1 [1 x i8] zeroinitializer", str(part)))
    _within(part, name)
    part.verify()
    if not alike:
        return part
    _refuse_unlike(part)
    return exact(part, fused=fuses())


def _refuse_unlike(module_ir: Any) -> None:
    unlike = sorted({each.name for each in module_ir.functions if each.is_declaration} & _UNLIKE)
    if unlike:
        raise SolverError(
            f"a law calls {', '.join(unlike)}, whose digits differ from system to system: export for linux alone"
        )


def data_code(name: str, data: bytes, target: Target) -> bytes:
    """Return an object file with constant bytes.

    They have a name, at a line of the processor's cache.
    """
    codegen = cpu_target.target_context.codegen()
    module = ir.Module("data")
    _constant(module, name, ir.ArrayType(BYTE, len(data)), bytearray(data)).align = 64
    module_ir = llvm.parse_assembly(_head(codegen) + str(module.globals[name]))
    _within(module_ir, name)
    return machine_code(module_ir, target)


def _within(module_ir: Any, name: str) -> None:
    """Keep a name within the library.

    Another bearing in the same process has it, too.
    """
    found = [each for each in (*module_ir.functions, *module_ir.global_variables) if each.name == name]
    found[0].visibility = "hidden"


def _head(codegen: Any) -> str:
    return f'target triple = "{codegen._llvm_module.triple}"\ntarget datalayout = "{codegen._data_layout}"\n'


def _content(pointer: Pointer) -> str:
    """Return the hash of an object file's sources.

    Everything that goes into the object file of a function counts.
    """
    made_by = b"".join(file.read_bytes() for file in (Path(__file__), Path(__file__).with_name("emission.py")))
    digest = hashlib.sha256(environment_key().encode() + made_by)
    digest.update(_compiled(pointer).library._get_module_for_linking().as_bitcode())
    return digest.hexdigest()


def unknown(pointer: Pointer) -> list[str]:
    """Return the functions that only Python has.

    Compiled code calls them.
    """
    return _unknown(_part(pointer, "wanted"))


def _unknown(part: Any) -> list[str]:
    declared = (each.name for each in part.functions if each.is_declaration)
    known = _LIBM | _MEMORY
    return [name for name in declared if not (name.startswith("llvm.") or name in known or _PYTHON.fullmatch(name))]


def _compiled(pointer: Pointer) -> Any:
    if is_plain():
        raise UsageError("compiled code cannot be taken out on the plain way: unset LAMBDA_BEARING_PLAIN_JIT")
    return pointer.compiled


def _part(pointer: Pointer, name: str) -> Any:
    """Return a module with hidden callees.

    Only the function has a name.
    """
    part = _compiled(pointer).library._get_module_for_linking().clone()
    for number, each in enumerate([*part.functions, *part.global_variables]):
        if each.name == symbol(pointer):
            each.linkage, each.name = "external", name  # as it is kept, linking would drop it
        elif not each.is_declaration:
            # Numba's names have up to 100 kB each.
            kind = _TEXT if each.name.startswith(".const.pick") else "k"
            each.linkage, each.name = "internal", f"{kind}{number}"
    _run(part, "add_global_dead_code_eliminate_pass")  # the wrappers for Python
    return part


def _module_of_entries(
    codegen: Any, names: Mapping[str, str], entries: Sequence[Entry], table: Sequence[Pointer]
) -> ir.Module:
    """Return a module with the entries.

    It has the table of functions, too.
    """
    module = ir.Module("entries")
    module.triple, module.data_layout = codegen._llvm_module.triple, codegen._data_layout
    known: dict[str, ir.Function] = {}

    def declared(pointer: Pointer) -> ir.Function:
        name, signature = names[symbol(pointer)], pointer.signature()
        if name not in known:
            kind = ir.FunctionType(_value(signature.return_type), [_value(each) for each in signature.args])
            known[name] = ir.Function(module, kind, name)
        return known[name]

    for entry in entries:
        _door(module, entry, declared(entry.pointer))
    addresses = [declared(pointer).bitcast(BYTE.as_pointer()) for pointer in table]
    _constant(module, "lb_functions", ir.ArrayType(BYTE.as_pointer(), len(addresses)), addresses)
    return module


def _value(kind: Any) -> Any:
    return cpu_target.target_context.get_value_type(kind)


def _constant(module: ir.Module, name: str, kind: Any, value: Any) -> Any:
    made = ir.GlobalVariable(module, kind, name)
    made.global_constant, made.initializer = True, ir.Constant(kind, value)
    return made


def _door(module: ir.Module, entry: Entry, called: ir.Function) -> None:
    """Add the function that calls an entry.

    It loads the arguments from the image.
    """
    more = [argument for argument in entry.arguments if isinstance(argument, ir.Type)]
    function = ir.Function(module, ir.FunctionType(WORD, [BYTE.as_pointer(), *more]), entry.name)
    builder, image, handed = ir.IRBuilder(function.append_basic_block()), function.args[0], iter(function.args[1:])
    arguments = []
    for argument, kind in zip(entry.arguments, entry.pointer.signature().args, strict=True):
        if isinstance(argument, ir.Type):
            arguments.append(next(handed))
        elif isinstance(argument, float):
            arguments.append(ir.Constant(REAL, argument))
        else:
            place = builder.gep(image, [ir.Constant(WORD, argument)])
            is_address = isinstance(kind, Reference)
            arguments.append(place if is_address else builder.load(builder.bitcast(place, _value(kind).as_pointer())))
    builder.ret(builder.call(called, arguments))


def _run(module_ir: Any, *names: str) -> None:
    """Run passes that change no arithmetic."""
    passes = llvm.create_new_module_pass_manager()
    for name in names:
        getattr(passes, name)()
    codegen = cpu_target.target_context.codegen()
    passes.run(module_ir, llvm.create_pass_builder(codegen._tm, llvm.create_pipeline_tuning_options(speed_level=0)))


def _without_python(module_ir: Any, callers: Mapping[str, str]) -> None:
    """Replace Python's functions by empty ones.

    Drop the values that only they used.
    """
    stubs: dict[str, str] = {}
    for each in [*module_ir.functions, *module_ir.global_variables]:
        name = each.name
        if not each.is_declaration or name.startswith("llvm.") or name in _LIBM:
            continue
        if name in _MEMORY:
            each.visibility = "hidden"
            continue
        if not _PYTHON.fullmatch(name):
            raise SolverError(f"{callers[name]} calls {name}, which is not there without Python: take another law")
        shape = _DECLARED.search(str(each))
        kind = shape[1] if shape else ""
        stubs[name] = (
            f"define {kind} @{name}{shape[2]} alwaysinline {{ ret {kind} {_RESULT.get(kind, '0')} }}"
            if shape
            else f"@{name} = global ptr null"
        )
    module_ir.link_in(llvm.parse_assembly("\n".join(stubs.values())))
    for each in [*module_ir.functions, *module_ir.global_variables]:
        if each.name in stubs:
            each.linkage = "internal"
    _run(module_ir, "add_always_inliner_pass", "add_global_dead_code_eliminate_pass")


def is_function(kind: Any) -> bool:
    """Tell whether a value is a function pointer.

    It points to a compiled function.
    """
    return isinstance(kind, types.FunctionType)


def is_array(kind: Any) -> bool:
    """Tell whether a value is an array."""
    return isinstance(kind, types.Array)
