"""Equations of motion over a mesh cycle, and what is recorded of them."""
