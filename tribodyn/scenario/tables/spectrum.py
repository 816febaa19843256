"""Load spectra: duties with shares of time, each of which takes the place of what [operating] says."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any

from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.scenario.common import ScenarioHead, Temperature
from tribodyn.scenario.quantity import Positive, Weighed
from tribodyn.scenario.tables.duty import LOADS, SPEEDS, DutyTable, broken_duty_rules

#: What a duty says in place of [operating].
_TAKEN = (*SPEEDS, *LOADS, "oil_temperature")
#: Duties of a spectrum.
MOST_DUTIES = 1000


class SpectrumDuty(DutyTable):
    """One duty of a load spectrum; what it does not give is that of [operating]."""

    share: Positive = Field(description="of the time; shares count by their sum")
    oil_temperature: Temperature | None = Field(None, description="in place of that of [operating]")


class OperatingTable(DutyTable):
    """Speed and load, and which duty of a spectrum takes their place."""

    duty: Annotated[int, Field(strict=True, ge=1, le=MOST_DUTIES), Weighed("duty", "share")] | None = Field(
        None, description="number of the duty of a load spectrum that is run, from 1"
    )


class OiledOperatingTable(OperatingTable):
    """Constant speed and load, and the oil's temperature."""

    oil_temperature: Temperature | None = Field(
        None, description="where the oil enters the mesh; for a lubricant given by its data sheet"
    )


class SpectrumScenario(ScenarioHead):
    """A scenario that may have a load spectrum."""

    duty: tuple[SpectrumDuty, ...] = Field(
        (), max_length=MOST_DUTIES, description="load spectrum: duties with shares of time"
    )


def spectrum_of(scenario: Any) -> list[tuple[float, Any]]:
    """Return share of time, their sum 1, and scenario of every duty; empty where there is no spectrum."""
    duties: Sequence[SpectrumDuty] = getattr(scenario, "duty", ())
    total = sum(one.share for one in duties)
    return [(one.share / total, _with(scenario, number)) for number, one in enumerate(duties, start=1)]


def in_force(scenario: Any) -> Any:
    """Return the scenario with the duty in force, the first where none is named; without a spectrum as is."""
    duties = getattr(scenario, "duty", ())
    if not duties:
        return scenario
    number = scenario.operating.duty
    found = _with(scenario, number or 1)
    kept = found.operating.model_copy(update={"duty": number})
    return found.model_copy(update={"operating": kept})


def broken_spectrum_rules(scenario: Any) -> Iterator[InputError]:
    """Go through what is wrong with the duties alone: two speeds or loads in one, a number without a duty."""
    duties: Sequence[SpectrumDuty] = getattr(scenario, "duty", ())
    number = getattr(getattr(scenario, "operating", None), "duty", None)
    if number is not None and number > len(duties):
        has = f"the load spectrum has {len(duties)}" if duties else "there is no load spectrum"
        yield InputError("operating.duty", number, has, "add [[duty]] tables, or name another")
    for place, one in enumerate(duties):
        for error in broken_duty_rules(one, f"duty.{place}"):
            if "missing" not in error.rule and "without a speed" not in error.rule:
                yield error


def unnamed_duty(scenario: Any) -> Iterator[InputError]:
    """Refuse a spectrum in a study that runs one duty at a time, where it is not said which."""
    count = len(scenario.duty)
    if count > 1 and scenario.operating.duty is None:
        yield InputError(
            "operating.duty",
            rule=f"missing: this kind of study runs one duty of the {count} at a time",
            remedy=f"add duty = 1, or sweep operating.duty over 1:{count}:1",
        )


def of_duty(error: InputError, number: int) -> InputError:
    """Name a duty as where a mistake stands that its scenario has in [operating]."""
    table, _, name = error.key.partition(".")
    known = {*SpectrumDuty.model_fields}
    key = f"duty.{number - 1}.{name}" if table == "operating" and name in known else error.key
    return InputError(key, error.value, error.rule, error.remedy, error.file)


def _with(scenario: Any, number: int) -> Any:
    """The scenario with the keys of one of its duties in [operating]; its duties say all of theirs."""
    duties = tuple(_completed(one, scenario.operating) for one in scenario.duty)
    keys = {name for name in _TAKEN if hasattr(scenario.operating, name)}
    update = {name: getattr(duties[number - 1], name) for name in keys} | {"duty": number}
    operating = scenario.operating.model_copy(update=update)
    return scenario.model_copy(update={"operating": operating, "duty": duties})


def _completed(duty: SpectrumDuty, operating: Any) -> SpectrumDuty:
    """A duty with what it does not give from [operating]."""
    missing: dict[str, Any] = {}
    for names in (SPEEDS, LOADS, ("oil_temperature",)):
        if all(getattr(duty, name) is None for name in names):
            missing |= {name: getattr(operating, name, None) for name in names}
    return duty.model_copy(update=missing)
