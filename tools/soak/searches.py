"""Random searches through random scenarios of the other studies."""

from typing import Any

from tools.soak import duties, studies
from tools.soak.draw import Draw, quantity
from tools.soak.drives import size_of

#: Kinds of the scenarios that are searched, their share, and figures of their summaries to seek.
SEARCHED = {
    "efficiency": (4, ("loss", "contact_ratio", "hertz_pressure_max")),
    "load-contact": (3, ("peak_to_peak", "hertz_pressure_max", "face_load_factor")),
    "gear-pair": (2, ("loss", "dynamic_factor", "hertz_pressure_max")),
}
#: For one objective and for two; those of packages that need not be installed are left out.
METHODS = ("auto", "cobyqa", "slsqp", "differential-evolution")
FRONTS = ("auto", "epsilon-constraint")


def search(draw: Draw, drive: dict[str, Any]) -> dict[str, Any]:
    """Return the scenario of a search of a few evaluations."""
    kind = draw.choice(tuple(SEARCHED), [share for share, _ in SEARCHED.values()])
    figures = SEARCHED[kind][1]
    two = draw.chance(0.25)
    design: dict[str, Any] = {
        "free": _free(draw, kind, drive),
        "minimise": list(figures[:2]) if two else draw.choice(figures),
        "method": draw.choice(FRONTS if two else METHODS),
        "evaluations": draw.whole(2, 8),
        "starts": 1,
        "sensitivities": draw.chance(0.2),
    }
    if draw.chance(0.6):
        design["subject_to"] = [draw.choice(("contact_ratio >= 1.1", "hertz_pressure_max <= start"))]
    scenario = _searched(draw, kind, drive)
    if draw.chance(0.2):
        load = float(scenario["operating"]["gear_torque"].split()[0])
        torques = [{"operating.gear_torque": quantity(share * load, "N*m")} for share in (0.8, 1.0)]
        design["duty"] = [{"set": torque} for torque in torques]
    return {"title": "A random search", "kind": "design", "scenario": scenario, "design": design}


def _searched(draw: Draw, kind: str, drive: dict[str, Any]) -> dict[str, Any]:
    """The scenario that is searched, short."""
    if kind == "gear-pair":
        found = studies.steady(duties.gear_pair(draw, drive, True))
        return found | {"mesh": {"damping_ratio": draw.between(0.02, 0.2)}}
    if kind == "efficiency":
        found = studies.efficiency(draw, drive) | {"output": {"samples_per_cycle": 16}}
        return found | {"mesh": {**found["mesh"], "compliance": "energy"}}
    found = studies.load_contact(draw, drive)
    found["operating"].pop("gear_torques", None)
    found["mesh"]["slices"] = max(found["mesh"]["slices"], 7)
    return found | {"output": {"positions_per_cycle": 8, "cycles": 1}}


def _free(draw: Draw, kind: str, drive: dict[str, Any]) -> list[dict[str, Any]]:
    """One or two keys that may change: of the flanks where new teeth take long, else of the teeth."""
    side = draw.choice(("pinion", "gear"))
    if kind == "load-contact":
        most = quantity(5e3 * size_of(drive)[0], "um")
        keys = draw.choice((("tip_relief",), ("crowning",), ("tip_relief", "crowning")))
        return [{"key": f"drive.{side}.modification.{key}", "from": "0 um", "to": most} for key in keys]
    found: list[dict[str, Any]] = []
    if drive["family"] == "involute" and draw.chance(0.5):
        found.append({"key": f"drive.{side}.profile_shift", "from": -0.2, "to": 0.6})
    if "angles" in drive.get("shape", {}) and draw.chance(0.5):
        angle = float(drive["shape"]["angles"][0].split()[0])
        bounds = {"from": quantity(angle - 2.0, "deg"), "to": quantity(angle + 2.0, "deg")}
        found.append({"key": "drive.shape.angles.0", **bounds})
    if not found or draw.chance(0.3):
        found.append({"key": f"drive.{side}.addendum", "from": 0.6, "to": 1.1})
    return found
