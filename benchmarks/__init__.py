"""Measure the speed of the program with ``python -m benchmarks``.

Every module measures one thing and returns a :class:`~benchmarks.tables.Section`. Times are minima over repeats of
the same work, ratios are taken within one process, and every table states the load of the machine.
"""

import os

# Everything is measured on one core; libraries read these when they are loaded.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
