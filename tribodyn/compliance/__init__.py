"""Elasticity of gear pairs: tooth bending, gear body, contact; nothing here knows about time."""
