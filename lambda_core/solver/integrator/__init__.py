"""Time integration: variable-step BDF, Newton iteration, block-arrow algebra. Compiled."""
