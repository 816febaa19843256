"""``python -m tribodyn``: the same as the `tribodyn` command."""

from tribodyn.cli import main

main()
