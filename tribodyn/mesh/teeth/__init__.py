"""Teeth one by one: what each tooth of a gear has of its own, and its table over the roll of a pair."""
