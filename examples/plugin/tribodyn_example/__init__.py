"""A tooth family, a friction law, a film law and a kind of study for tribodyn: one file or folder each."""
