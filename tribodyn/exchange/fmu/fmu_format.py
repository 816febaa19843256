"""FMUs for co-simulation: the archive and what stands in it."""

import io
import zipfile
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Any

from tribodyn.dynamics.parameters import with_shared_code
from tribodyn.errors import InputError, printable, quoted
from tribodyn.exchange.fmu.build import PLATFORMS, binaries, chosen_platforms
from tribodyn.exchange.fmu.code import sources_of
from tribodyn.exchange.fmu.description import (
    Experiment,
    build_description,
    identifier_of,
    model_description,
)
from tribodyn.exchange.fmu.oil import OilTable, UntabulatedError, oil_table
from tribodyn.exchange.fmu.page import page
from tribodyn.exchange.fmu.variables import variables_of
from tribodyn.exchange.format import (
    SCENARIO,
    SPEED,
    TEXT,
    TORQUE,
    ExchangeFormat,
    Exported,
    FormatChoice,
    GearboxInTime,
    Written,
)
from tribodyn.kernels.c import OutsideSubsetError
from tribodyn.solve.march.by_time import nominal_time

VERSIONS = ("3.0", "2.0")
#: Temperatures of the oil unless set, K: 0 and 120 °C.
_COLDEST, _WARMEST = 273.15, 393.15
#: Communication steps in a cycle of the first mesh that are proposed.
_STEPS = 20
#: Time in the archive: the earliest that it can hold.
_TIME = (1980, 1, 1, 0, 0, 0)


def write(exported: Exported, name: str, choices: Mapping[str, Any]) -> Written:
    """The FMU of a scenario."""
    version = _one_of("fmi", choices, VERSIONS)
    kinds = (
        _one_of("input_kind", choices, (TORQUE, SPEED)),
        _one_of("output_kind", choices, (TORQUE, SPEED)),
    )
    platforms = chosen_platforms(str(choices.get("platforms", ",".join(PLATFORMS))))
    if exported.in_time is None:
        raise exported.refused("describes no motion in time", "name a scenario of gears")
    gearbox = exported.in_time(*kinds)
    gearbox = gearbox._replace(model=with_shared_code(gearbox.model))
    oil, said_of_oil = _oil(gearbox, choices)
    variables, title = variables_of(gearbox, kinds, oil), str(exported.scenario.get("title", name))
    identifier = identifier_of(name)
    try:
        sources = sources_of(gearbox, kinds, oil, variables, version, identifier, title)
    except OutsideSubsetError as error:
        raise exported.refused(
            f"holds what has no counterpart in C: {error}", "use laws of this package"
        ) from None
    cycle = float(nominal_time(gearbox.model))
    experiment = Experiment(gearbox.duration, _rounded(cycle / _STEPS), gearbox.rtol)
    said_of_oil = said_of_oil if oil is None else _said_of(oil)
    remarks = (*gearbox.remarks, *([said_of_oil] if said_of_oil else []))
    facts = [f"FMI {version}, co-simulation; proposed communication step {experiment.step:g} s"]
    files: dict[str, str | bytes] = {
        "modelDescription.xml": model_description(
            version, name, title, printable(exported.path.name), sources, variables, experiment
        ),
        "documentation/index.html": page(title, exported.path.name, variables, facts, remarks),
        "documentation/licenses/license.txt": _licence(),
        **{f"sources/{file}": content for file, content in sources.files.items()},
    }
    if version == "3.0":
        files["sources/buildDescription.xml"] = build_description(name, sources)
    libraries = binaries(sources.files, sources.compiled, identifier, platforms, version)
    built = ", ".join(path.split("/")[1] for path in libraries) or "none: sources alone"
    said = (f"FMI {version}, {len(variables)} variables; libraries: {built}", *remarks)
    return Written({".fmu": _archive(files | libraries)}, remarks=said)


