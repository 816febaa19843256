"""The command line, one file a verb; nothing heavy is imported before a verb needs it."""


def main() -> None:
    """Run the command line; the entry point of the `tribodyn` command."""
    from tribodyn.cli.app import app

    app(prog_name="tribodyn")
