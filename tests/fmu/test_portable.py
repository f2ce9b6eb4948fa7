"""Test the private parts of Numba that laws/jit uses."""

from __future__ import annotations

import ctypes
import re
import subprocess
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm  # type: ignore[import-untyped]
import numba
import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
from lambda_core.analysis.electric.film_laws import film_laws
from lambda_core.domain.roles import ROLES
from lambda_core.export.fmu.image import Image
from lambda_core.laws.jit.emission import Target, exact
from lambda_core.laws.jit.machine_code import Pointer, role_signature
from lambda_core.laws.jit.portable import MEMORY_SOURCE, REAL, Entry, object_codes
from lambda_core.laws.jit.unstable import know_pointers
from lambda_core.laws.kernels import cache_folder, compile_host

_HOST = """#include <stdint.h>
#include <string.h>
extern void *const lb_functions[];
extern int64_t lb_ask(unsigned char *image, double film);
static const uint32_t relocations[][2] = {%s}, fixes[][2] = {%s};
int64_t ask(unsigned char *image, double film) {
  for (unsigned i = 0; i < sizeof relocations / sizeof *relocations; i++)
    *(uint64_t *)(image + relocations[i][0]) = (uint64_t)(uintptr_t)(image + relocations[i][1]);
  for (unsigned i = 0; i < sizeof fixes / sizeof *fixes; i++)
    *(uint64_t *)(image + fixes[i][0]) = (uint64_t)(uintptr_t)lb_functions[fixes[i][1]];
  return lb_ask(image, film);
}
"""
_ARRAY = numba.types.float64[::1]


def ask(law: Any, sizes: Any, par: Any, film: float, out: Any) -> int:
    """Ask a law of breakdown through a pointer; compiled below."""
    status = law(film, 0.8 * film, sizes[0], sizes[1], 0.3, 0.6, par, out)
    out[1] = np.exp(-out[0]) + sizes[0] * film
    return status


@pytest.mark.parametrize("alike", [False, True])
def test_a_law_behind_a_pointer_runs_in_a_library(c_compiler: tuple[str, ...], tmp_path: Path, alike: bool) -> None:
    """Call a law by pointer without Python.

    The library has the words of pointers and arrays and the code behind them; the bits are those of the call from
    Python.
    """
    know_pointers()
    kind = numba.types.FunctionType(role_signature(ROLES["breakdown"]))
    bearing = circuit_bearings(api.check("6208-axial-1300"))[0]
    law, _ = film_laws(bearing.laws, bearing.contexts)
    signature = numba.types.int64(kind, _ARRAY, _ARRAY, numba.types.float64, _ARRAY)
    host = compile_host(ask, signature, (Path(__file__),))
    par, sizes, out = law.par[0], np.array([2e-7, 3e-8]), np.zeros(2)
    expected = host.dispatcher(law.kernel.pointer, sizes, par, 3e-7, out), *out
    assert np.isfinite(expected).all()
    out[:] = 0.0
    sections = [("law", kind, law.kernel.pointer), ("sizes", _ARRAY, sizes), ("par", _ARRAY, par), ("out", _ARRAY, out)]
    image = Image(sections, [], [])
    at = image.sections
    entry = Entry("lb_ask", Pointer(host.dispatcher, signature), (at["law"], at["sizes"], at["par"], REAL, at["out"]))
    (codes,) = object_codes([entry], image.functions, cache_folder(), [Target()], alike=alike)
    for name, code in codes.items():
        (tmp_path / name).write_bytes(code)
    pairs = (",".join(f"{{{a},{b}}}" for a, b in each) for each in (image.relocations, image.fixes))
    (tmp_path / "host.c").write_text(_HOST % tuple(pairs))
    library = tmp_path / "asked.so"
    files = [str(tmp_path / "host.c"), *(str(tmp_path / name) for name in codes), str(MEMORY_SOURCE)]
    subprocess.run([*c_compiler, "-O1", "-shared", "-fPIC", *files, "-o", str(library), "-lm"], check=True)
    call = ctypes.CDLL(str(library)).ask
    call.restype, call.argtypes = ctypes.c_int64, [ctypes.c_void_p, ctypes.c_double]
    data = np.frombuffer(image.bytes(), np.uint8).copy()
    status = call(data.ctypes.data, 3e-7)
    found = data[image.place(out) :][:16].view(np.float64)
    assert (status, *found) == pytest.approx(expected, rel=1e-15 if alike else 0.0, abs=0.0)


_SUMS = """
define double @it(double %a, double %b, double %c, <2 x double> %v, ptr %to) {
  %p = fmul contract double %a, %b
  %q = fmul reassoc contract double %b, %c
  %".r" = fmul contract double %a, %c
  %kept = fmul double %a, %a
  %w = fmul contract <2 x double> %v, <double 2.0, double 3.0>
  %1 = fadd contract double %p, %c
  %2 = fsub reassoc nsz contract double %1, %q
  %3 = fsub contract double %".r", 1.0
  %4 = fadd contract double %3, %2
  %5 = fmul contract double %4, %4
  %6 = fadd contract double %5, %5
  %7 = fadd contract double %6, %kept
  %8 = fadd contract <2 x double> <double 1.0, double 5.0>, %w
  store <2 x double> %8, ptr %to
  ret double %7
}
"""


def test_products_and_sums_are_fused_where_it_is_written() -> None:
    """Fuse one product with one sum, on either side.

    A product that two sums use, or that is not marked, is rounded by itself.
    """
    complete = exact(llvm.parse_assembly(_SUMS), fused=True)
    complete.verify()
    lines = [line.strip() for line in str(complete).splitlines()]
    calls = [re.sub(r"\s+", " ", line) for line in lines if "call " in line]
    assert [line.partition(" = ")[2] for line in calls] == [
        "call double @llvm.fma.f64(double %a, double %b, double %c)",
        "call double @llvm.fma.f64(double %lb.2, double %c, double %1)",
        "call double @llvm.fma.f64(double %a, double %c, double %lb.3)",
        "call <2 x double> @llvm.fma.v2f64(<2 x double> %v, <2 x double> <double 2.000000e+00, double 3.000000e+00>, "
        "<2 x double> <double 1.000000e+00, double 5.000000e+00>)",
    ]
    assert {"%lb.2 = fneg double %b", "%lb.3 = fneg double 1.000000e+00"} <= set(lines)
    assert "%6 = fadd double %5, %5" in lines
    assert "%7 = fadd double %6, %kept" in lines
    assert "contract" not in str(complete)
    assert "llvm.fma" not in str(exact(llvm.parse_assembly(_SUMS), fused=False))