def _one_of(key: str, choices: Mapping[str, Any], known: tuple[str, ...]) -> str:
    """One of several words; the first unless set."""
    value = str(choices.get(key, known[0]))
    if value not in known:
        rule = f"must be {' or '.join(known)}"
        raise InputError(key, quoted(value), rule, f"write {key} = {quoted(known[0])}")
    return value


def _oil(gearbox: GearboxInTime, choices: Mapping[str, Any]) -> tuple[OilTable | None, str]:
    """Numbers over the temperature of the oil; or None, and why it is no input if remarks do not say it."""
    nominal, model_at = gearbox.oil_temperature, gearbox.at_temperature
    if nominal is None or model_at is None:
        for key in sorted(choices.keys() & {"oil_temperature_min", "oil_temperature_max"}):
            said = " ".join(gearbox.remarks[-1:])  # of the oil
            raise InputError(key, None, f"is no choice here: {said}", "omit it")
        return None, ""
    low = float(choices.get("oil_temperature_min", min(_COLDEST, nominal)))
    high = float(choices.get("oil_temperature_max", max(_WARMEST, nominal)))
    if not low < high or not low <= nominal <= high:
        rule = f"the scenario's oil, {nominal:.6g} K, must lie between {low:.6g} and {high:.6g} K"
        raise InputError("oil_temperature_min", f"{low:.6g} K", rule, "widen the range, or omit it")
    try:
        return oil_table(model_at, nominal, (low, high), gearbox.model), ""
    except UntabulatedError as reason:
        return None, f"the temperature of the oil is no input: {reason}"


def _said_of(oil: OilTable) -> str:
    """How exactly the temperature of the oil is an input."""
    low, high = oil.temperatures[[0, -1]] - 273.15
    return (
        f"oil from {low:.4g} to {high:.4g} degC: numbers of film and friction by cubics between "
        f"{len(oil.temperatures)} temperatures, relative error at most {oil.error:.1e}"
    )


def _rounded(step: float) -> float:
    """A step of one digit, at most as long."""
    digits = f"{step:.0e}"
    return float(digits) if float(digits) <= step else float(f"{int(digits[0]) - 1 or 0.9}{digits[1:]}")


def _licence() -> str:
    """The licence of tribodyn, whose sources these are in part."""
    try:
        text = distribution("tribodyn").read_text("licenses/LICENSE")
    except PackageNotFoundError:
        text = None
    beside = Path(__file__).parents[3] / "LICENSE"
    if text is None and beside.is_file():
        text = beside.read_text(encoding="utf-8")
    return text or "Apache License, Version 2.0: https://www.apache.org/licenses/LICENSE-2.0\n"


def _archive(files: Mapping[str, str | bytes]) -> bytes:
    """A ZIP archive whose bytes depend on its files alone; the first one stands as it is, with our mark."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, _TIME)
            entry.create_system = 3
            entry.compress_type = zipfile.ZIP_DEFLATED if archive.filelist else zipfile.ZIP_STORED
            entry.external_attr = (0o100755 if name.startswith("binaries/") else 0o100644) << 16
            archive.writestr(entry, content)
    return whole.getvalue()


FORMAT = ExchangeFormat(
    "fmu",
    "co-simulation unit (FMI 3.0 or 2.0) of a gearbox in time, without Python at the target",
    (".fmu",),
    takes=(SCENARIO,),
    write=write,
    choices={
        "fmi": FormatChoice(TEXT, "version of the standard: 3.0 or 2.0"),
        "platforms": FormatChoice(TEXT, "linux, windows, macos, single ones by their names, or none"),
        "input_kind": FormatChoice(TEXT, "what is prescribed at the input: torque or speed"),
        "output_kind": FormatChoice(TEXT, "what is prescribed at the output: torque or speed"),
        "oil_temperature_min": FormatChoice("temperature", "lowest temperature of the oil as an input"),
        "oil_temperature_max": FormatChoice("temperature", "highest temperature of the oil as an input"),
    },
)
