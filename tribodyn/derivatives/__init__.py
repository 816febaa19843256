"""Derivatives of the quantities of a gear pair by the numbers of its scenario, through JAX."""
