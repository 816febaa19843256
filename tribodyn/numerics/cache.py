"""Where results that cost time are kept between processes: compiled kernels, XLA's code, solved gears."""

import os
from pathlib import Path


def cache_folder() -> Path:
    """`TRIBODYN_CACHE`, or the user's cache folder."""
    if given := os.environ.get("TRIBODYN_CACHE"):
        return Path(given)
    from platformdirs import user_cache_path

    return user_cache_path("tribodyn")
