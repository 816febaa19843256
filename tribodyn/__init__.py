"""From tooth shape to transmission error, loads, film thickness and efficiency.

As a library::

    import tribodyn as td

    crc = td.run("crc-23-47", {"operating.gear_torque": "600 N*m"})
    crc.summary["efficiency"], crc.data["normal_load"].max()
    crc.plot("film")

`docs/extending.md` says how laws, tooth families and kinds of study are added from outside.
"""

from typing import TYPE_CHECKING, Any

# a folder with a name of the interface: imported and unbound, so that no later import binds this name
from tribodyn import standards

del standards

__version__ = "0.2.0"

#: Whether this process runs the command line and nothing else.
OWN_PROCESS = False

if TYPE_CHECKING:
    from collections.abc import Callable

    from tribodyn import signals as signals
    from tribodyn.derivatives.differentiable import Differentiable
    from tribodyn.errors import InputError, OutputError, SimulationError
    from tribodyn.exchange.format import ExchangeFormat
    from tribodyn.exchange.matrix_files import write_matrices
    from tribodyn.geometry.families import Family
    from tribodyn.interface import standards as standards
    from tribodyn.interface.drive import GearPair, NamedGear, constraints, drive, gear
    from tribodyn.interface.exchange import export, import_measured, import_scenario
    from tribodyn.interface.explore import explore
    from tribodyn.interface.gradient import Gradient, differentiable, gradient
    from tribodyn.interface.identify import Identified, identify
    from tribodyn.interface.line_contact import line_contact
    from tribodyn.interface.result import Run
    from tribodyn.interface.run import check, run, run_meshes
    from tribodyn.interface.scenario import scenario
    from tribodyn.interface.sweep import Sweep, sweep
    from tribodyn.interface.sweep import open_result as open
    from tribodyn.interface.validation import validate
    from tribodyn.numerics.parameter import Parameter
    from tribodyn.studies.protocol.study import Study
    from tribodyn.studies.protocol.verb import Finding
    from tribodyn.train.elastic.plate_housing import plate_housing
    from tribodyn.train.links.law import LinkLaw
    from tribodyn.tribology.law import FilmLaw, FrictionLaw
    from tribodyn.tribology.wear.law import WearLaw

    Design: type[Run]
    Map: type[Run]
    design: Callable[..., Run]
    map: Callable[..., Run]
    compare_laws: Callable[..., Finding]

__all__ = [
    "Design",
    "Differentiable",
    "ExchangeFormat",
    "Family",
    "FilmLaw",
    "FrictionLaw",
    "GearPair",
    "Gradient",
    "Identified",
    "InputError",
    "LinkLaw",
    "Map",
    "NamedGear",
    "OutputError",
    "Parameter",
    "Run",
    "SimulationError",
    "Study",
    "Sweep",
    "WearLaw",
    "__version__",
    "check",
    "compare_laws",
    "constraints",
    "design",
    "differentiable",
    "drive",
    "explore",
    "export",
    "gear",
    "gradient",
    "identify",
    "import_measured",
    "import_scenario",
    "line_contact",
    "map",
    "open",
    "plate_housing",
    "run",
    "run_meshes",
    "scenario",
    "signals",
    "standards",
    "sweep",
    "validate",
    "write_matrices",
]

# imported when asked for, so that `tribodyn --help` needs none of it
_PLACES = {
    "Differentiable": "tribodyn.derivatives.differentiable",
    "ExchangeFormat": "tribodyn.exchange.format",
    "Family": "tribodyn.geometry.families",
    "FilmLaw": "tribodyn.tribology.law",
    "FrictionLaw": "tribodyn.tribology.law",
    "NamedGear": "tribodyn.interface.drive",
    "GearPair": "tribodyn.interface.drive",
    "Gradient": "tribodyn.interface.gradient",
    "Identified": "tribodyn.interface.identify",
    "InputError": "tribodyn.errors",
    "LinkLaw": "tribodyn.train.links.law",
    "OutputError": "tribodyn.errors",
    "Parameter": "tribodyn.numerics.parameter",
    "Run": "tribodyn.interface.result",
    "SimulationError": "tribodyn.errors",
    "Study": "tribodyn.studies.protocol.study",
    "Sweep": "tribodyn.interface.sweep",
    "WearLaw": "tribodyn.tribology.wear.law",
    "check": "tribodyn.interface.run",
    "constraints": "tribodyn.interface.drive",
    "differentiable": "tribodyn.interface.gradient",
    "drive": "tribodyn.interface.drive",
    "explore": "tribodyn.interface.explore",
    "export": "tribodyn.interface.exchange",
    "gear": "tribodyn.interface.drive",
    "gradient": "tribodyn.interface.gradient",
    "identify": "tribodyn.interface.identify",
    "import_measured": "tribodyn.interface.exchange",
    "import_scenario": "tribodyn.interface.exchange",
    "line_contact": "tribodyn.interface.line_contact",
    "open": "tribodyn.interface.sweep:open_result",
    "plate_housing": "tribodyn.train.elastic.plate_housing",
    "run": "tribodyn.interface.run",
    "run_meshes": "tribodyn.interface.run",
    "scenario": "tribodyn.interface.scenario",
    "sweep": "tribodyn.interface.sweep",
    "validate": "tribodyn.interface.validation",
    "write_matrices": "tribodyn.exchange.matrix_files",
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _PLACES:
        module, _, attribute = _PLACES[name].partition(":")
        return getattr(import_module(module), attribute or name)
    if name == "signals":
        return import_module("tribodyn.signals")
    if name == "standards":
        return import_module("tribodyn.interface.standards")
    if not name.startswith("_"):
        from tribodyn.interface.run import offered

        if value := offered(name):
            return value
    raise AttributeError(f"module 'tribodyn' has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
