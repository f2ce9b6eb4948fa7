"""The published experiments repeated: torque of the 6319, stability of the 6220, capacitance of the 6208."""
