"""Teeth in slow rotation under load, by finite elements."""
