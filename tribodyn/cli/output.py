"""Folders that verbs write into."""

from pathlib import Path

from tribodyn.errors import InputError


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it, unless it is there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(folder, error) from None


def unwritable(folder: Path, error: OSError) -> InputError:
    """Return what to say of a folder that the system does not let us write into."""
    reason = (error.strerror or str(error)).lower()
    return InputError(
        "output", str(folder), f"cannot be written to: {reason}", "choose another folder with --output"
    )
