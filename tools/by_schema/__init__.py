"""Scenarios drawn from the schema: every key of every kind, with values of its type.

`keys` goes through the keys, `values` draws what may stand there, `changes` puts it into a scenario and makes
the scenario whole again where rules ask for more.
"""
