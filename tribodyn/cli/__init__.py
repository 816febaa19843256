"""The command line, one file a verb; nothing heavy is imported before a verb needs it."""


def main() -> None:
    """Run the command line; the entry point of the `tribodyn` command."""
    import os

    # the load contact model solves many small systems: a BLAS's threads spin over them for ten times the work
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    import tribodyn
    from tribodyn.cli.app import app

    tribodyn.OWN_PROCESS = True
    app(prog_name="tribodyn")
