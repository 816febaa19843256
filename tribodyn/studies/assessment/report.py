"""Reported quantities of an assessment, how far to trust them, and tables of its meshes."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.case import stage_table
from tribodyn.gears.rating.bearings import bearing_rows
from tribodyn.gears.rating.capacity import shorter_life
from tribodyn.gears.rating.limits import SAFETIES, on_limits
from tribodyn.gears.rating.rating_text import sentences as sentences
from tribodyn.gears.rating.rating_text import unit_of
from tribodyn.gears.rating.spectrum import spectrum_tables
from tribodyn.post.verdict import numbers, outside, with_unit
from tribodyn.quantities.catalogue import OF_FACE, QUANTITIES, quantities, scatter_of
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.findings import IN_EQUILIBRIUM

REPORTED: Reported = {
    "Train": quantities("train_ratio", "input_speed"),
    "Geometry": quantities(
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "contact_ratio_effective"),
    ),
    "Loaded contact": (
        *quantities("loaded_transmission_error_peak_to_peak"),
        scatter_of("loaded_transmission_error_peak_to_peak"),
        *quantities("face_load_factor"),
        scatter_of("face_load_factor"),
        *quantities("shaft_misalignment", "given_misalignment"),
        *quantities("transverse_load_factor", "transverse_load_factor_method_b"),
        scatter_of("transverse_load_factor"),
        *quantities("pinion_root_tension_max", "gear_root_tension_max"),
    ),
    "Steady states": (
        *quantities("dynamic_factor"),
        scatter_of("dynamic_factor"),
        *quantities("dynamic_factor_max", "dynamic_factor_max_speed"),
        scatter_of("dynamic_factor_max"),
        *quantities("contact_loss_speed_from", "normal_load_max"),
    ),
    "Planets": quantities("mesh_load_factor", "mesh_load_factor_max", "planet_load_factor_max"),
    "Load capacity": quantities(*SAFETIES.values(), "life"),
    "Film and losses": (
        *quantities("specific_film_min"),
        scatter_of("specific_film_min"),
        *quantities("contact_temperature_max"),
        scatter_of("contact_temperature_max"),
        *quantities("power_friction_mean", "efficiency"),
        scatter_of("efficiency"),
        *quantities("efficiency_lowest", "efficiency_highest"),
    ),
    "Solver": quantities("wall_time"),
}
SWEPT = quantities(
    *("efficiency", "power_friction_mean", "dynamic_factor", "dynamic_factor_max"),
    *("hertz_pressure_max", "film_parameter_min", "specific_film_min", "contact_temperature_max"),
    *("loaded_transmission_error_peak_to_peak", "pinion_root_tension_max", "gear_root_tension_max"),
    *SAFETIES.values(),
    *("life", "life_unlimited"),
)
PANELS = ("hertz_pressure", "contact_temperature", "specific_film", "dynamic_factor", "efficiency")
#: Where each mesh has what a table of meshes shows -> what that is.
OF_A_MESH: dict[str, tuple[Quantity, ...]] = {
    "simulated": quantities(
        *("power_in_mean", "power_friction_mean", "efficiency", "dynamic_factor", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "contact_temperature_max", "K_Hbeta", "K_Halpha"),
        *("sigma_H", "S_H", "sigma_F", "S_F", "life", "lambda_GF", "S_B", "S_lambda"),
    ),
    "iso": quantities(
        *("K_v", "K_Halpha", "K_gamma", "sigma_H", "S_H", "sigma_F", "S_F", "life"),
        *("H_v", "lambda_GF", "theta_B", "S_B", "S_intS", "S_lambda", "S_FF"),
    ),
}


def meshes_of(summary: Mapping[str, Any]) -> Mapping[str, Mapping[str, Any]]:
    """The summary of every mesh by name; that of a pair of gears, whose mesh has none, is its own."""
    return summary.get(MESHES) or {"": summary}


def groups_of(meshes: Mapping[str, Mapping[str, Any]]) -> dict[str, list[str]]:
    """Meshes by a name for each table column: those of a set's planets with one member together."""
    groups: dict[str, list[str]] = {}
    for name, mesh in meshes.items():
        groups.setdefault(str(mesh.get("alike") or name), []).append(name)
    return groups


