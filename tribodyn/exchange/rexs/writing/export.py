"""REXS 2.0.0 of a scenario or of the record of a run: the gearbox, its results, and what was left out."""

from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from typing import Any

from tribodyn import __version__
from tribodyn.errors import harmless, printable
from tribodyn.exchange.format import Exported, Written
from tribodyn.exchange.heading import without_double_hyphens
from tribodyn.exchange.rexs.file.attributes import RexsKey
from tribodyn.exchange.rexs.writing.train import TrainText, refuse_what_rexs_has_not

#: Results of a mesh in a summary, and of a run -> unit of REXS, and SI units in one of it.
_RESULTS = {
    "contact_ratio": ("none", 1.0),
    "mesh_frequency": ("Hz", 1.0),
    "normal_load_max": ("N", 1.0),
    "dynamic_factor": ("none", 1.0),
    "film_min": ("mum", 1e-6),
    "film_parameter_min": ("none", 1.0),
    "hertz_pressure_max": ("MPa", 1e6),
    "friction_coefficient_mean": ("none", 1.0),
    "power_friction_mean": ("W", 1.0),
    "transmission_error_peak_to_peak": ("mum", 1e-6),
    "mesh_stiffness_mean": ("N / m", 1.0),
    "contact_temperature_max": ("C", 1.0),
    "efficiency": ("none", 1.0),
}
_KELVIN = 273.15
#: Keys of pairs -> of trains.
_OF_TRAINS = {
    "pinion_speed": "input_speed",
    "gear_speed": "output_speed",
    "pinion_torque": "input_torque",
    "gear_torque": "output_torque",
}
#: Tables of which REXS holds nothing.
_NOT_HELD = (
    "mesh",
    "film",
    "friction",
    "solver",
    "output",
    "temperature",
    "losses",
    "damage",
    "sensor",
    "housing",
)


def write(exported: Exported, name: str, choices: Mapping[str, float]) -> Written:
    """The file, and what it could not take along."""
    tables = as_train(exported.scenario, exported)
    refuse_what_rexs_has_not(tables)
    try:
        train = TrainText(tables)
    except KeyError as error:
        raise exported.refused(
            f"has no {error.args[0]}, which REXS needs", "export a train or a pair of gears"
        ) from None
    remarks = [*train.shafts.remarks, *_left_out(tables)]
    if exported.summary is not None:
        _put_results(train, exported.summary)
    date = datetime.now(UTC).replace(microsecond=0).isoformat()
    head, _, body = train.model.xml(date).partition("\n")
    made = printable(harmless(f"written by tribodyn {__version__} from {exported.path.name}"))
    return Written({".rexs": f"{head}\n<!-- {without_double_hyphens(made)} -->\n{body}"}, (), tuple(remarks))


def as_train(scenario: Mapping[str, Any], exported: Exported) -> dict[str, Any]:
    """The tables of a scenario, those of a pair of gears as those of a train of one stage."""
    tables = dict(scenario)
    drive = tables.pop("drive", None)
    if drive is not None and not all(isinstance(drive.get(side), Mapping) for side in ("pinion", "gear")):
        raise exported.refused("is no scenario of gears", "export a train or a pair of gears")
    if drive is not None:
        gears = {side: dict(drive[side]) for side in ("pinion", "gear")}
        shared = ("material", "mean_roughness", "quality")
        tables |= {key: drive[key] for key in shared if drive.get(key) is not None}
        if drive.get("hand") and not gears["pinion"].get("hand"):
            gears["pinion"]["hand"] = drive["hand"]
        stage = {key: value for key, value in drive.items() if not isinstance(value, dict) or key == "shape"}
        tables["gear"], tables["stage"] = gears, [{**stage, "name": "mesh", "gears": ["pinion", "gear"]}]
        operating = {_OF_TRAINS.get(key, key): value for key, value in tables.get("operating", {}).items()}
        tables["operating"] = {"input": "pinion", "output": "gear"} | operating
        tables["duty"] = [
            {_OF_TRAINS.get(key, key): value for key, value in duty.items()}
            for duty in tables.get("duty") or ()
        ]
    shafts = tables.get("shaft")
    if isinstance(shafts, Mapping):
        tables["shaft"] = [
            {"name": f"{side}-shaft", "gears": [side], "drawn": each} for side, each in shafts.items() if each
        ]
    if not isinstance(tables.get("gear"), Mapping) or not isinstance(tables.get("operating"), Mapping):
        raise exported.refused("is no scenario of gears", "export a train or a pair of gears")
    tables["stage"] = list(tables.get("stage") or ())
    return tables


