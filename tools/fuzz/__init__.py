"""Mutated input by the thousand: each is taken, or refused with an `InputError`, and nothing else happens.

`docs/fuzz.md` says what is drawn and what must hold; ``python -m tools.fuzz --help`` how to run it. An input
is made from two numbers, a seed and its own.
"""
