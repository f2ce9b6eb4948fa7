"""Contact of a ball with a raceway: kinematics, stages, wrench, tangent, losses, capacitance. Compiled."""
