"""Liu & Ni, Mechanics & Industry 23 (2022) 10: the CRC drive and the involute it is compared with."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.rows import Row, compare, published

PAPER = "liu-ni-2022"
#: Runs by the names of their records: scenario and what is changed in it.
RUNS: dict[str, tuple[str, dict[str, str]]] = {
    **{
        name: (name, {})
        for name in ("crc-23-47", "involute-23-47", "crc-23-47-frictionless", "involute-23-47-frictionless")
    },
    **{
        f"{name}-dynamic": (name, {"friction.sliding": "dynamic"}) for name in ("crc-23-47", "involute-23-47")
    },
}
#: The choice of the last two runs, for rows that depend on it.
DEFAULT = "dynamic sliding, the default"

#: Samples per mesh cycle: at 10 rad/s the mesh vibrates 49 times per cycle, which 200 hardly resolve.
SAMPLES = 2000

#: Half-open window of phase about the pitch point in which friction is reversing, mesh cycles.
NEAR, FAR = 0.01, 0.05


class Steady(NamedTuple):
    """The last whole mesh cycle of a record, and its summary."""

    summary: dict[str, Any]
    data: dict[str, np.ndarray]
    phase: np.ndarray
    pitch_point: float
    contact_ratio: float

    @property
    def error(self) -> np.ndarray:
        """Rotational transmission error, m."""
        return self.data["transmission_error_rotational"]

    def single(self) -> np.ndarray:
        """Where one pair alone carries the load."""
        return np.sum(self.data["normal_load"] > 0.0, axis=1) == 1

    def aligned(self, name: str, pair: int, phase: np.ndarray) -> np.ndarray:
        """A pair's quantity at phases counted from its pitch point; NaN out of contact."""
        values = self.data[name][:, pair]
        from_pitch = self.phase - self.pitch_point + (1 - pair)
        inside = np.isfinite(values)
        result = np.interp(phase, from_pitch[inside], values[inside])
        outside = (phase < from_pitch[inside].min()) | (phase > from_pitch[inside].max())
        return np.where(outside, np.nan, result)


