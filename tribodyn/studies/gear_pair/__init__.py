"""The dynamics of a gear pair."""
