"""The words of the field, once: errors, units, roles, channels; theory of bearings that needs no model."""
