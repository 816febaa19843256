"""Gear pairs: what their scenarios say, and what is theirs alone."""
