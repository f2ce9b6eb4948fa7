"""Settings of a machine: solver, temperatures, circuit, observers."""
