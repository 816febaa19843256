"""The command line, one file per verb; nothing heavy is imported before a verb needs it."""


def main() -> None:
    """Run the command line; the entry point of the `tribodyn` command."""
    import sys

    from tribodyn.cli.outcome import end_when_asked, message_of, status_of

    end_when_asked()
    try:
        _main()
    except (KeyboardInterrupt, SystemExit) as end:
        # before a verb has begun; typer ends without a word then
        interruption = getattr(end.__context__, "__cause__", None) if isinstance(end, SystemExit) else end
        if not isinstance(interruption, KeyboardInterrupt):
            raise
        sys.stderr.write(f"{message_of(interruption)}\n")
        raise SystemExit(status_of(interruption)) from None


def _main() -> None:
    import gc
    import os
    import sys

    from tribodyn.numerics.processes.child import safe_path
    from tribodyn.numerics.processes.libraries import ignore_settings

    # `python -m` and an empty entry of PYTHONPATH would import from the current folder
    sys.path[:] = safe_path()
    ignore_settings()
    # start-up makes objects that stay: to look through them for cycles would be a tenth of its time
    gc.set_threshold(300_000)
    # the library keeps small systems to one thread of BLAS: the others need not be begun
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # pydantic would look through all that is installed for plugins of its own
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    if sys.argv[1:2] == ["run"]:
        from tribodyn.cli.pictures import begin

        begin(sys.argv[1:])
    import tribodyn
    from tribodyn.cli.app import app

    tribodyn.OWN_PROCESS = True
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by whoever started us
            setattr(sys, name, open(os.devnull, "w"))
        # a terminal that knows no µ gets a question mark
        getattr(sys, name).reconfigure(errors="replace")
    try:
        app(prog_name="tribodyn")
    finally:
        # the process ends: to look through all objects once more would be a seventh of its time
        gc.freeze()
