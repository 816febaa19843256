"""Reported quantities of an assessment of a train, and how far to trust them."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.rating.bearings import bearing_rows
from tribodyn.gears.rating.capacity import shorter_life
from tribodyn.gears.rating.limits import on_limits
from tribodyn.gears.rating.rating_text import sentences as sentences
from tribodyn.gears.rating.rating_text import unit_of
from tribodyn.gears.rating.spectrum import spectrum_tables
from tribodyn.post.verdict import numbers, with_unit
from tribodyn.quantities.catalogue import QUANTITIES, quantities
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.pair.report import vibration

REPORTED: Reported = {
    "Train": quantities("train_ratio", "input_speed", "power_in_mean", "power_friction_mean", "efficiency"),
    "Other friction laws": quantities("efficiency_lowest", "efficiency_highest"),
    "Vibration": quantities(
        *("dynamic_factor", "dynamic_factor_max", "dynamic_factor_max_speed"),
        *("contact_loss_speed_from", "normal_load_max"),
    ),
    "Planets": quantities("mesh_load_factor", "mesh_load_factor_max", "planet_load_factor_max"),
    "Film": quantities("film_min", "film_parameter_min", "hertz_pressure_max", "contact_temperature_max"),
    "Margins": quantities("S_H", "S_F", "life", "S_B", "S_intS", "S_lambda"),
    "Solver": quantities("wall_time"),
}
SWEPT = quantities(
    *("efficiency", "power_friction_mean", "dynamic_factor", "dynamic_factor_max"),
    *("hertz_pressure_max", "film_parameter_min", "S_H", "S_F", "S_B", "S_lambda"),
    *("life", "life_unlimited"),
)
PANELS = ("dynamic_factor", "efficiency")
#: Part of a mesh's summary -> its quantities in the table of meshes.
OF_A_MESH: dict[str, tuple[Quantity, ...]] = {
    "simulated": quantities(
        *("power_in_mean", "power_friction_mean", "efficiency", "dynamic_factor", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "contact_temperature_max", "K_Hbeta", "K_Halpha"),
        *("sigma_H", "S_H", "sigma_F", "S_F", "life", "lambda_GF", "S_B", "S_lambda"),
    ),
    "iso": quantities(
        *("K_v", "K_Halpha", "K_gamma", "sigma_H", "S_H", "sigma_F", "S_F", "life"),
        *("H_v", "lambda_GF", "theta_B", "S_B", "S_intS", "S_lambda"),
    ),
}
OF_A_STAGE = quantities(
    *("mesh_load_factor", "planet_load_factor_max", "power_in_mean", "power_friction_mean", "efficiency")
)


def groups_of(meshes: Mapping[str, Mapping[str, Any]]) -> dict[str, list[str]]:
    """Meshes by a name for each table column: those of a set's planets with one member together."""
    groups: dict[str, list[str]] = {}
    for name, mesh in meshes.items():
        groups.setdefault(str(mesh.get("alike") or name), []).append(name)
    return groups


def worst_in(quantity: Quantity, part: str, names: list[str], meshes: Mapping[str, Mapping[str, Any]]) -> str:
    """A quantity of a group of meshes, written: the largest, of film, efficiency and safety the smallest."""
    values = [meshes[name].get(part, {}).get(quantity.name) for name in names]
    few = quantity.name.startswith(("S_", "film", "lambda", "efficiency", "life"))
    extreme = min if few else max
    if quantity.name == "life":
        life = shorter_life(*(meshes[name].get(part, {}) for name in names))
        return quantity.written_of(life) if life else "–"
    numbers = [_of_table(value, extreme) for value in values if value is not None]
    return quantity.written(float(extreme(numbers))) if numbers else "–"


def _of_table(value: Any, extreme: Callable[[Any], float]) -> float:
    """A number; of a table by points the worst, of one by gears the extreme."""
    if not isinstance(value, Mapping):
        return float(value)
    return float(value["worst"] if "worst" in value else extreme(value.values()))


def mesh_rows(summary: Mapping[str, Any], part: str) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of the table of meshes."""
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
    return ["", *groups, ""], [row for row in rows if set(row[1:-1]) != {"–"}]


def heading(part: str, summary: Mapping[str, Any]) -> str:
    """What stands above the table of meshes, simulated or by the standards."""
    factors = [float(mesh["load_factors"]["K_A"]) for mesh in summary.get(MESHES, {}).values()]
    factor = f"K_A {max(factors, default=1.0):g}"
    by = f"simulated, stresses, temperatures along the path and safeties with {factor}"
    if part == "iso":
        by = f"by the standards with {factor}"
    return f"Each mesh, {by}; of several planets the worst"


def stage_rows(summary: Mapping[str, Any]) -> tuple[list[str], list[list[str]]]:
    """Columns and rows of the table of planetary stages."""
    stages = summary.get("stages", {})
    rows = [
        [quantity.title, *(quantity.written(one[quantity.name]) for one in stages.values()), quantity.unit]
        for quantity in OF_A_STAGE
    ]
    return ["", *stages, ""], rows if stages else []


def tables(record: Record) -> list[TextTable]:
    """Every mesh simulated and by the standards, every planetary stage, Miner's sums, bearings."""
    text_tables = []
    for title, (columns, rows) in (
        ("Each planetary stage", stage_rows(record.summary)),
        (heading("simulated", record.summary), mesh_rows(record.summary, "simulated")),
        (heading("iso", record.summary), mesh_rows(record.summary, "iso")),
    ):
        if rows:
            text_tables.append(TextTable(title, tuple(columns), rows))
    text_tables += spectrum_tables_of(record.summary)
    if bearings := record.summary.get("bearings"):
        text_tables.append(TextTable("Bearings", *bearing_rows(bearings)))
    return text_tables


def spectrum_tables_of(summary: Mapping[str, Any]) -> list[TextTable]:
    """Miner's sums of both gears of every mesh, duty by duty; those of alike planets once."""
    tables = []
    for group, names in groups_of(summary.get(MESHES, {})).items():
        spectrum = summary[MESHES][names[0]].get("iso", {}).get("spectrum", {})
        tables += [table._replace(title=f"{table.title}, {group}") for table in spectrum_tables(spectrum)]
    return tables


def verdict(record: Record) -> list[str]:
    """Say whether the limits hold, how the planets share the load, what vibrates and what is lost."""
    summary = record.summary
    judged = [sentence for _, sentence in on_limits(summary)]
    missing = [str(summary["not_judged"])] if "not_judged" in summary else []
    doubt = [str(line) for line in summary.get("in_doubt", {}).values()]
    return [*judged, *missing, *doubt, *_shown(summary)]


def _shown(summary: Mapping[str, Any]) -> Iterator[str]:
    values = numbers(summary)
    if "efficiency" in values:
        lost = with_unit("power_friction_mean", values["power_friction_mean"])
        yield (
            f"The teeth lose {lost}; by tooth friction alone, without bearings, seals and churning, the "
            f"train is {100.0 * values['efficiency']:.2f} % efficient."
        )
    if "dynamic_factor" in values:
        yield vibration(values, " of the input")
    if (share := values.get("mesh_load_factor")) is not None:
        yield f"The planet with most carries {share:.3f} times its share (K_γ)."
    least = summary.get("worst_of", {})
    names = [name for name in ("S_H", "S_F", "S_B", "S_intS", "S_lambda") if name in values and name in least]
    if names:
        parts = [f"{QUANTITIES[name].symbol} {values[name]:.2f} in {least[name]}" for name in names]
        yield f"Smallest safeties: {', '.join(parts)}."
