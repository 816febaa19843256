"""The steady mesh cycle of a record of Liu & Ni's drives, and how its quantities go from point to point."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.record.reader import Record

#: Half-open window of phase about the pitch point in which friction is reversing, mesh cycles.
NEAR, FAR = 0.01, 0.05
#: Share by which the friction coefficient changes along a path where it is constant.
_CONSTANT = 0.01


class Steady(NamedTuple):
    """The last whole mesh cycle of a record, and its summary."""

    summary: dict[str, Any]
    data: dict[str, np.ndarray]
    phase: np.ndarray
    pitch_point: float
    contact_ratio: float
    rotational: bool = False  # whether the transmission error is the rotational one

    @property
    def error(self) -> np.ndarray:
        """Transmission error, m: by Liu & Ni's (6) of pair 1, which is in contact all the cycle."""
        if self.rotational:
            return self.data["transmission_error_rotational"]
        return self.data["transmission_error_normal"][:, 1]

    def single(self) -> np.ndarray:
        """Where one pair alone carries the load."""
        return np.sum(self.data["normal_load"] > 0.0, axis=1) == 1

    def single_load(self) -> float:
        """Mean normal load of the pair that is alone, N."""
        return float(np.mean(np.sum(self.data["normal_load"], axis=1)[self.single()]))

    def aligned(self, name: str, pair: int, phase: np.ndarray) -> np.ndarray:
        """A pair's quantity at phases counted from its pitch point; NaN out of contact."""
        values = self.data[name][:, pair]
        from_pitch = self.phase - self.pitch_point + (1 - pair)
        inside = np.isfinite(values)
        result = np.interp(phase, from_pitch[inside], values[inside])
        outside = (phase < from_pitch[inside].min()) | (phase > from_pitch[inside].max())
        return np.where(outside, np.nan, result)


def steady_cycle(path: Path) -> Steady:
    """Return the last whole mesh cycle of a record."""
    record = Record(path)
    names = (
        "normal_load",
        "central_film_thickness",
        "entrainment_speed",
        "friction_coefficient",
        "friction_force",
        "efficiency",
        "transmission_error_normal",
        "transmission_error_rotational",
    )
    samples = record.scenario["output"]["samples_per_cycle"]
    data = {name: np.asarray(record[name])[-samples - 1 : -1] for name in names}
    cycle = record.mesh_cycle
    return Steady(
        record.summary,
        data,
        np.arange(samples) / samples,
        float(cycle["pitch_point_phase"]),
        float(cycle["contact_ratio"]),
    )


class PairCourse(NamedTuple):
    """Means of a quantity of pair 1 just after B_g, beside C_p and P on both sides, and before C_g."""

    start: float
    before: float
    after: float
    to_pitch: float
    from_pitch: float
    end: float


def course(cycle: Steady, values: np.ndarray) -> PairCourse:
    """Means over windows of `NEAR` to `FAR` beside the points of the cycle, which begins at B_g."""
    entry, pitch = float(cycle.phase[cycle.single()].min()), cycle.pitch_point
    places = ((0.0, 1), (entry, -1), (entry, 1), (pitch, -1), (pitch, 1), (1.0, -1))

    def mean(point: float, side: int) -> float:
        away = side * (cycle.phase - point)
        return float(np.nanmean(values[(away > NEAR) & (away < FAR)]))

    return PairCourse(*(mean(*place) for place in places))


def courses(wet: Sequence[Steady]) -> dict[str, tuple[bool, str]]:
    """Claims about the courses of film, friction and efficiency of (CRC drive, involute)."""
    films = [1e9 * s.data["central_film_thickness"] for s in wet]
    film, other = (course(s, h[:, 1]) for s, h in zip(wet, films, strict=True))
    old = films[0][:, 0][np.isfinite(films[0][:, 0])]
    single = wet[0].single()
    apart = [float(np.nanmean(films[0][part, 1])) for part in (~single, single)]
    friction = [course(s, np.abs(s.data["friction_coefficient"][:, 1])) for s in wet]
    changes = [abs(mu.end / mu.start - 1.0) for mu in friction]
    forces = [course(s, s.data["friction_force"][:, 1]) for s in wet]
    olds = [np.abs(s.data["friction_force"][:, 0]) for s in wet]
    fading = [force[np.isfinite(force) & (force > 0.0)] for force in olds]
    falls = [
        float(np.mean(force[: force.size // 4])) > float(np.mean(force[-force.size // 4 :]))
        for force in fading
    ]
    etas = [course(s, s.data["efficiency"]) for s in wet]
    prefix = "liu-ni/claim-"
    return {
        f"{prefix}film-of-the-crc-drive-thicker-in-double-contact": (
            apart[0] > apart[1],
            f"pair 1 {apart[0]:.0f} nm in double, {apart[1]:.0f} nm in single contact",
        ),
        f"{prefix}film-of-the-crc-drive-rises-beyond-cg-and-p": (
            float(old[-1]) > float(old[0]) and film.from_pitch > film.to_pitch,
            f"pair 0 from C_g to B_p {old[0]:.0f} to {old[-1]:.0f} nm; pair 1 {film.to_pitch:.1f} before and "
            f"{film.from_pitch:.1f} nm after P, where friction takes load off, {film.end:.1f} nm before C_g",
        ),
        f"{prefix}film-of-the-involute-has-another-trend": (
            other.start < other.end and film.start > film.end,
            f"pair 1 from B_g to C_g: involute {other.start:.0f} to {other.end:.0f} nm, "
            f"CRC {film.start:.0f} to {film.end:.0f} nm",
        ),
        f"{prefix}friction-coefficient-of-the-crc-drive-constant": (
            changes[0] < _CONSTANT < changes[1] and friction[1].end < friction[1].start,
            f"pair 1 from B_g to C_g: CRC {friction[0].start:.4f} to {friction[0].end:.4f}, involute "
            f"{friction[1].start:.4f} to {friction[1].end:.4f}",
        ),
        f"{prefix}friction-force-rises-jumps-and-reverses": (
            all(abs(f.start) < abs(f.before) < abs(f.after) for f in forces)
            and all(f.to_pitch * f.from_pitch < 0.0 for f in forces)
            and all(falls),
            "pair 1 after B_g, before and after C_p, before and after P, N: "
            + "; ".join(
                f"{name} {f.start:.0f}, {f.before:.0f}, {f.after:.0f}, {f.to_pitch:.0f}, {f.from_pitch:+.0f}"
                for name, f in zip(("CRC", "involute"), forces, strict=True)
            )
            + "; pair 0 falls",
        ),
        f"{prefix}efficiency-falls-rises-and-falls": (
            all(e.before < e.start and e.after < e.to_pitch and e.end < e.from_pitch for e in etas),
            "; ".join(
                f"{name} {e.start:.4f}, {e.before:.4f} in double contact, {e.after:.4f}, {e.to_pitch:.4f} "
                f"to P, {e.from_pitch:.4f}, {e.end:.4f} from it"
                for name, e in zip(("CRC", "involute"), etas, strict=True)
            ),
        ),
    }
