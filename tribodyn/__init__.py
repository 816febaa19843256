"""From tooth shape to transmission error, loads, film thickness and efficiency.

As a library::

    from tribodyn import load_scenario, open_record, run

    result = run(load_scenario("crc-23-47"), "crc.h5")
    with open_record(result.path) as record:
        print(record["normal_load"].max())
"""

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

#: Whether this process runs the command line and nothing else.
OWN_PROCESS = False

if TYPE_CHECKING:
    from tribodyn.errors import InputError, SimulationError
    from tribodyn.record.reader import open_record
    from tribodyn.studies.load import load_scenario
    from tribodyn.studies.run import run

__all__ = ["InputError", "SimulationError", "__version__", "load_scenario", "open_record", "run"]

# imported when asked for, so that `tribodyn --help` needs none of it
_PLACES = {
    "InputError": "tribodyn.errors",
    "SimulationError": "tribodyn.errors",
    "load_scenario": "tribodyn.studies.load",
    "open_record": "tribodyn.record.reader",
    "run": "tribodyn.studies.run",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module 'tribodyn' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_PLACES[name]), name)
