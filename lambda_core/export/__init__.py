"""Machines for other programs and documents: FMU, ROSS, stiffness, report."""
