"""Compile functions inside their callers only.

Numba completes every function that compiled code calls as if it were called from elsewhere too: with wrappers for
Python and C, optimised and turned into machine code, although a caller takes in its intermediate code and has that
optimised again together with its own. All this is left out here, half of the time that compiling the solver took.

Such functions are also forced into their callers. Between compiled functions an array travels as its seven fields and
a result through memory, next to a status: calls were a quarter of the right-hand side's time.
"""

# Numba's compiler carries only part of its types.
# mypy: disable-error-code="no-untyped-call,no-untyped-def,misc"
from __future__ import annotations

from typing import Any

from numba._dynfunc import make_function
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler


class _Part(JITCodeLibrary):
    """Intermediate code of one function.

    It includes those of functions that it calls, for its callers.
    """

    def finalize(self) -> None:
        """Close the library.

        Link called functions, and leave the rest to the caller.
        """
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            self._reload_init.update(library._reload_init)
            self._final_module.link_in(library._get_module_for_linking(), preserve=True)
        self._final_module.verify()
        self._finalize_dynamic_globals()
        self._finalized = True


def _without_code(library: _Part, fndesc: Any, env: Any) -> Any:
    """Return a function's entry without code.

    Numba's tables take it.
    """
    library._ensure_finalized()
    return make_function(fndesc.lookup_module(), fndesc.qualname.rpartition(".")[2], "", 0, env, (library,))


class _PartCompiler(Compiler):
    def define_pipelines(self) -> Any:
        state = self.state
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        state.targetctx.get_executable = _without_code
        return super().define_pipelines()


class _ApartCompiler(_PartCompiler):
    """Compiler for arrays that do not overlap.

    LLVM then needs no check for overlap at the start of a vectorised loop.
    """

    def define_pipelines(self) -> Any:
        self.state.flags.noalias = True
        return super().define_pipelines()


class _LawCompiler(Compiler):
    """Compiler of a law.

    The arrays that it gets do not overlap.
    """

    def define_pipelines(self) -> Any:
        self.state.flags.noalias = True
        return super().define_pipelines()


class _LargePart(_Part):
    """Function that stays separate.

    Its callers call it, in place of a copy in each of them.
    """

    def add_ir_module(self, ir_module: Any) -> None:
        """Take in the function from Numba.

        It is marked to stay where it is.
        """
        for function in ir_module.functions:
            if function.blocks:
                function.attributes.add("noinline")
        super().add_ir_module(ir_module)


class _LargeCompiler(Compiler):
    def define_pipelines(self) -> Any:
        state = self.state
        state.library = _LargePart(state.targetctx.codegen(), state.func_id.func_qualname)
        state.targetctx.get_executable = _without_code
        return super().define_pipelines()


KNOWN = hasattr(JITCodeLibrary, "_get_module_for_linking") and hasattr(Compiler, "define_pipelines")
# For numba.njit. There is nothing behind such a function that Python could call: its Python function is .py_func.
OPTIONS: dict[str, Any] = {
    "pipeline_class": _PartCompiler,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
    "forceinline": True,
}
# The same for a function none of whose arrays shares memory with another one that is written.
APART: dict[str, Any] = {**OPTIONS, "pipeline_class": _ApartCompiler}
# For laws, which are called from elsewhere.
LAW: dict[str, Any] = {"pipeline_class": _LawCompiler}
# The same for a large function that several places call: one copy in the code of an entry point. A call costs some ten
# nanoseconds, and LLVM's work grows faster than the code of one function. A function that takes functions as arguments
# cannot be one: Numba would write an address of this process into its code.
LARGE: dict[str, Any] = {**OPTIONS, "pipeline_class": _LargeCompiler, "forceinline": False}
