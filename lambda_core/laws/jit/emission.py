"""Emit machine code of LLVM modules."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from typing import Any

import llvmlite.binding as llvm  # type: ignore[import-untyped]
from numba.core.registry import cpu_target

# How references are counted down on one kind of processor, in a form that all have.
_COUNT_DOWN = re.compile(r"^declare i8 @llvm\.x86\.atomic\.sub\.cc\.i64\(.*$", re.MULTILINE)
# Leave to round products and sums as one, or sums in another order: each kind of processor takes it otherwise.
_LEAVES = re.compile(
    r"\b(f(?:add|sub|mul|div|rem|neg|cmp)|call|select|phi)((?: (?:reassoc|nnan|ninf|nsz|arcp|contract|afn|fast))+) "
)
# A product, and a sum or difference that may be rounded with one of its operands as one.
_NAME = r'%(?:[-\w.$]+|"[^"]*")'
_PRODUCT = re.compile(rf"^  ({_NAME}) = fmul(?: \w+)*? contract (?:double|<\d+ x double>) (.+)$", re.MULTILINE)
_SUM = re.compile(rf"^  ({_NAME}) = f(add|sub)(?: \w+)*? contract (double|<\d+ x double>) (.+)$", re.MULTILINE)
_FIRST, _SECOND = re.compile(rf"({_NAME}), (.+)"), re.compile(rf"(.+), ({_NAME})")
_USE = re.compile(_NAME)
_ONCE = 2  # times that a name stands in a function: where it is made, and there
_FUNCTION = re.compile(r"^define .*?^}$", re.MULTILINE | re.DOTALL)
_FMA = {"double": "f64", "<2 x double>": "v2f64", "<4 x double>": "v4f64", "<8 x double>": "v8f64"}
_COUNTED_DOWN = """define internal i8 @lb_count_down(ptr %at, i64 %by, i32 %flag) {
  %before = atomicrmw sub ptr %at, i64 %by seq_cst
  %last = icmp eq i64 %before, %by
  %found = zext i1 %last to i8
  ret i8 %found
}"""


@dataclass(frozen=True)
class Target:
    """Target of machine code.

    Attributes
    ----------
    triple : str
        As LLVM names a system; "" is this one.
    """

    triple: str = ""

    @property
    def is_x86(self) -> bool:
        """True for the processor family of this process.

        Compiled code of this process is made for this family.
        """
        return not self.triple or self.triple.startswith("x86_64")


def machine_code(module_ir: Any, target: Target) -> bytes:
    """Return a module's object file.

    It is optimised no further.
    """
    codegen = cpu_target.target_context.codegen()
    cpu, features = (codegen._get_host_cpu_name(), codegen._tm_features) if target.is_x86 else ("generic", "")
    if target.triple:
        llvm.initialize_all_targets()
        llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(target.triple or module_ir.triple).create_target_machine(
        cpu=cpu, features=features, opt=3, reloc="pic", codemodel="default"
    )
    if target.triple:
        text = re.sub(
            '^target triple = ".*"$', f'target triple = "{target.triple}"', str(module_ir), flags=re.MULTILINE
        )
        layout = f'target datalayout = "{machine.target_data}"'
        text = re.sub('^target datalayout = ".*"$', layout, text, flags=re.MULTILINE)
        module_ir = llvm.parse_assembly(text if target.is_x86 else _without_x86(text))
    made: bytes = machine.emit_object(module_ir)
    return made


def exact(module_ir: Any, *, fused: bool) -> Any:
    """Return a module with exact IEEE 754 arithmetic.

    The arithmetic is as written, so every processor computes the same bits.

    Parameters
    ----------
    fused : bool
        Whether products and sums that may be rounded as one are written so: for processors that have such an
        instruction. Which ones would otherwise be settled for each kind of processor anew.
    """
    text = str(module_ir)
    if fused:
        text = _FUNCTION.sub(_fuse, text)
        for kind, name in _FMA.items():
            if not re.search(rf"^declare .*@llvm\.fma\.{name}\(", text, re.MULTILINE):
                text += f"\ndeclare {kind} @llvm.fma.{name}({kind}, {kind}, {kind})\n"
    return llvm.parse_assembly(_LEAVES.sub(r"\1 ", text))


def _fuse(found: re.Match[str]) -> str:
    """Return a function with fused products.

    A product that one sum alone uses is rounded with it.
    """
    uses = Counter(_USE.findall(found[0]))
    products = {name: _parted(factors) for name, factors in _PRODUCT.findall(found[0]) if uses[name] == _ONCE}

    def replaced(each: re.Match[str]) -> str:
        name, sign, kind, operands = each.groups()
        first, second = _parted(operands)
        if kind not in _FMA or not (first in products or second in products):
            return each[0]
        parts, turned = ([*products[first], second], 2) if first in products else ([*products[second], first], 0)
        lines = []
        if sign == "sub":
            turn = f'%"lb.{name[1:].strip(chr(34))}"'
            lines.append(f"  {turn} = fneg {kind} {parts[turned]}")
            parts[turned] = turn
        lines.append(f"  {name} = call {kind} @llvm.fma.{_FMA[kind]}({', '.join(f'{kind} {part}' for part in parts)})")
        return "\n".join(lines)

    return _SUM.sub(replaced, found[0])


def _parted(operands: str) -> tuple[str, str]:
    """Return both operands.

    At least one of them has a name: constants of vectors have commas of their own.
    """
    found = _FIRST.fullmatch(operands) or _SECOND.fullmatch(operands)
    return (found[1], found[2]) if found else ("", "")


def _without_x86(text: str) -> str:
    """Return code without the instructions of one kind of processor."""
    return _COUNT_DOWN.sub(_COUNTED_DOWN, text).replace("@llvm.x86.atomic.sub.cc.i64(", "@lb_count_down(")
