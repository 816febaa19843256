"""Records as files: whole or not at all, locked while written, kept once, read safely."""
