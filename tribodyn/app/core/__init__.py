"""The scenario that is open, its form, what is computed of it, and the process that computes."""
