"""Machine code of LLVM's modules for this system and for others."""

from __future__ import annotations

import re
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
_COUNTED_DOWN = """define internal i8 @lb_count_down(ptr %at, i64 %by, i32 %flag) {
  %before = atomicrmw sub ptr %at, i64 %by seq_cst
  %last = icmp eq i64 %before, %by
  %found = zext i1 %last to i8
  ret i8 %found
}"""


@dataclass(frozen=True)
class Target:
    """What machine code is made for.

    Attributes
    ----------
    triple : str
        As LLVM names a system; "" is this one.
    """

    triple: str = ""

    @property
    def is_x86(self) -> bool:
        """Whether the processor is of the kind that compiled code of this process is for."""
        return not self.triple or self.triple.startswith("x86_64")


def machine_code(whole: Any, target: Target) -> bytes:
    """Return an object file of a module, which is optimised no further."""
    codegen = cpu_target.target_context.codegen()
    cpu, features = (codegen._get_host_cpu_name(), codegen._tm_features) if target.is_x86 else ("generic", "")
    if target.triple:
        llvm.initialize_all_targets()
        llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(target.triple or whole.triple).create_target_machine(
        cpu=cpu, features=features, opt=3, reloc="pic", codemodel="default"
    )
    if target.triple:
        text = re.sub('^target triple = ".*"$', f'target triple = "{target.triple}"', str(whole), flags=re.MULTILINE)
        layout = f'target datalayout = "{machine.target_data}"'
        text = re.sub('^target datalayout = ".*"$', layout, text, flags=re.MULTILINE)
        whole = llvm.parse_assembly(text if target.is_x86 else _without_x86(text))
    made: bytes = machine.emit_object(whole)
    return made


def exact(whole: Any) -> Any:
    """Return a module whose arithmetic is that of IEEE 754 as it is written, so that every processor has its bits."""
    return llvm.parse_assembly(_LEAVES.sub(r"\1 ", str(whole)))


def _without_x86(text: str) -> str:
    """Return code without the instructions of one kind of processor."""
    return _COUNT_DOWN.sub(_COUNTED_DOWN, text).replace("@llvm.x86.atomic.sub.cc.i64(", "@lb_count_down(")
