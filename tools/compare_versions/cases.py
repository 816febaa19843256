"""What both versions run: every shipped scenario, what scenarios leave out, and every paper's comparison."""

from pathlib import Path
from typing import NamedTuple

PAPERS = ("liu-ni-2022", "efremenkov-2024", "veciana-2024", "diez-ibarbia", "jia-2022")
OIL = "lubricant=75w90-diez-ibarbia"


class Case(NamedTuple):
    """Commands of `tribodyn`, run one after the other in one folder; the last one prints JSON."""

    name: str
    commands: tuple[tuple[str, ...], ...]


def _single(name: str, *words: str) -> Case:
    return Case(name, (words,))


def _run(name: str, scenario: str, *settings: str) -> Case:
    """A run of a shipped scenario with some of its keys changed."""
    chosen = [word for setting in settings for word in ("--set", setting)]
    return _single(name, "run", scenario, *chosen, "--no-plot", "--json")


def _short(name: str, scenario: str, *settings: str) -> Case:
    """A short run of a gear pair."""
    return _run(name, scenario, *settings, "solver.cycles=3")


def _gear_pairs() -> list[Case]:
    """Laws, compliances, sources and solvers that no shipped scenario uses."""
    oil = ("xu", "benedict-kelley", "niemann", "iso-14179-1")
    mixed = ("mean-pressure", "as-printed", "veciana", "veciana-peak")
    methods = ("rodas4", "tsit5", "radau", "dopri8", "kvaerno5")
    crc = "crc-23-47-300"
    return [
        *(_short(f"law {law}", "involute-23-47", f"friction.law={law}", OIL) for law in oil),
        *(_short(f"law mixed, {law}", crc, f"friction.law=masjedi-khonsari-{law}") for law in mixed),
        _short("law coulomb", crc, "friction.law=coulomb", "friction.coefficient=0.05"),
        _short("sliding dynamic", crc, "friction.sliding=dynamic"),
        _short("source torque", crc, "operating.source=torque", "operating.drive_inertia=0.02 kg*m**2"),
        _short("backlash", crc, "mesh.backlash=0.05 mm", "operating.gear_torque=20 N*m"),
        _short("energy-consistent", crc, "mesh.formulation=energy-consistent"),
        _short("hertz load-dependent", crc, "mesh.hertz=load-dependent"),
        _short("foundations apart", crc, "mesh.foundation_coupling=false"),
        _short("compliance constant", crc, "mesh.compliance=constant", "mesh.stiffness=2.8e8 N/m"),
        _short("compliance fem", crc, "mesh.compliance=fem"),
        _short("compliance fem, misaligned", "involute-18-36-fem", "mesh.misalignment.in_plane=1 arcmin"),
        _short("unloaded start", "involute-23-47", "solver.initial=unloaded"),
        *(_short(f"method {method}", crc, f"solver.method={method}") for method in methods),
        _short("high contact ratio, backlash", "high-contact-ratio", "mesh.backlash=0.05 mm"),
    ]


def _other_studies() -> list[Case]:
    efficiency, few = "efficiency-involute-18-36", "output.positions_per_cycle=24"
    return [
        _run("efficiency, law xu", efficiency, "friction.law=xu"),
        _run("efficiency, loads of finite elements", efficiency, "mesh.compliance=fem"),
        _run("load contact, 21 slices", "load-contact-18-36", "mesh.slices=21", few),
        _run("rolling, loads of one element", "irefc", "operating.input_power=300 W"),
        _run("oscillator, stiffness varies", "backlash-oscillator", "stiffness_variation=0.2"),
    ]


def _sweeps() -> list[Case]:
    def sweep(name: str, words: str) -> Case:
        return _single(name, "sweep", *words.split(), "-o", "sweep.h5", "--json")

    speeds = "--vary operating.pinion_speed=2000,4000rpm"
    up_and_down = "--vary operating.pinion_speed=400:480:20rad/s --direction both"
    return [
        sweep("sweep steady", f"crc-23-47 {speeds} --vary friction.law=none,masjedi-khonsari"),
        sweep("sweep both ways", f"jump-involute-23-47 {up_and_down}"),
        sweep("sweep geometry", "involute-23-47 --vary drive.pinion.profile_shift=0,0.2 --transient 4"),
        sweep("sweep rattle", "rattle --vary operating.gear_torque=5,20N*m --transient 4"),
        sweep("sweep jax", f"crc-23-47 {speeds} --transient 2 --engine jax"),
    ]


def _printed() -> list[Case]:
    """Verbs that write no record."""
    check = ("crc-23-47", "involute-18-36-fem", "efficiency-crc-23-47", "load-contact-18-36", "irefc")
    gear = ("liu-ni-crc-23-47", "diez-ibarbia-18-36", "s-gear-23-47", "jia-parabolic-17-29")
    short = ("--set", "solver.cycles=2", "--no-plot", "-o")
    runs = ("run", "crc-23-47", *short, "a.h5"), ("run", "involute-23-47", *short, "b.h5")
    return [
        *(_single(f"check {name}", "check", name, "--json") for name in (*check, "backlash-oscillator")),
        *(_single(f"gear {name}", "gear", name, "--json") for name in gear),
        Case("compare", (*runs, ("compare", "a.h5", "b.h5", "--json"))),
        *(_single(f"validate {paper}", "validate", paper, "-o", ".", "--json") for paper in PAPERS),
    ]


def cases(version: Path) -> list[Case]:
    """Return what is run of the version in a folder: its shipped scenarios, then the cases of this file."""
    shipped = sorted(path.stem for path in (version / "scenarios").glob("*.toml"))
    return [
        *(_single(f"run {name}", "run", name, "--no-plot", "--json") for name in shipped),
        *_gear_pairs(),
        *_other_studies(),
        *_sweeps(),
        *_printed(),
    ]
