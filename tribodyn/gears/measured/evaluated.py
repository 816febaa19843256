"""What a measurement says by ISO 1328-1: deviations by flank, and the classes that they keep."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.exchange.measured_gear import FLANKS, HELIX, PROFILE, MeasuredGear, NominalGear
from tribodyn.gears.measured.flank_evaluation import (
    FoundClasses,
    TraceDeviations,
    classes_reached,
    evaluation_range,
    pitch_deviations,
    trace_deviations,
)
from tribodyn.numerics.elementary import cos
from tribodyn.standards.flank_tolerances import outside

#: Name of the tolerance -> symbol and words.
SYMBOLS = {
    "profile_slope": "profile slope f_Hα",
    "profile_form": "profile form f_fα",
    "total_profile": "total profile F_α",
    "helix_slope": "helix slope f_Hβ",
    "helix_form": "helix form f_fβ",
    "total_helix": "total helix F_β",
    "single_pitch": "single pitch f_p",
    "total_pitch": "total pitch F_p",
    "runout": "runout F_r",
}
_NAMES = {
    PROFILE: ("profile_slope", "profile_form", "total_profile"),
    HELIX: ("helix_slope", "helix_form", "total_helix"),
}


class FlankDeviation(NamedTuple):
    """The largest deviation of a kind on the flanks of one side."""

    name: str  # of the tolerance
    flank: str  # "" of runout
    value: float  # m, with its sign
    teeth: dict[int, float]  # of each tooth that was measured; of pitch none


class Evaluation(NamedTuple):
    """All deviations, and what they amount to."""

    deviations: tuple[FlankDeviation, ...]
    classes: FoundClasses | None  # None: not enough is known of the gear
    edition: int
    limits: tuple[str, ...] = ()  # sizes for which the standard has no tolerances

    def lines(self) -> Iterator[str]:
        """As it is printed."""
        for name, words in SYMBOLS.items():
            found = [each for each in self.deviations if each.name == name]
            if not found:
                continue
            values = ", ".join(f"{each.flank} {1e6 * each.value:.1f} µm".strip() for each in found)
            grade = "" if self.classes is None else f", {_class(self.classes.each[name])}"
            yield f"{words}: {values}{grade}"
        if self.classes is not None:
            yield f"by ISO 1328-1:{self.edition}: {_class(self.classes.overall)}"
        for limit in self.limits:
            yield f"no class by ISO 1328-1:{self.edition}: {limit}"

    def as_dict(self) -> dict[str, object]:
        """For programs, in micrometres."""
        return {
            "deviations": [
                {
                    "name": each.name,
                    "flank": each.flank,
                    "value": 1e6 * each.value,
                    "teeth": {str(tooth): 1e6 * value for tooth, value in each.teeth.items()},
                }
                for each in self.deviations
            ],
            "classes": None if self.classes is None else dict(self.classes.each),
            "class": None if self.classes is None else self.classes.overall,
            "edition": self.edition,
        }


def _class(number: int | None) -> str:
    return "no class" if number is None else f"class {number}"


def evaluation_of(measured: MeasuredGear, nominal: NominalGear, edition: int = 2013) -> Evaluation:
    """Deviations of a measurement whose profiles are over length of roll; `nominal` is the gear."""
    found = [*_traces(measured, nominal, edition), *_rest(measured)]
    largest: dict[str, float] = {}
    for each in found:
        largest[each.name] = max(largest.get(each.name, 0.0), abs(each.value))
    classes, limits = None, ()
    if nominal.teeth is not None and nominal.module is not None and nominal.face_width is not None:
        diameter = nominal.teeth * nominal.module / float(cos(nominal.helix_angle or 0.0))
        sizes = nominal.module, diameter, nominal.face_width
        limits = tuple(outside(nominal.teeth, *sizes, edition))
        classes = None if limits else classes_reached(largest, *sizes, edition)
    return Evaluation(tuple(found), classes, edition, limits)


def _traces(measured: MeasuredGear, nominal: NominalGear, edition: int) -> Iterator[FlankDeviation]:
    for kind, names in _NAMES.items():
        for flank in FLANKS:
            each: dict[int, TraceDeviations] = {}
            for trace in measured.traces_of(kind, flank):
                begin, end = float(np.min(trace.place)), float(np.max(trace.place))
                if kind == HELIX and nominal.face_width is not None:
                    begin, end = max(begin, 0.0), min(end, nominal.face_width)
                low, high = trace.evaluated or evaluation_range(
                    begin, end, kind == HELIX, nominal.module or 0.0
                )
                reference = high - low
                if edition == 2013:
                    reference = end - low if kind == PROFILE else nominal.face_width or end - begin
                try:
                    one = trace_deviations(trace.place, trace.deviation, (low, high), reference)
                except ValueError as error:
                    key = f"{kind} of tooth {trace.tooth}, {flank} flank"
                    remedy = "give it a range within its points, and within the face"
                    raise InputError(key, None, str(error), remedy) from None
                worst = each.get(trace.tooth)
                if worst is None or one.total > worst.total:
                    each[trace.tooth] = one
            for position, name in enumerate(names):
                values = {tooth: one[position] for tooth, one in each.items()}
                if values:
                    yield FlankDeviation(name, flank, max(values.values(), key=abs), values)


def _rest(measured: MeasuredGear) -> Iterator[FlankDeviation]:
    for flank in FLANKS:
        if flank in measured.pitch:
            single, total = pitch_deviations(measured.pitch[flank])
            yield FlankDeviation("single_pitch", flank, single, {})
            yield FlankDeviation("total_pitch", flank, total, {})
    if measured.radial is not None:
        yield FlankDeviation("runout", "", float(np.ptp(measured.radial)), {})