def of_mesh(mesh: Mapping[str, Any], part: str, name: str) -> Any:
    """What a mesh has, simulated or by the standards: a margin, else by its name, else of its motion."""
    places = [mesh.get("margins", {}).get(part, {}), mesh.get(part, {})]
    if part == "simulated" and name not in SAFETIES.values():  # which are the smaller of both
        places.append(mesh)
    return next((place[name] for place in places if place.get(name) is not None), None)


def worst_in(quantity: Quantity, part: str, names: list[str], meshes: Mapping[str, Mapping[str, Any]]) -> str:
    """A quantity of a group of meshes, written: the largest, of film, efficiency and safety the smallest."""
    if quantity.name == "life":
        life = shorter_life(*(meshes[name].get("margins", {}).get(part, {}) for name in names))
        return quantity.written_of(life) if life else "–"
    few = quantity.name.startswith(("S_", "film", "lambda", "efficiency"))
    extreme = min if few else max
    values = [of_mesh(meshes[name], part, quantity.name) for name in names]
    found = [_of_table(value, extreme) for value in values if value is not None]
    return quantity.written(float(extreme(found))) if found else "–"


def _of_table(value: Any, extreme: Callable[[Any], float]) -> float:
    """A number; of a table by points the worst, of one by gears the extreme."""
    if not isinstance(value, Mapping):
        return float(value)
    return float(value["worst"] if "worst" in value else extreme(value.values()))


def mesh_table(summary: Mapping[str, Any], part: str) -> TextTable:
    """The table of meshes, simulated or by the standards; without rows for a pair of gears."""
    meshes = summary.get(MESHES, {})
    groups = groups_of(meshes)
    rows = [
        [
            quantity.title,
            *(worst_in(quantity, part, names, meshes) for names in groups.values()),
            unit_of(quantity),
        ]
        for quantity in OF_A_MESH[part]
    ]
    factors = [float(mesh["load_factors"]["K_A"]) for mesh in meshes.values() if "load_factors" in mesh]
    by = {"simulated": "simulated, stresses, temperatures and safeties", "iso": "by the standards"}[part]
    heading = f"Each mesh, {by} with K_A {max(factors, default=1.0):g}"
    heading += "; of several planets the worst" if len(groups) < len(meshes) else ""
    return TextTable(heading, ("", *groups, ""), [row for row in rows if set(row[1:-1]) - {"–"}])


def face_table(summary: Mapping[str, Any]) -> TextTable:
    """Loads along the faces in static equilibrium, beside K_Hβ of the rating; without rows where none are."""
    meshes = meshes_of(summary)
    groups = {
        group: [meshes[name] for name in names if IN_EQUILIBRIUM in meshes[name]]
        for group, names in groups_of(meshes).items()
    }
    groups = {group: found for group, found in groups.items() if found}

    def row(title: str, quantity: Quantity, every: Iterable[Sequence[float | None]]) -> list[str]:
        known = [[value for value in values if value is not None] for values in every]
        written = [quantity.written(max(values, key=abs)) if values else "–" for values in known]
        return [title, *written, unit_of(quantity)]

    face = QUANTITIES["face_load_factor"]
    rows = [
        row(
            f"{face.title} of the rating",
            face,
            ([mesh.get(face.name) for mesh in of] for of in groups.values()),
        )
    ]
    for quantity in OF_FACE:
        of_quantity = ([mesh[IN_EQUILIBRIUM].get(quantity.name) for mesh in of] for of in groups.values())
        rows.append(row(quantity.title, quantity, of_quantity))
    heading = "Loads along the faces, in static equilibrium of the gearbox"
    heading += "; of several planets the largest" if len(groups) < len(meshes) else ""
    return TextTable(heading, ("", *groups, ""), [one for one in rows if groups and set(one[1:-1]) - {"–"}])


def tables(record: Record) -> list[TextTable]:
    """Every mesh simulated and by the standards, every planetary stage, Miner's sums, bearings."""
    summary = record.summary
    found = [stage_table(summary), mesh_table(summary, "simulated"), mesh_table(summary, "iso")]
    found += [face_table(summary), *miner_tables(summary)]
    if bearings := summary.get("bearings"):
        found.append(TextTable("Bearings", *bearing_rows(bearings)))
    return [table for table in found if table.rows]


