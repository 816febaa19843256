"""Assessments of a train: motion at the duty and over the speed, and every mesh by the standards."""
