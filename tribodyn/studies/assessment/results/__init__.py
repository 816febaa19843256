"""Assessments of a drive: what the other studies find, and load capacity by the standards beside it."""