def miner_tables(summary: Mapping[str, Any]) -> list[TextTable]:
    """Miner's sums of both gears of every mesh, duty by duty; those of alike planets once."""
    meshes, found = meshes_of(summary), []
    for group, (name, *_) in groups_of(meshes).items():
        of_group = f", {group}" if group else ""
        spectrum = spectrum_tables(meshes[name].get("spectrum", {}))
        found += [table._replace(title=f"{table.title}{of_group}") for table in spectrum]
    return found


def verdict(record: Record) -> list[str]:
    """Say whether the limits hold, what moves and presses, what is lost, and how far to trust it."""
    summary = record.summary
    judged = [sentence for _, sentence in on_limits(summary)]
    texts = [str(summary[name]) for name in ("not_judged", "rests_on") if name in summary]
    doubt = [str(line) for line in summary.get("in_doubt", {}).values()]
    return [*judged, *texts, *doubt, *shown(summary), *([] if MESHES in summary else outside(summary))]


def shown(summary: Mapping[str, Any]) -> Iterator[str]:
    """What moves, presses and is lost, and which mesh is the worst."""
    least, named = summary.get("worst_of", {}), MESHES in summary
    in_bearings = sum(one.get("power_bearing", 0.0) for one in summary.get("bearings", {}).values())
    summary = numbers(summary)
    names = [name for name in SAFETIES.values() if name in summary and name in least]
    if names:
        parts = [f"{QUANTITIES[name].symbol} {summary[name]:.2f} in {least[name]}" for name in names]
        yield f"Smallest safeties: {', '.join(parts)}."
    if "dynamic_factor" in summary:
        yield _vibration(summary, " of the input" if named else "")
    if (share := summary.get("mesh_load_factor")) is not None:
        yield f"The planet with most carries {share:.3f} times its share (K_γ)."
    if {"specific_film_min", "hertz_pressure_max", "contact_temperature_max"} <= set(summary):
        pressure = with_unit("hertz_pressure_max", summary["hertz_pressure_max"])
        hot = with_unit("contact_temperature_max", summary["contact_temperature_max"])
        film = f"the film is at least {summary['specific_film_min']:.2g} times their Ra"
        yield f"The flanks press with up to {pressure} and reach {hot}; {film}."
    ends: Sequence[float] = [summary[name] for name in _ENDS if name in summary]
    span = f"; by other friction laws {' to '.join(f'{100.0 * end:.2f}' for end in ends)} %" if ends else ""
    if named and "efficiency" in summary:
        lost = with_unit("power_friction_mean", summary["power_friction_mean"])
        if in_bearings and "power_in_mean" in summary:
            left = 100.0 * (summary["efficiency"] - in_bearings / summary["power_in_mean"])
            span += f"; with {with_unit('power_bearing', in_bearings)} of its rolling bearings {left:.2f} %"
        yield (
            f"The teeth lose {lost}; by tooth friction alone, without bearings, seals and churning, the "
            f"train is {100.0 * summary['efficiency']:.2f} % efficient{span}."
        )
    elif ends and "efficiency" in summary:
        yield f"The mesh is {100.0 * summary['efficiency']:.2f} % efficient{span}."


_ENDS = ("efficiency_lowest", "efficiency_highest")


def _vibration(summary: Mapping[str, Any], of: str) -> str:
    """How much vibration raises the loads, and where contact is lost; `of` is what turns at the speeds."""
    text = f"Vibration raises the tooth forces to {summary['dynamic_factor']:.2f} times their mean"
    highest, where = (summary.get(f"dynamic_factor_max{end}") for end in ("", "_speed"))
    if highest is not None and where is not None:
        text += f", at {with_unit('dynamic_factor_max_speed', where)}{of} to {highest:.2f} times"
    if (lost := summary.get("contact_loss_speed_from")) is not None:
        text += f"; the teeth separate from {with_unit('contact_loss_speed_from', lost)}{of}"
    return f"{text}."
