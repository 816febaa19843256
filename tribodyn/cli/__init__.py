"""The command line, one file a verb; nothing heavy is imported before a verb needs it."""


def main() -> None:
    """Run the command line; the entry point of the `tribodyn` command."""
    import tribodyn
    from tribodyn.cli.app import app

    tribodyn.OWN_PROCESS = True
    app(prog_name="tribodyn")
