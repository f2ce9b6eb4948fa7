"""Laws of a machine: choice, parameters, context, functions of time."""
