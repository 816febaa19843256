"""A client of Dask's scheduler: of one that runs, or of a cluster of this machine."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tribodyn.errors import InputError
from tribodyn.numerics.child import isolated_environment


@contextmanager
def client_of(workers: int | None, scheduler: str | None) -> Iterator[Any]:
    """Give a client of the scheduler at an address, ``tcp://host:8786``, or of a cluster of this machine.

    That lives as long as the block and has so many processes; default: one per core. Raises InputError if
    Dask is not there, or no scheduler answers.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise InputError(
            "--engine", "dask", "Dask is not installed", 'install it: pip install "tribodyn[cluster]"'
        ) from None
    if scheduler is None:
        with (
            isolated_environment(),
            LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                dashboard_address=None,  # pyright: ignore[reportArgumentType]
                silence_logs=logging.ERROR,
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        client = Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        rule = f"no scheduler answers there ({error})"
        raise InputError("--scheduler", scheduler, rule, "start one: dask scheduler") from None
    with client:
        yield client


def workers_of(client: Any) -> int:
    """How many workers a client's scheduler has."""
    return max(1, len(client.scheduler_info(n_workers=-1)["workers"]))
