"""Plugins: hooks, entry points, what is installed, starting a new one."""
