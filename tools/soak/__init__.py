"""Random drives, duties and options: each is complete and consistent, or refused with a true reason.

    python -m tools.soak --seed 1                        # resumable: outcomes of this version are kept
    python -m tools.soak --seed 1 --case 17 --keep /tmp  # one case again; its scenario and record are kept
    python -m tools.soak --seed 1 --into docs/soak.md    # and the table; --so-far: without the rest

A case is a scenario file made from two numbers, the seed and the case; nothing else enters it.
"""
