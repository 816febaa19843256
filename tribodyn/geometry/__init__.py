"""Gear geometry: everything that follows from a path of contact, and the teeth that a rack cuts for it."""
