"""Gears in a scenario: teeth, blanks, quality, material, single teeth and their damage."""