def _put_results(train: TrainText, summary: Mapping[str, Any]) -> None:
    """Results as attributes of the stages, and of the gear unit."""
    meshes = summary.get("meshes") or {}
    told = {number: meshes.get(name) or {} for name, number in train.meshes.items()}
    if not meshes and len(train.meshes) == 1:
        told = dict.fromkeys(train.meshes.values(), summary)
    for number, found in {train.unit: summary, **told}.items():
        for key, (unit, size) in _RESULTS.items():
            value = found.get(key)
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                shown = value - _KELVIN if unit == "C" else value / size
                train.model.put(number, RexsKey(f"custom_tribodyn_{key}", "", unit), float(f"{shown:.9g}"))


def _left_out(tables: Mapping[str, Any]) -> list[str]:
    """What of a scenario has no attribute."""
    there = [f"[{name}]" for name in _NOT_HELD if tables.get(name)]
    remarks = [f"REXS has nothing of {', '.join(there)}"] if there else []
    for place, table, known in _tables_of(tables):
        lost = [key for key, value in table.items() if key not in known and not _is_default(key, value)]
        if lost:
            remarks.append(f"{place}: REXS has no attribute of {', '.join(lost)}")
    return remarks


def _tables_of(tables: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any], frozenset[str]]]:
    """Tables with the keys that are written."""
    for name, table in tables["gear"].items():
        yield f"gear.{name}", table, _GEAR
        yield f"gear.{name}.modification", table.get("modification") or {}, _MODIFICATION
    for number, stage in enumerate(tables["stage"]):
        yield f"stage.{stage.get('name') or number}", stage, _STAGE
    for shaft in tables.get("shaft") or ():
        drawn = shaft.get("drawn") or {}
        yield f"shaft.{shaft['name']}", shaft, _SHAFT
        yield f"shaft.{shaft['name']}.drawn", drawn, _DRAWN
        for number, each in enumerate(drawn.get("bearing") or (), start=1):
            yield f"bearing {shaft['name']}-{number}", each, _BEARING
    for name, each in (tables.get("bearings") or {}).items():
        if isinstance(each, Mapping):
            yield f"bearings.{name}", each, _SPRINGS
    yield "lubricant", tables.get("lubricant") or {}, _OIL
    yield "operating", tables["operating"], _OPERATING


_GEAR = frozenset(
    "teeth hand face_width internal profile_shift profile_shift_of addendum dedendum fillet_radius "
    "tip_diameter tip_radius bore_diameter bore_radius mass mean_roughness quality span_teeth "
    "thickness_allowance thickness_tolerance thickness_code material modification "
    "cutter_teeth cutter_profile_shift cutter_addendum cutter_rounding".split()
)
_MODIFICATION = frozenset(
    "tip_relief tip_relief_length tip_relief_shape root_relief root_relief_length root_relief_shape "
    "lead_relief_start lead_relief_end lead_unmodified crowning helix_slope both_flanks".split()
)
_STAGE = frozenset(
    "type name gears module pressure_angle helix_angle centre_distance azimuth rack roughness family sun "
    "planet ring carrier planets held floating angles support_stiffness hand material mean_roughness quality "
    "pinion gear title source assumptions".split()
)
_SHAFT = frozenset({"name", "gears", "drawn", "law"})
_DRAWN = frozenset("section positions gear_position bearing youngs_modulus poisson_ratio density".split())
_SPRINGS = frozenset(
    "stiffness_x stiffness_y stiffness_axial stiffness_tilt title source assumptions".split()
)
_BEARING = _SPRINGS | frozenset(
    "position type bore outside_diameter elements element_diameter pitch_diameter roller_length "
    "contact_angle thrust arrangement rows row_distance clearance preload preload_force locating "
    "dynamic_rating "
    "static_rating fatigue_load_limit contamination_factor".split()
)
_OIL = frozenset("title source assumptions type viscosity_40 viscosity_100 density_15".split())
_OPERATING = frozenset(
    "input output sense input_speed output_speed input_torque output_torque power duty "
    "oil_temperature".split()
)
#: Texts that a key has where nothing was said.
_DEFAULTS = {
    "rim": "fixed",
    "source": "speed",
    "force": "linear",
    "law": "linear",
    "damping_ratio": 0.05,
    "frame_forces": True,
    "support_damping_ratio": 0.02,
    "fzg_micropitting_temperature": "90 degC",
    "quality_edition": 2013,
}


def _is_default(key: str, value: Any) -> bool:
    """Whether a key says nothing: a table resolved has all of them."""
    if value in (None, False, 0, 0.0, "", [], {}) or _DEFAULTS.get(key) == value:
        return True
    return isinstance(value, str) and value.split(" ")[0] in ("0", "0.0")
