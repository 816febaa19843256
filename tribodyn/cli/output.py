"""Folders that verbs write into."""

from pathlib import Path


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it, unless it is there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        from tribodyn.numerics.output_files import unwritable

        raise unwritable(folder, error) from None
