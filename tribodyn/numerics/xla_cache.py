"""Programs that XLA compiled are kept between processes, beside the native kernels."""

from functools import lru_cache

from tribodyn.numerics.cache import trusted_folder


@lru_cache(maxsize=1)
def use_compilation_cache() -> None:
    """Let JAX keep and read them; nothing where no folder can be trusted."""
    import jax

    folder = trusted_folder("xla")
    if folder is None:
        return
    jax.config.update("jax_compilation_cache_dir", str(folder))
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.2)
