"""Maps of losses for other simulators, one file a format."""
