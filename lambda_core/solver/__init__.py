"""Solve by compiled code; :mod:`lambda_core.solver.drivers` has its Python.

Nothing here is imported before a run needs it. The sources of all compiled code (everything below this folder but the
drivers) are hashed into the name of the compiled-code cache, so an edit anywhere in it is seen by the next process.
Helpers are compiled with `helper`; only the entry points of :mod:`lambda_core.solver.entry` are cached.
"""
