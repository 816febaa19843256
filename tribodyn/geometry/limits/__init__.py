"""Whether a drive can be made and can run, and how far it is from those limits."""