def _steady(path: Path) -> Steady:
    record = Record(path)
    names = (
        "normal_load",
        "central_film_thickness",
        "entrainment_speed",
        "friction_coefficient",
        "efficiency",
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


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper, from six runs whose records are left in `folder`."""
    steady = {}
    for count, (name, (scenario, changes)) in enumerate(RUNS.items()):
        case = load_scenario(scenario, {"output.samples_per_cycle": SAMPLES, **changes})
        result = run(case, folder / f"{name}.h5", force=True)
        if result.status != "complete":
            raise SimulationError(f"{name}: {result.message}")
        steady[name] = _steady(result.path)
        if progress:
            progress((count + 1) / len(RUNS))
    crc, involute, crc_dry, involute_dry, crc_dynamic, involute_dynamic = (steady[name] for name in RUNS)
    values = _numbers(crc, involute, crc_dry) | _claims(crc, involute, crc_dry, involute_dry)
    default = _numbers(crc_dynamic, involute_dynamic, crc_dry)
    default |= _claims(crc_dynamic, involute_dynamic, crc_dry, involute_dry)
    table = published(PAPER)
    return [
        compare(
            table[key],
            *values[key],
            otherwise=(DEFAULT, default[key][0]) if default[key] != values[key] else None,
        )
        for key in table
    ]


def _numbers(crc: Steady, involute: Steady, crc_dry: Steady) -> dict[str, tuple[Any, str]]:
    load = float(np.mean(np.sum(crc_dry.data["normal_load"], axis=1)[crc_dry.single()]))
    spectrum = crc_dry.summary["spectrum_amplitudes"], crc_dry.summary["spectrum_frequencies"]
    first = 1 + int(np.argmax(spectrum[0][1:]))
    weak = "bearings 1e9 N/m"
    return {
        "liu-ni/contact-ratio-crc": (crc.contact_ratio, ""),
        "liu-ni/contact-ratio-involute": (involute.contact_ratio, ""),
        "liu-ni/mesh-frequency": (float(spectrum[1][first]), "largest line of the DTE spectrum"),
        **{f"liu-ni/load-stcp-{model}": (load, "") for model in ("6dof", "mbd", "fem")},
        **{
            f"liu-ni/friction-pair{pair}-{name}": (float(found.summary["friction_force_mean"][pair]), weak)
            for name, found in (("crc", crc), ("involute", involute))
            for pair in (1, 0)
        },
        "liu-ni/efficiency-crc": (crc.summary["efficiency"], ""),
        "liu-ni/efficiency-involute": (involute.summary["efficiency"], weak),
    }


def _share(above: np.ndarray, *values: np.ndarray) -> float:
    valid = np.all([np.isfinite(v) for v in values], axis=0)
    return float(np.mean(above[valid]))


def _above(name: str, upper: Steady, lower: Steady) -> tuple[float, str]:
    """Minimum share, over both pairs, of the common phases at which `upper`'s quantity is the larger."""
    shares = []
    for pair in (1, 0):
        a, b = upper.data[name][:, pair], lower.data[name][:, pair]
        shares.append(_share(a > b, a, b))
    return min(shares), f"pair 1 at {shares[0]:.0%}, pair 0 at {shares[1]:.0%} of the common phases"


def _jump(wet: Steady, dry: Steady) -> tuple[float, float]:
    """What friction adds to the DTE across the pitch point, and at most elsewhere in single contact, m."""
    added = wet.error - dry.error

    def step(at: float) -> float:
        after = (wet.phase > at + NEAR) & (wet.phase < at + FAR)
        before = (wet.phase < at - NEAR) & (wet.phase > at - FAR)
        return float(np.mean(added[after]) - np.mean(added[before]))

    single = wet.phase[wet.single()]
    others = [
        abs(step(at))
        for at in single
        if single[0] + 4 * FAR < at < single[-1] - FAR and abs(at - wet.pitch_point) > 2 * FAR
    ]
    return step(wet.pitch_point), max(others, default=0.0)


def _claims(
    crc: Steady, involute: Steady, crc_dry: Steady, involute_dry: Steady
) -> dict[str, tuple[Any, str]]:
    share = float(np.mean(crc.error > involute.error))
    means = [float(np.mean(s.error)) * 1e6 for s in (crc, involute)]
    stiffness = [s.summary["stiffness_single_pair_at_pitch_point"] / 1e6 for s in (crc, involute)]
    ranges = [float(np.ptp(s.error)) * 1e6 for s in (crc, crc_dry, involute, involute_dry)]
    raised = [
        float(end(wet.error) - end(dry.error)) * 1e6
        for wet, dry in ((crc, crc_dry), (involute, involute_dry))
        for end in (np.max, np.min)
    ]
    forces = [float(np.sum(s.summary["friction_force_mean"])) for s in (crc, involute)]
    jumps = [_jump(crc, crc_dry), _jump(involute, involute_dry)]
    film, film_note = _above("central_film_thickness", crc, involute)
    speed, speed_note = _above("entrainment_speed", crc, involute)

    grid = np.linspace(-1.0, 1.0, 401)
    friction = []
    for pair in (1, 0):
        a, b = (s.aligned("friction_coefficient", pair, grid) for s in (crc, involute))
        friction.append(_share((a < b) | (np.abs(grid) < NEAR), a, b))

    efficiency = crc.data["efficiency"]
    peak = float(crc.phase[np.argmax(efficiency)])
    single = crc.single()
    both = [float(np.mean(efficiency[single])), float(np.mean(efficiency[~single]))]
    prefix = "liu-ni/claim-"
    return {
        f"{prefix}dte-of-the-crc-drive-above-the-involute-s-lower": (
            means[0] > means[1],
            f"rotational DTE, mean {means[0]:.1f} against {means[1]:.1f} µm, above at {share:.0%} of the "
            "phases; through the lower contact ratio: a single CRC pair is the "
            f"stiffer, {stiffness[0]:.0f} against {stiffness[1]:.0f} N/µm",
        ),
        f"{prefix}friction-widens-the-range-of-the-dte": (
            ranges[0] > ranges[1] and ranges[2] > ranges[3],
            f"peak to peak with/without: CRC {ranges[0]:.2f}/{ranges[1]:.2f} µm, "
            f"involute {ranges[2]:.2f}/{ranges[3]:.2f} µm; maximum and minimum move by "
            f"{raised[0]:+.2f}, {raised[1]:+.2f} and {raised[2]:+.2f}, {raised[3]:+.2f} µm",
        ),
        f"{prefix}a-jump-of-the-dte-at-the-pitch-point": (
            all(abs(at) > 2.0 * elsewhere for at, elsewhere in jumps),
            f"friction's step at P, CRC {jumps[0][0] * 1e6:+.2f} µm "
            f"(at most {jumps[0][1] * 1e6:.2f} elsewhere in single contact), "
            f"involute {jumps[1][0] * 1e6:+.2f} ({jumps[1][1] * 1e6:.2f})",
        ),
        f"{prefix}film-of-the-crc-drive-above-the-involute-s-at-ev": (film == 1.0, film_note),
        f"{prefix}entrainment-speed-of-the-crc-drive-above-the-inv": (speed == 1.0, speed_note),
        f"{prefix}friction-coefficient-of-the-crc-drive-below-the": (
            min(friction) == 1.0,
            f"pair 1 at {friction[0]:.0%}, pair 0 at {friction[1]:.0%} of the phases counted from P",
        ),
        f"{prefix}sliding-friction-force-of-the-crc-drive-smaller": (
            forces[0] < forces[1],
            f"sum of the mean forces {forces[0]:.0f} and {forces[1]:.0f} N",
        ),
        f"{prefix}efficiency-peaks-at-the-pitch-point-higher-in-si": (
            abs(peak - crc.pitch_point) < FAR and both[0] > both[1],
            f"peak at phase {peak:.3f}, P at {crc.pitch_point:.3f}; mean {both[0]:.4f} in single, "
            f"{both[1]:.4f} in double contact",
        ),
    }
