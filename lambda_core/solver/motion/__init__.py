"""Right-hand side, equations of motion, energy, and the Jacobian. Compiled."""
