"""Damage of single teeth: what each kind does to the flanks of its tooth; patches and root cracks."""
