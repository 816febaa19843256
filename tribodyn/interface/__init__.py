"""What a notebook uses: scenarios, runs, sweeps and gears as objects; `tribodyn/__init__.py` names them."""
