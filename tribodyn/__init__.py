"""From tooth shape to transmission error, loads, film thickness and efficiency.

As a library::

    from tribodyn import load_scenario, open_record, run

    result = run(load_scenario("crc-23-47"), "crc.h5")
    with open_record(result.path) as record:
        print(record["normal_load"].max())

`docs/extending.md` says how laws, tooth families and kinds of study are added from outside.
"""

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

#: Whether this process runs the command line and nothing else.
OWN_PROCESS = False

if TYPE_CHECKING:
    from tribodyn.errors import InputError, SimulationError
    from tribodyn.geometry.family import Family
    from tribodyn.numerics.parameter import Parameter
    from tribodyn.record.reader import open_record
    from tribodyn.studies.load import load_scenario
    from tribodyn.studies.run import run
    from tribodyn.studies.study import Study
    from tribodyn.tribology.law import FilmLaw, FrictionLaw

__all__ = [
    "Family",
    "FilmLaw",
    "FrictionLaw",
    "InputError",
    "Parameter",
    "SimulationError",
    "Study",
    "__version__",
    "load_scenario",
    "open_record",
    "run",
]

# imported when asked for, so that `tribodyn --help` needs none of it
_PLACES = {
    "Family": "tribodyn.geometry.family",
    "FilmLaw": "tribodyn.tribology.law",
    "FrictionLaw": "tribodyn.tribology.law",
    "InputError": "tribodyn.errors",
    "Parameter": "tribodyn.numerics.parameter",
    "SimulationError": "tribodyn.errors",
    "Study": "tribodyn.studies.study",
    "load_scenario": "tribodyn.studies.load",
    "open_record": "tribodyn.record.reader",
    "run": "tribodyn.studies.run",
}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module 'tribodyn' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_PLACES[name]), name)


def __dir__() -> list[str]:
    return __all__
