"""The XML files of an FMU: modelDescription.xml of both versions, and buildDescription.xml."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from typing import NamedTuple

from tribodyn import __version__
from tribodyn.exchange.fmu.code import FmuSources
from tribodyn.exchange.fmu.variables import UNLIMITED, FmuVariable, Role
from tribodyn.exchange.heading import without_double_hyphens

#: Unit -> exponents of SI base units, as the standard names them; and units to be shown, by their factors and
#: offsets.
_UNITS: Mapping[str, Mapping[str, int]] = {
    "s": {"s": 1},
    "rad": {"rad": 1},
    "rad/s": {"s": -1, "rad": 1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m/rad": {"kg": 1, "m": 2, "s": -2, "rad": -1},
    "N.m.s/rad": {"kg": 1, "m": 2, "s": -1, "rad": -1},
    "W": {"kg": 1, "m": 2, "s": -3},
    "J": {"kg": 1, "m": 2, "s": -2},
    "m": {"m": 1},
    "K": {"K": 1},
    "1": {},
}
_SHOWN: Mapping[str, tuple[str, Mapping[str, str]]] = {
    "rad/s": ("rpm", {"factor": "9.549296585513721"}),
    "K": ("degC", {"offset": "-273.15"}),
    "m": ("um", {"factor": "1000000.0"}),
}
_FLAGS = {
    "canHandleVariableCommunicationStepSize": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "canBeInstantiatedOnlyOncePerProcess": "false",
}
CATEGORIES = {"logStatusError": "why a call failed", "logStep": "every communication step"}


class Experiment(NamedTuple):
    """What is simulated unless the importer says otherwise, s."""

    stop: float
    step: float
    tolerance: float


def identifier_of(name: str) -> str:
    """A name as an identifier of C, of which files are named."""
    text = "".join(each if each.isascii() and each.isalnum() else "_" for each in name)
    return text if text[:1].isalpha() else f"fmu_{text}"


def model_description(
    version: str,
    name: str,
    title: str,
    origin: str,
    sources: FmuSources,
    variables: tuple[FmuVariable, ...],
    experiment: Experiment,
) -> str:
    """modelDescription.xml of a version; a comment says of what file, the `origin`, it was written."""
    third = version == "3.0"
    root = ET.Element(
        "fmiModelDescription",
        {
            "fmiVersion": version,
            "modelName": name,
            "instantiationToken" if third else "guid": sources.token,
            "description": title,
            "copyright": "sources of tribodyn: Apache License 2.0",
            "license": "Apache-2.0",
            "generationTool": f"tribodyn {__version__}",
            "variableNamingConvention": "flat",
        },
    )
    flags = {key.replace("FMUstate", "FMUState") if third else key: value for key, value in _FLAGS.items()}
    if not third:
        flags |= {"canNotUseMemoryManagementFunctions": "true"}
    simulation = ET.SubElement(root, "CoSimulation", {"modelIdentifier": identifier_of(name), **flags})
    if not third:
        several = ET.SubElement(simulation, "SourceFiles")
        for file in sources.compiled:
            ET.SubElement(several, "File", {"name": file})
    _units(root, {each.unit for each in variables})
    categories = ET.SubElement(root, "LogCategories")
    for category, about in CATEGORIES.items():
        ET.SubElement(categories, "Category", {"name": category, "description": about})
    ET.SubElement(
        root,
        "DefaultExperiment",
        {
            "startTime": "0.0",
            "stopTime": repr(experiment.stop),
            "tolerance": repr(experiment.tolerance),
            "stepSize": repr(experiment.step),
        },
    )
    of_variables = ET.SubElement(root, "ModelVariables")
    for number, variable in enumerate(variables):
        (_variable_3 if third else _variable_2)(of_variables, number, variable)
    _structure(ET.SubElement(root, "ModelStructure"), variables, third=third)
    made = without_double_hyphens(f"written by tribodyn {__version__} from {origin}")
    return _text(root, f"<!-- {made} -->\n")


def build_description(name: str, sources: FmuSources) -> str:
    """buildDescription.xml of version 3.0."""
    root = ET.Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    built = ET.SubElement(root, "BuildConfiguration", {"modelIdentifier": identifier_of(name)})
    several = ET.SubElement(built, "SourceFileSet", {"language": "C99"})
    for file in sources.compiled:
        ET.SubElement(several, "SourceFile", {"name": file})
    about = "mathematics of C; part of it on Windows and macOS"
    ET.SubElement(built, "Library", {"name": "m", "external": "true", "description": about})
    return _text(root)


def _text(root: ET.Element, comment: str = "") -> str:
    ET.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{comment}' + ET.tostring(root, encoding="unicode") + "\n"


def _units(root: ET.Element, used: set[str]) -> None:
    definitions = ET.SubElement(root, "UnitDefinitions")
    for unit in (each for each in _UNITS if each in used):
        element = ET.SubElement(definitions, "Unit", {"name": unit})
        ET.SubElement(element, "BaseUnit", {key: str(power) for key, power in _UNITS[unit].items()})
        if unit in _SHOWN:
            shown, how = _SHOWN[unit]
            ET.SubElement(element, "DisplayUnit", {"name": shown, **how})


_CAUSALITY = {
    Role.TIME: ("independent", "continuous"),
    Role.INPUT: ("input", "continuous"),
    Role.FIXED: ("parameter", "fixed"),
    Role.TUNABLE: ("parameter", "tunable"),
    Role.OUTPUT: ("output", "continuous"),
}


def _limits(variable: FmuVariable) -> dict[str, str]:
    """What of its unit, limits and start is written."""
    found = {"unit": variable.unit}
    if variable.minimum > -UNLIMITED:
        found["min"] = repr(float(variable.minimum))
    if variable.maximum < UNLIMITED:
        found["max"] = repr(float(variable.maximum))
    if variable.role not in (Role.TIME, Role.OUTPUT):
        found["start"] = repr(float(variable.start))
    return found


def _initial(variable: FmuVariable) -> dict[str, str]:
    if variable.role is Role.OUTPUT:
        return {"initial": "calculated"}
    return {"initial": "exact"} if variable.role in (Role.FIXED, Role.TUNABLE) else {}


def _variable_3(parent: ET.Element, number: int, variable: FmuVariable) -> None:
    causality, variability = _CAUSALITY[variable.role]
    ET.SubElement(
        parent,
        "Float64",
        {
            "name": variable.name,
            "valueReference": str(number),
            "causality": causality,
            "variability": variability,
            **_initial(variable),
            "description": variable.about,
            **_limits(variable),
        },
    )


def _variable_2(parent: ET.Element, number: int, variable: FmuVariable) -> None:
    causality, variability = _CAUSALITY[variable.role]
    element = ET.SubElement(
        parent,
        "ScalarVariable",
        {
            "name": variable.name,
            "valueReference": str(number),
            "causality": causality,
            "variability": variability,
            **_initial(variable),
            "description": variable.about,
        },
    )
    ET.SubElement(element, "Real", _limits(variable))


def _structure(parent: ET.Element, variables: tuple[FmuVariable, ...], *, third: bool) -> None:
    """Outputs, those of the state without dependence on inputs; at the start all depend on what is set."""
    outputs = [(number, each) for number, each in enumerate(variables) if each.role is Role.OUTPUT]
    if third:
        for number, each in outputs:
            none = {"dependencies": ""} if each.of_state else {}
            ET.SubElement(parent, "Output", {"valueReference": str(number), **none})
        for number, _ in outputs:
            ET.SubElement(parent, "InitialUnknown", {"valueReference": str(number)})
        return
    several = ET.SubElement(parent, "Outputs")
    for number, each in outputs:
        none = {"dependencies": ""} if each.of_state else {}
        ET.SubElement(several, "Unknown", {"index": str(number + 1), **none})
    several = ET.SubElement(parent, "InitialUnknowns")
    for number, _ in outputs:
        ET.SubElement(several, "Unknown", {"index": str(number + 1)})
