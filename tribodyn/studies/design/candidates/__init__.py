"""Candidates of a search: from free keys to cases, quantities and scores."""
