"""The bearing as a part of an electric circuit: what its films let through, and where they break down.

A reader of contact samples; nothing here acts back on the motion.
"""
