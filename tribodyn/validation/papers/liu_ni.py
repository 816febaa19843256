"""Liu & Ni, Mechanics & Industry 23 (2022) 10: the CRC drive and the involute it is compared with."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.validation.papers import run_all
from tribodyn.validation.papers.liu_ni_courses import FAR, NEAR, Steady, courses, steady_cycle
from tribodyn.validation.rows import Row, compare_paper

PAPER = "liu-ni-2022"
DRIVES = "crc-23-47", "involute-23-47"
#: Samples per mesh cycle: at 10 rad/s the mesh vibrates 49 times per cycle, which 200 hardly resolve.
SAMPLES = 2000
#: Runs by the names of their records: scenario and what is changed in it.
RUNS: dict[str, tuple[str, dict[str, Any]]] = {
    f"{drive}{end}": (drive + scenario, {"output.samples_per_cycle": SAMPLES, **changes})
    for end, scenario, changes in (
        ("", "", {}),
        ("-frictionless", "-frictionless", {}),
        ("-dynamic", "", {"friction.sliding": "dynamic"}),
        ("-mean-pressure", "", {"friction.law": "masjedi-khonsari-mean-pressure"}),
        ("-fem", "", {"mesh.compliance": "fem"}),
        ("-fem-frictionless", "-frictionless", {"mesh.compliance": "fem"}),
        ("-apart", "", {"mesh.foundation_coupling": False}),
    )
    for drive in DRIVES
}
#: Other choices of the rows that depend on them, by the ends of the names of their runs.
CHOICES = {
    "-dynamic": "dynamic sliding, the default",
    "-mean-pressure": "limiting shear stress by the whole mean pressure",
}
#: Choices of the claim about the two transmission errors: Liu & Ni's (6) is along the normal.
ROTATIONAL, APART = "DTE as r_p θ_p - r_g θ_g", "pairs that do not share the gear bodies"
#: Share of the largest line above which a line of the spectrum is one, and by which equal loads may differ.
_LINE, _EQUAL = 1e-6, 0.005
_ABOVE = "liu-ni/claim-dte-of-the-crc-drive-above-the-involute-s-lower"


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """All rows of the paper, from fourteen runs whose records are left in `folder`."""
    steady = {name: steady_cycle(path) for name, path in run_all(RUNS, folder, progress)}
    wet, dry, elements, apart, *others = (
        [steady[f"{drive}{end}"] for drive in DRIVES]
        for end in ("", "-frictionless", "-fem", "-apart", *CHOICES)
    )
    values = _numbers(wet, dry) | _claims(wet, dry)
    values |= courses(wet) | _by_elements(dry[0], steady["crc-23-47-fem-frictionless"])
    for name, pair in (("teeth by finite elements", elements), (APART, apart)):
        means = [1e6 * s.summary["transmission_error_normal_mean"] for s in pair]
        values[_ABOVE] = values[_ABOVE][0], f"{values[_ABOVE][1]}; {name} {means[0]:.2f}, {means[1]:.2f} µm"
    alternatives = {
        choice: _numbers(pair, dry) | _claims(pair, dry) | courses(pair)
        for choice, pair in zip(CHOICES.values(), others, strict=True)
    }
    alternatives[ROTATIONAL] = _errors(*([s._replace(rotational=True) for s in pair] for pair in (wet, dry)))
    alternatives[APART] = {_ABOVE: _errors(apart, dry)[_ABOVE]}
    return compare_paper(
        PAPER,
        values,
        {choice: {key: value for key, (value, _) in alternatives[choice].items()} for choice in alternatives},
    )


def _numbers(wet: Sequence[Steady], dry: Sequence[Steady]) -> dict[str, tuple[Any, str]]:
    crc, involute = wet
    crc_dry = dry[0]
    spectrum = crc_dry.summary["spectrum_amplitudes"], crc_dry.summary["spectrum_frequencies"]
    lines = np.flatnonzero(spectrum[0][1:] > _LINE * np.max(spectrum[0][1:])) + 1
    harmonics = [float(spectrum[1][line]) for line in lines[:3]]
    weak = "bearings 1e9 N/m"
    return {
        "liu-ni/contact-ratio-crc": (crc.contact_ratio, ""),
        "liu-ni/contact-ratio-involute": (involute.contact_ratio, ""),
        "liu-ni/mesh-frequency": (harmonics[0], "first line of the DTE spectrum"),
        "liu-ni/mesh-harmonics": (harmonics[1:], "second and third line"),
        "liu-ni/load-stcp-6dof": (crc_dry.single_load(), ""),
        "liu-ni/load-stcp-mbd": (None, ""),
        **{
            f"liu-ni/friction-pair{pair}-{name}": (float(run.summary["friction_force_mean"][pair]), weak)
            for name, run in (("crc", crc), ("involute", involute))
            for pair in (1, 0)
        },
        "liu-ni/efficiency-crc": (crc.summary["efficiency"], ""),
        "liu-ni/efficiency-involute": (involute.summary["efficiency"], weak),
    }


def _by_elements(rigid: Steady, elements: Steady) -> dict[str, tuple[Any, str]]:
    """Load and contact ratio of the CRC drive without friction with teeth by finite elements."""
    loads = [s.single_load() for s in (rigid, elements)]
    pairs = float(np.mean(np.sum(elements.data["normal_load"] > 0.0, axis=1)))
    return {
        "liu-ni/load-stcp-fem": (loads[1], ""),
        "liu-ni/claim-load-above-the-fe-s": (
            loads[0] > (1.0 + _EQUAL) * loads[1],
            f"{loads[0]:.0f} and {loads[1]:.0f} N",
        ),
        "liu-ni/claim-contact-ratio-below-the-fe-s": (
            rigid.contact_ratio < pairs,
            f"{rigid.contact_ratio:.4f} along the path, {pairs:.4f} loaded pairs in the mean with teeth by "
            "finite elements, which also touch before and after it",
        ),
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


def _errors(wet: Sequence[Steady], dry: Sequence[Steady]) -> dict[str, tuple[bool, str]]:
    """Claims about the transmission error, of (CRC drive, involute) with friction and without."""
    crc, involute = wet
    share = float(np.mean(crc.error > involute.error))
    means = [float(np.mean(s.error)) * 1e6 for s in wet]
    stiffness = [s.summary["stiffness_single_pair_at_pitch_point"] / 1e6 for s in wet]
    ends = [
        [float(end(s.error)) * 1e6 for s in (still, moved)]
        for moved, still in zip(wet, dry, strict=True)
        for end in (np.max, np.min)
    ]
    jumps = [_jump(moved, still) for moved, still in zip(wet, dry, strict=True)]
    which = "rotational" if crc.rotational else "eq. (6), pair 1"
    prefix = "liu-ni/claim-"
    return {
        _ABOVE: (
            means[0] > means[1],
            f"{which}: mean {means[0]:.2f} against {means[1]:.2f} µm, above at {share:.0%} of the phases; a "
            f"single CRC pair is the stiffer, {stiffness[0]:.0f} against {stiffness[1]:.0f} N/µm",
        ),
        f"{prefix}friction-raises-maximum-and-minimum-of-the-dte": (
            all(moved > still for still, moved in ends),
            f"{which}, without -> with friction, µm: "
            + ", ".join(
                f"{end} {still:.2f} -> {moved:.2f}"
                for end, (still, moved) in zip(
                    ("CRC maximum", "minimum", "involute maximum", "minimum"), ends, strict=True
                )
            ),
        ),
        f"{prefix}a-jump-of-the-dte-at-the-pitch-point": (
            all(abs(at) > 2.0 * elsewhere for at, elsewhere in jumps),
            f"{which}, friction's step at P: CRC {jumps[0][0] * 1e6:+.2f} µm "
            f"(at most {jumps[0][1] * 1e6:.2f} elsewhere in single contact), "
            f"involute {jumps[1][0] * 1e6:+.2f} ({jumps[1][1] * 1e6:.2f})",
        ),
    }


def _claims(wet: Sequence[Steady], dry: Sequence[Steady]) -> dict[str, tuple[Any, str]]:
    crc, involute = wet
    forces = [float(np.sum(s.summary["friction_force_mean"])) for s in (crc, involute)]
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
    higher = float(np.mean(efficiency > involute.data["efficiency"]))
    means = [float(np.mean(s.data["efficiency"])) for s in wet]
    prefix = "liu-ni/claim-"
    return {
        **_errors(wet, dry),
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
        f"{prefix}efficiency-of-the-crc-drive-higher": (
            means[0] > means[1],
            f"mean {means[0]:.4f} against {means[1]:.4f}, higher at {higher:.0%} of the phases",
        ),
        f"{prefix}efficiency-peaks-at-the-pitch-point-higher-in-si": (
            abs(peak - crc.pitch_point) < FAR and both[0] > both[1],
            f"peak at phase {peak:.3f}, P at {crc.pitch_point:.3f}; mean {both[0]:.4f} in single, "
            f"{both[1]:.4f} in double contact",
        ),
    }
