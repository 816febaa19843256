"""Where results that cost time are kept between processes, and how a file appears: whole or not at all."""

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def cache_folder() -> Path:
    """`TRIBODYN_CACHE`, or the user's cache folder: compiled kernels, XLA's code, solved gears."""
    if given := os.environ.get("TRIBODYN_CACHE"):
        return Path(given)
    from platformdirs import user_cache_path

    return user_cache_path("tribodyn")


@contextmanager
def replacing(file: Path, scratch: Path | None = None) -> Iterator[Path]:
    """Write a file under another name and give it its own by renaming, so that no reader sees half of it.

    Yields the path to write to. If that ends with an error, nothing is left behind and `file` is as before.

    Parameters
    ----------
    file : path
        Its folder is made if it is not there.
    scratch : path, optional
        In the same folder; by default a name that no other thread or process uses.
    """
    if scratch is None:
        file.parent.mkdir(parents=True, exist_ok=True)
        scratch = file.with_name(f"{file.name}.{os.getpid()}-{threading.get_ident()}.tmp")
    try:
        yield scratch
        os.replace(scratch, file)
    except BaseException:
        # a folder that is none has no scratch file either
        if os.path.exists(scratch):
            scratch.unlink()
        raise
