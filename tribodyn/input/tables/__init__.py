"""Tables of a scenario that several kinds of study share, and their rules."""
