"""A client of Dask's scheduler: of one that runs, or of a cluster of this machine."""

import logging
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

from tribodyn.errors import InputError, cut
from tribodyn.numerics.processes.child import isolated_environment


@contextmanager
def client_of(workers: int | None, scheduler: str | None) -> Iterator[Any]:
    """Give a client of the scheduler at an address, ``tcp://host:8786``, or of a cluster of this machine.

    That lives as long as the block and has so many processes; default: one per core. Raises InputError if
    Dask is not there, cannot read or use its settings, or no scheduler answers.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise InputError(
            "--engine", "dask", "Dask is not installed", 'install it: pip install "tribodyn[cluster]"'
        ) from None
    except Exception as error:  # of its settings, which it reads when it is imported
        raise _does_not_start(error) from error
    with ExitStack() as stack:
        try:
            if scheduler is None:
                stack.enter_context(isolated_environment())
                cluster = LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    dashboard_address=None,  # pyright: ignore[reportArgumentType]
                    silence_logs=logging.ERROR,
                )
                client = Client(stack.enter_context(cluster))
            else:
                client = Client(scheduler, timeout="10s")
        except Exception as error:
            if scheduler is None or not isinstance(error, (OSError, ValueError)):
                raise _does_not_start(error) from error
            rule = f"no scheduler answers there ({error})"
            raise InputError("--scheduler", scheduler, rule, "start one: dask scheduler") from None
        yield stack.enter_context(client)


def _does_not_start(error: Exception) -> InputError:
    reason = cut(" ".join(f"{type(error).__name__}: {error}".split()), 240)
    remedy = "correct Dask's settings: variables DASK_..., files in ~/.config/dask and of DASK_CONFIG"
    return InputError("--engine", "dask", f"Dask does not start: {reason}", remedy)


def workers_of(client: Any) -> int:
    """How many workers a client's scheduler has."""
    return max(1, len(client.scheduler_info(n_workers=-1)["workers"]))
