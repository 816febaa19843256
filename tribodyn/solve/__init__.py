"""Integration of the equations of motion."""
