"""What a kernel that refuses leaves behind."""

from __future__ import annotations

from lambda_core.physics.compiled.layout import helper


@helper
def report(fault, role, status, which, i0, i1, i2, i3):
    """Record the first fault of an evaluation: role, the kernel's status, ring, inputs."""
    if fault[0] < 0.0:
        fault[0] = role
        fault[1] = status
        fault[3] = which
        fault[4], fault[5], fault[6], fault[7] = i0, i1, i2, i3
    return 0
