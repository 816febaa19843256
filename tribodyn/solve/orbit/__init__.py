"""Steady states of periodically driven systems, and their stability."""
