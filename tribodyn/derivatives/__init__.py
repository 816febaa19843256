"""Derivatives of the figures of a gear pair by the numbers of its scenario, through JAX."""
