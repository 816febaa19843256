"""Finite elements of a full gear: flank compliance and root stress, along the lead too."""
