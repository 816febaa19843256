"""Film, rheology, heat and friction of a lubricated line contact: one family of closures per file."""
