"""Python around the compiled code: its inputs and its calls. No compiled code imports it."""
