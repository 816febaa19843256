"""A scenario of every kind of study that is shipped, made short: its template, and what shortens it."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.support.once_per_session import OncePerSession
from tribodyn.cases.results import RunResult
from tribodyn.studies.protocol.load import filled, load_scenario
from tribodyn.studies.protocol.run import run

#: Kinds whose runs take long even when they are short.
FINITE_ELEMENTS = ("load-contact", "design", "assessment")
#: A law whose machine code many tests have, and a film law, so that none is chosen by a solved contact.
COULOMB: dict[str, Any] = {
    "friction.law": "coulomb",
    "friction.coefficient": 0.05,
    "film.law": "dowson-higginson",
}
#: Gears of all that finite elements are made of here, which are then solved once.
GEARS: dict[str, dict[str, Any]] = {
    "pinion": {"teeth": 18, "profile_shift": 0.0, "face_width": "26.7 mm", "bore_radius": "12 mm"},
    "gear": {"teeth": 36, "profile_shift": 0.0, "face_width": "26.7 mm", "bore_radius": "25 mm"},
}
PAIR: dict[str, Any] = {
    "drive.material": "18CrNiMo7-6",
    **{f"drive.{side}.{key}": value for side, keys in GEARS.items() for key, value in keys.items()},
}
TRAIN: dict[str, Any] = {
    "scenario.stage.1.module": "3 mm",
    "scenario.operating.output_torque": "400 N*m",
    **{
        f"scenario.gear.{part}-{stage}.{key.replace('radius', 'diameter')}": two
        if key == "bore_radius"
        else value
        for stage in (1, 2)
        for part, side, two in (("pinion", "pinion", "24 mm"), ("wheel", "gear", "50 mm"))
        for key, value in GEARS[side].items()
    },
}
#: Kind -> overrides under which its template takes seconds; that of another kind is taken as it stands.
SHORT: dict[str, dict[str, Any]] = {
    "gear-pair": {"solver.cycles": 4, "output.samples_per_cycle": 40},
    "gear-train": {"solver.cycles": 4, "output.samples_per_cycle": 40, **COULOMB},
    "efficiency": {"output.samples_per_cycle": 40},
    "load-contact": {**PAIR, "output.positions_per_cycle": 12, "mesh.slices": 7},
    "wear": {
        "output.positions_per_cycle": 16,
        "output.every": 4e7,
        "friction.law": "coulomb",
        "friction.coefficient": 0.05,
    },
    "ehl": {"output.positions": 4, "contact.step": 0.25},
    "irefc": {"output.samples_per_cycle": 8},
    "drive-cycle": {"cycle.step": "1 h", **{f"scenario.{key}": value for key, value in COULOMB.items()}},
    "backlash-oscillator": {"frequency.step": 0.2},
    "design": {
        "design.evaluations": 3,
        "design.sensitivities": False,
        "scenario.output.positions_per_cycle": 12,
    },
    "assessment": {
        **PAIR,
        "drive.centre_distance": "81 mm",
        "assessment.speeds": 8,
        "assessment.samples": 2,
        "assessment.friction_laws": ["niemann", "masjedi-khonsari"],  # steady states under a mean coefficient
    },
    "train-assessment": {
        **TRAIN,
        "scenario.solver.cycles": 4,
        "scenario.output.samples_per_cycle": 40,
        **{f"scenario.{key}": value for key, value in COULOMB.items()},
        "scenario.friction.sliding": "kinematic",  # by the explicit method at all speeds
        "assessment.speeds": 2,
        "assessment.samples": 2,
    },
    "map": {
        "map.torque": ["500 N*m", "1770 N*m"],
        "map.speed": ["0 rpm", "1480 rpm"],
        "map.oil_temperature": ["50 degC", "70 degC"],
        "map.accuracy": 0.3,
        "map.most_points": 40,
    },
}

#: Kind or name of a scenario -> KEY=VALUE under which a shipped one takes seconds.
SHORTER = {
    "gear-pair": ("solver.cycles=2",),
    "gear-train": ("solver.cycles=2",),
    "efficiency": ("output.samples_per_cycle=40",),
    "irefc": ("output.samples_per_cycle=8",),
    "drive-cycle": ("cycle.step=1 h",),
    "backlash-oscillator": ("frequency.step=0.1",),
    "sensors-18-36": ("solver.revolutions=3", "output.window=[2.0, 3.0]"),  # a signal has to be as long
    "start-from-rest": ("solver.duration=10 ms",),
    "load-contact": ("output.positions_per_cycle=8",),
    "wear": ("output.positions_per_cycle=12",),
    "ehl": ("output.positions=4", "contact.step=0.25"),
    "assessment": (
        *("assessment.speeds=8", "assessment.samples=0", "assessment.torque_shares=[0.5, 1.0]"),
        'assessment.friction_laws=["iso-14179-1"]',
    ),
    "train-assessment": ("scenario.solver.cycles=4", "assessment.speeds=0"),
    "map": ("map.accuracy=0.0", 'map.oil_temperature=["70 degC"]'),
}


def shorter(name: str, kind: str) -> tuple[str, ...]:
    """Overrides that make a shipped scenario, or a written one of a kind, short."""
    return SHORTER.get(name, SHORTER.get(kind, ()))


def shortened(kind: str) -> list[str]:
    """Options of a verb that make the template of a kind short."""
    given = SHORT.get(kind, {})
    written = {
        key: json.dumps(value) if isinstance(value, (list, bool)) else value for key, value in given.items()
    }
    return [word for key, value in written.items() for word in ("--set", f"{key}={value}")]


def written_template(kind: str, folder: Path) -> Path:
    """Write the template of a kind as `tribodyn init` does; return its path."""
    path = folder / f"{kind}.toml"
    path.write_text(filled(kind, f"A study of kind {kind}"), encoding="utf-8")
    return path


def short_case(kind: str, folder: Path, **more: Any) -> Any:
    """The case of a kind's template, made short; `more` are overrides with `__` in place of dots."""
    overrides = SHORT.get(kind, {}) | {key.replace("__", "."): value for key, value in more.items()}
    return load_scenario(written_template(kind, folder), overrides)


class ShortRuns(OncePerSession[RunResult]):
    """Short runs of the templates: (kind) -> result; nobody changes the record."""

    def __init__(self, tmp_path_factory: pytest.TempPathFactory) -> None:
        super().__init__(
            tmp_path_factory,
            "short-runs",
            lambda kind, folder: run(short_case(kind, folder), folder / f"{kind}.h5"),
        )
