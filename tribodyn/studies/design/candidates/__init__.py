"""Candidates of a search: from free keys to cases, figures and worth."""
