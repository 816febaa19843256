"""A measured gear as keys of a scenario: errors of single teeth, pitch errors, eccentricity.

Zero of a trace is where it crosses the measuring circle in mid-face: where a tooth stands, its pitch says.
Teeth without a trace get the mean of those that have one.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.exchange.measured_gear import HELIX, PROFILE, FlankTrace, MeasuredGear
from tribodyn.gears.measured.flank_evaluation import eccentricity_of
from tribodyn.gears.measured.mounted_gear import MountedGear, other_flank
from tribodyn.mesh.teeth.deviations import RunOut
from tribodyn.numerics.shapes import Array, Float

#: Points of a table of errors at most, and along height and face where traces have points of their own each.
MOST_POINTS, EVEN_POINTS, MOST_KEPT = 60_000, 65, 129
#: Below this nothing is written, m.
NOTHING = 1e-12


class ToothErrors(NamedTuple):
    """A table of errors, complete over all three."""

    height: Float[Array, " height"]
    face: Float[Array, " face"]  # m from mid-face
    errors: Float[Array, "tooth height face"]  # m along the normal, positive where material is missing

    def columns(self) -> dict[str, Any]:
        """As the scenario would write it out."""
        tooth, height, face = np.meshgrid(
            np.arange(1.0, len(self.errors) + 1.0), self.height, self.face, indexing="ij"
        )
        columns = {
            "tooth": ("1", tooth),
            "height": ("1", height),
            "face": ("mm", 1e3 * face),
            "error": ("um", 1e6 * self.errors),
        }
        return {
            name: {"unit": unit, "values": [float(f"{value:.12g}") for value in values.ravel()]}
            for name, (unit, values) in columns.items()
        }


class FlankKeys(NamedTuple):
    """What a scenario says of a measured gear."""

    tooth_errors: ToothErrors | None = None
    tooth_errors_back: ToothErrors | None = None
    pitch_errors: tuple[float, ...] = ()  # m along the normal
    eccentricity: float = 0.0  # m
    eccentricity_angle: float = 0.0  # rad
    remarks: tuple[str, ...] = ()


def keys_of(measured: MeasuredGear, gear: MountedGear, datum: str, file: str) -> FlankKeys:
    """Keys of a gear; InputError where the measurement is of another gear, or contradicts itself."""
    gear.refuse_other(measured.nominal, file)
    if gear.nominal.internal:
        rule = "is internal, and measured rings are not read"
        raise InputError(gear.key, gear.name, rule, "name an external gear", file)
    _check_teeth(measured, gear, file)
    run_out = RunOut(gear.teeth) if measured.radial is None else _run_out(measured.radial, gear, datum)
    converting = _Converting(measured, gear, datum, run_out, file)
    first, second = gear.carrying[0], other_flank(gear.carrying[0])
    index = {flank: converting.index(flank) for flank in (first, second)}
    shape = {flank: converting.shape(flank) for flank in (first, second)}
    placed, opposite = index[first], index[second]
    if placed is None and opposite is not None:
        placed, opposite = -opposite, None
    back = shape[second]
    if opposite is not None and placed is not None:
        # a tooth that is behind on one flank is ahead on the other; what is left is its thickness
        thinner = opposite + placed
        if back is None and _there(thinner):
            back = ToothErrors(np.array([0.5]), np.array([0.0]), np.zeros((gear.teeth, 1, 1)))
        back = back and back._replace(errors=back.errors + thinner[:, None, None])
    return FlankKeys(
        _worth_writing(shape[first]),
        _worth_writing(back),
        () if placed is None or not _there(placed) else tuple(float(each) for each in placed),
        run_out.eccentricity,
        run_out.eccentricity_angle,
        tuple(converting.remarks),
    )


def _there(values: Float[Array, "..."]) -> bool:
    return bool(np.max(np.abs(values)) > NOTHING)


def _worth_writing(table: ToothErrors | None) -> ToothErrors | None:
    return table if table is not None and _there(table.errors) else None


def _run_out(radial: Float[Array, " gap"], gear: MountedGear, datum: str) -> RunOut:
    """The eccentricity in readings of all gaps; gap i is half a pitch clockwise of tooth i."""
    size, angle = eccentricity_of(radial)
    if size < NOTHING:
        return RunOut(gear.teeth)
    clockwise = angle + math.pi / gear.teeth
    return RunOut(gear.teeth, size, (clockwise if gear.clockwise(datum) else -clockwise) % math.tau)


def _check_teeth(measured: MeasuredGear, gear: MountedGear, file: str) -> None:
    counts = {f"pitch deviations of the {flank} flanks": index for flank, index in measured.pitch.items()}
    if measured.radial is not None:
        counts["readings of runout"] = measured.radial
    for what, values in counts.items():
        if len(values) != gear.teeth:
            rule = f"{len(values)} {what}, and the gear has {gear.teeth} teeth"
            raise InputError(gear.key, None, rule, "measure every tooth", file)
    for trace in measured.traces:
        if not 1 <= trace.tooth <= gear.teeth:
            rule = f"{trace.kind} of tooth {trace.tooth}, and the gear has teeth 1 to {gear.teeth}"
            raise InputError(gear.key, None, rule, "number the teeth from 1, clockwise", file)


@dataclass
class _Converting:
    """A measurement on its way into a scenario."""

    measured: MeasuredGear
    gear: MountedGear
    datum: str
    run_out: RunOut
    file: str

    def __post_init__(self) -> None:
        self.remarks: list[str] = []

    def index(self, flank: int) -> Float[Array, " tooth"] | None:
        """What every tooth's flank lacks by its pitch, without the eccentricity; None: not measured."""
        found = self.measured.pitch.get(self.gear.side(flank, self.datum))
        if found is None:
            return None
        diameter = self.measured.diameter
        circle = self.gear.reference_radius if diameter is None else diameter / 2.0
        lacking = np.empty(self.gear.teeth)
        for number, value in enumerate(found, start=1):
            lacking[self.gear.tooth(number, self.datum)] = value
        lacking *= self.gear.behind(flank, self.datum) * self.gear.base_radius / circle
        height = np.array([self.gear.measuring_height(flank, diameter)])
        eccentric = [self._eccentric(tooth, flank, height, np.zeros(1)) for tooth in range(self.gear.teeth)]
        return lacking - np.array(eccentric).ravel()

    def _eccentric(
        self, tooth: int, flank: int, height: Float[Array, " height"], face: Float[Array, " face"]
    ) -> Float[Array, "height face"]:
        """What the eccentricity takes off a flank."""
        if not self.run_out.eccentricity:
            return np.zeros((len(height), len(face)))
        places = self.gear.flanks[flank].places(height, face)
        fields = self.run_out.fields(tooth, flank, places)
        assert fields is not None
        return fields.gap.T

    def shape(self, flank: int) -> ToothErrors | None:
        """Errors of all teeth's flank by its profiles and helices; None: none was measured."""
        side = self.gear.side(flank, self.datum)
        traces = [
            trace.over_roll_length(self.gear.base_radius)
            for trace in self.measured.traces
            if trace.flank == side
        ]
        if not traces:
            return None
        heights = self._heights([trace for trace in traces if trace.kind == PROFILE], flank, side)
        faces = self._faces([trace for trace in traces if trace.kind == HELIX], traces)
        heights, faces = _fewer(heights, faces, self.gear.teeth)
        errors = np.full((self.gear.teeth, len(heights), len(faces)), np.nan)
        for number in {trace.tooth for trace in traces}:
            own = [trace for trace in traces if trace.tooth == number]
            if len({(trace.kind, trace.at) for trace in own}) < len(own):
                rule = f"tooth {number}, {side} flank, was measured twice at the same place"
                raise InputError(self.gear.key, None, rule, "leave one of both out", self.file)
            tooth = self.gear.tooth(number, self.datum)
            errors[tooth] = self._errors(own, flank, heights, faces) - self._moved(
                tooth, flank, heights, faces
            )
        unknown = np.isnan(errors[:, 0, 0])
        if np.any(unknown):
            errors[unknown] = np.mean(errors[~unknown], axis=0)
            count = int(np.sum(~unknown))
            self.remarks.append(
                f"{side} flanks: traces of {count} of {len(unknown)} teeth; the others get their mean"
            )
        return ToothErrors(heights, faces, errors)

    def _moved(
        self, tooth: int, flank: int, heights: Float[Array, " height"], faces: Float[Array, " face"]
    ) -> Float[Array, "height face"]:
        """What the eccentricity has in traces, which are zero on the measuring circle in mid-face."""
        circle = np.array([self.gear.measuring_height(flank, self.measured.diameter)])
        return self._eccentric(tooth, flank, heights, faces) - self._eccentric(
            tooth, flank, circle, np.zeros(1)
        )

    def _height(self, length: Any, flank: int) -> Any:
        low, high = self.gear.flanks[flank].roll_lengths(self.gear.base_radius)
        return (length - low) / (high - low)

    def _heights(self, profiles: Sequence[FlankTrace], flank: int, side: str) -> Float[Array, " height"]:
        """Heights at which errors are written: those of the points where all traces have the same."""
        if not profiles:
            return np.array([0.5])
        places = [np.sort(self._height(trace.place, flank)) for trace in profiles]
        for trace, place in zip(profiles, places, strict=True):
            if place[-1] <= 0.0 or place[0] >= 1.0:
                low, high = self.gear.flanks[flank].roll_lengths(self.gear.base_radius)
                rule = (
                    f"the profile of tooth {trace.tooth}, {side} flank, at roll lengths "
                    f"{1e3 * trace.place.min():.4g} to {1e3 * trace.place.max():.4g} mm is beyond contact, "
                    f"{1e3 * min(low, high):.4g} to {1e3 * max(low, high):.4g} mm"
                )
                raise InputError(self.gear.key, None, rule, "check the units", self.file)
        short = min(min(place[-1], 1.0) - max(place[0], 0.0) for place in places)
        if short < 0.9:
            self.remarks.append(
                f"{side} flanks: a profile covers {100 * short:.0f} % of the path of contact; beyond it, it "
                "is as at its ends"
            )
        if _alike(places):
            return np.unique(np.round([0.0, 1.0, *np.clip(places[0], 0.0, 1.0)], 12))
        return np.linspace(0.0, 1.0, EVEN_POINTS)

    def _faces(self, helices: Sequence[FlankTrace], traces: Sequence[FlankTrace]) -> Float[Array, " face"]:
        """Places along the face, from its middle, at which errors are written."""
        width = self.gear.face_width
        if not helices:
            at = {trace.at for trace in traces if trace.at is not None}
            if len({trace.at for trace in traces}) < 2:
                return np.zeros(1)
            places = np.sort(self.gear.along(np.array(sorted(at | {width / 2.0})), self.datum))
            return np.unique(np.round(np.clip(places, -width / 2.0, width / 2.0), 12))
        places = [np.sort(self.gear.along(trace.place, self.datum)) for trace in helices]
        for trace, place in zip(helices, places, strict=True):
            if place[-1] <= -width / 2.0 or place[0] >= width / 2.0:
                rule = (
                    f"the helix of tooth {trace.tooth}, {trace.flank} flank, begins at "
                    f"{1e3 * trace.place.min():.4g} mm, beside a face of {1e3 * width:.4g} mm"
                )
                raise InputError(self.gear.key, None, rule, "check the units", self.file)
        if _alike(places):
            return np.unique(np.round(np.clip(places[0], -width / 2.0, width / 2.0), 12))
        return np.linspace(-width / 2.0, width / 2.0, EVEN_POINTS)

    def _errors(
        self,
        traces: Sequence[FlankTrace],
        flank: int,
        heights: Float[Array, " height"],
        faces: Float[Array, " face"],
    ) -> Float[Array, "height face"]:
        """Errors of a tooth's flank by its traces, zero on the measuring circle in mid-face.

        One profile and one helix add up. Several profiles are interpolated along the face; where there is a
        helix they are moved to it where they cross it.
        """
        circle = self.gear.measuring_height(flank, self.measured.diameter)
        profiles = [trace for trace in traces if trace.kind == PROFILE]
        helices = [trace for trace in traces if trace.kind == HELIX]
        lead, crossing = None, circle
        if helices:
            at = [self._crossing(trace, flank) for trace in helices]
            best = int(np.argmin(np.abs(np.array(at) - circle)))
            lead, crossing = helices[best], at[best]
            if len(helices) > 1:
                self.remarks.append(
                    f"tooth {lead.tooth}, {lead.flank} flank: one helix of {len(helices)} used"
                )

        def along_face(z: Float[Array, " face"]) -> Float[Array, " face"]:
            if lead is None:
                return np.zeros(len(z))
            return _interpolated(z, self.gear.along(lead.place, self.datum), lead.deviation)

        def along_profile(
            h: Float[Array, " height"], z: Float[Array, " face"]
        ) -> Float[Array, "height face"]:
            if not profiles:
                return np.zeros((len(h), len(z)))
            at = np.array([self._along(trace) for trace in profiles])
            rows = np.array(
                [
                    _interpolated(h, self._height(trace.place, flank), trace.deviation)
                    - (self._at(trace, crossing, flank) if lead is not None else 0.0)
                    for trace in profiles
                ]
            )
            order = np.argsort(at)
            return np.array([np.interp(z, at[order], column) for column in rows[order].T])

        middle = np.zeros(1)
        found = along_profile(heights, faces) + along_face(faces)
        zero = along_profile(np.array([circle]), middle) + along_face(middle)
        return -self.gear.lean * (found - zero)

    def _at(self, trace: FlankTrace, height: float, flank: int) -> float:
        return float(_interpolated(np.array([height]), self._height(trace.place, flank), trace.deviation)[0])

    def _along(self, trace: FlankTrace) -> float:
        """Where a profile was taken, from mid-face."""
        return 0.0 if trace.at is None else float(self.gear.along(np.array(trace.at), self.datum))

    def _crossing(self, helix: FlankTrace, flank: int) -> float:
        """Height at which a helix was taken."""
        diameter = self.measured.diameter if helix.at is None else helix.at
        return self.gear.measuring_height(flank, diameter)


def _alike(places: Sequence[Float[Array, " point"]]) -> bool:
    """Whether all traces have the same points, few enough to be kept."""
    same = all(len(each) == len(places[0]) and np.allclose(each, places[0], atol=1e-9) for each in places)
    return same and len(places[0]) <= MOST_KEPT


def _interpolated(
    at: Float[Array, " any"], place: Float[Array, " point"], value: Float[Array, " point"]
) -> Float[Array, " any"]:
    order = np.argsort(place)
    return np.interp(at, place[order], value[order])


def _fewer(
    heights: Float[Array, " height"], faces: Float[Array, " face"], teeth: int
) -> tuple[Float[Array, " height"], Float[Array, " face"]]:
    """Even points in the place of so many that a table would be too long."""
    while len(heights) * len(faces) * teeth > MOST_POINTS:
        if len(heights) >= len(faces):
            heights = np.linspace(heights[0], heights[-1], len(heights) // 2 + 1)
        else:
            faces = np.linspace(faces[0], faces[-1], len(faces) // 2 + 1)
    return heights, faces
