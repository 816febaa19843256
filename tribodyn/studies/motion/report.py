"""Reported quantities of a gearbox, of all its meshes and of each, and how far to trust them."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.case import (
    ENERGY,
    OF_PLANETS,
    STAGES,
    TEMPERATURE,
    TEMPERATURE_SWEPT,
    TRIBOLOGY,
    stage_table,
)
from tribodyn.gears.motion.extremes import on_extremes
from tribodyn.gears.sensing.signal_quantities import on_silent, sensor_tables
from tribodyn.post import verdict as of_any
from tribodyn.post.page.motion import Mechanism
from tribodyn.post.page.solid import Solid
from tribodyn.post.report import on_closures, on_energy, on_methods
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import MESHES, Record
from tribodyn.record.withheld_efficiency import reasons
from tribodyn.studies.motion.drivetrain.mesh_groups import between, groups_of, idle_meshes, together
from tribodyn.studies.motion.losses.breakdown import LOSSES, loss_table
from tribodyn.studies.motion.pictures.deflected_gearbox import deflected_gearbox
from tribodyn.studies.motion.pictures.rolling_train import rolling_train

#: Of several meshes the worst where it is not of all together.
REPORTED: Reported = {
    "Train": quantities("train_ratio", "common_period"),
    "Geometry": quantities(
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "slices", "normal_backlash"),
        "stiffness_single_pair_at_pitch_point",
    ),
    "Dynamics": quantities(
        *("mesh_frequency", "transmission_error_mean", "transmission_error_rms"),
        *("transmission_error_peak_to_peak", "transmission_error_harmonics"),
        *("transmission_error_normal_mean", "transmission_error_normal_peak_to_peak"),
        *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "normal_load_max"),
        *("line_load_max", "axial_force_mean"),
        *("dynamic_factor", "dynamic_factor_iso", "resonance_ratio_iso", "contact_loss_fraction"),
    ),
    "Planets": OF_PLANETS,
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Temperature": TEMPERATURE,
    "Margins": quantities("S_B", "S_lambda"),
    "Solver": quantities("solver", "steps", "rhs_evaluations", "wall_time"),
}
#: Of each mesh, in a table with a column for each.
OF_A_MESH: tuple[Quantity, ...] = (
    *quantities("contact_ratio", "normal_backlash", "stiffness_single_pair_at_pitch_point"),
    *quantities("mesh_frequency", "transmission_error_mean", "transmission_error_rms"),
    *quantities("transmission_error_peak_to_peak", "mesh_stiffness_mean", "mesh_stiffness_peak_to_peak"),
    *quantities("normal_load_max", "dynamic_factor", "dynamic_factor_iso", "contact_loss_fraction"),
    *quantities("film_min", "film_parameter_min", "film_parameter_min_roll_angle"),
    *quantities("hertz_pressure_max", "flash_temperature_max", "friction_coefficient_mean"),
    *quantities("power_in_mean", "power_friction_mean", "efficiency"),
    *TEMPERATURE,
    *quantities("S_B", "S_lambda"),
)
#: What a sweep keeps: one number per case, from its steady window; of several meshes the worst.
SWEPT = (
    *quantities(
        *("mesh_frequency", "transmission_error_rms", "transmission_error_peak_to_peak"),
        "transmission_error_mean",
        *("dynamic_factor", "normal_load_max", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "flash_temperature_max", "friction_coefficient_mean"),
        *("efficiency", "power_in_mean", "power_friction_mean", "friction_work_on_vibration"),
    ),
    *TEMPERATURE_SWEPT,
    *quantities("contact_loss_fraction", "closure_in_range_fraction", "friction_in_range_fraction"),
    *OF_PLANETS,
)
#: What a sweep prints, minimum and maximum of each.
SWEEP_TABLE = quantities(
    *("transmission_error_rms", "transmission_error_peak_to_peak", "dynamic_factor", "normal_load_max"),
    *("hertz_pressure_max", "film_min", "efficiency", "friction_work_on_vibration", "contact_loss_fraction"),
)
SHORT = {"peak_to_peak": "transmission_error_peak_to_peak", "loss": "power_friction_mean"}
PANELS = (
    *("transmission_error_rotational", "normal_load", "central_film_thickness"),
    *("friction_coefficient", "power_friction", "mesh_power_friction"),
)
#: Meshes beside each other in a table, and named one by one in a sentence.
ACROSS, NAMED = 4, 3


def tables(record: Record) -> list[TextTable]:
    """Quantities of each mesh, a column for each, one for those of a member of a set; and of its sensors."""
    meshes = record.mesh_summaries
    lost = record.summary.get(LOSSES)
    losses = [loss_table(lost)] if lost else []
    if not record.names_meshes or not meshes:
        return [*losses, *sensor_tables(record)]
    withheld = reasons(record.summary)
    groups = groups_of(meshes)
    return [
        *_stages(record.summary),
        *(
            _table(groups[start : start + ACROSS], meshes, withheld)
            for start in range(0, len(groups), ACROSS)
        ),
        *losses,
        *sensor_tables(record),
    ]


def mechanism(record: Record) -> Mechanism | None:
    """The train that rolls on a page; a pair has the page's own picture."""
    return rolling_train(record) if record.names_meshes else None


def solid(record: Record) -> Solid | None:
    """Drawn shafts and what they carry, bent at every moment; None where none are drawn."""
    return deflected_gearbox(record)


def _stages(summary: Mapping[str, Any]) -> Iterable[TextTable]:
    """Quantities of each planetary stage and shares of its planets, a column for each."""
    table = stage_table(summary)
    if table.rows:
        every = [one["planet_shares"] for one in summary[STAGES].values()]
        shares = (", ".join(f"{100.0 * share:.1f}" for share in one) for one in every)
        first, *rest = table.rows
        yield table._replace(rows=[first, ["Shares of the planets", *shares, "%"], *rest])


def _table(
    groups: Sequence[Sequence[str]], meshes: Mapping[str, Mapping[str, Any]], withheld: Mapping[str, str]
) -> TextTable:
    rows = [
        [what, *(together(str(meshes[name].get(what, "")) for name in names) for names in groups), ""]
        for what in ("driver", "driven")
    ]
    for quantity in OF_A_MESH:
        cells = [_cell(quantity, names, meshes, withheld) for names in groups]
        if any(cells):
            rows.append([quantity.title, *cells, quantity.unit])
    title = "Each mesh" if len(groups) == len(meshes) else "Each mesh; of several planets smallest … largest"
    return TextTable(title, ("", *map(together, groups), ""), rows)


def _cell(
    quantity: Quantity,
    names: Sequence[str],
    meshes: Mapping[str, Mapping[str, Any]],
    withheld: Mapping[str, str],
) -> str:
    """A quantity of meshes as it is written: of different values the smallest and the largest."""
    if any(f"{MESHES}/{name}/{quantity.name}" in withheld for name in names):
        return "withheld"
    values = [meshes[name].get(quantity.name) for name in names]
    numbers = [value for value in values if value is not None]
    return between([quantity.written(value) for value in numbers], numbers)


def verdict(record: Record) -> list[str]:
    """Say what vibrates, presses and is lost in which mesh, where a law is in doubt, and what to do."""
    if not record.names_meshes:
        return of_any.of_gears(record)
    summary, meshes = record.summary, record.mesh_summaries
    if not meshes:
        return []
    summary, meshes = of_course(summary, meshes)
    sentences = [*_moved(summary, meshes), *filter(None, [summary.get("settling_remark")])]
    sentences += [*_pressed(summary, meshes), *_lost(summary, meshes)]
    idle = idle_meshes(meshes)
    loaded = {name: mesh for name, mesh in meshes.items() if name not in idle}
    name = max(loaded, key=lambda name: _beyond(loaded[name]))
    for line in of_any.outside(meshes[name]):
        sentences.append(f"Mesh {name}: {line[0].lower()}{line[1:]}" if _beyond(meshes[name]) else line)
    whole = {"engagement_remark": summary.get("engagement_remark"), **of_any.numbers(summary)}
    if idle:
        for worst in ("dynamic_factor", "contact_loss_fraction"):
            whole[worst] = max(of_any.numbers(mesh).get(worst, 0.0) for mesh in loaded.values())
    return [*sentences, *of_any.advised({**meshes[name], **whole})]


def of_course(
    summary: Mapping[str, Any], meshes: Mapping[str, Mapping[str, Any]]
) -> tuple[Mapping[str, Any], dict[str, Mapping[str, Any]]]:
    """The same with the extremes of the whole run where its speed changes."""
    courses = [mesh["course"] for mesh in meshes.values() if "course" in mesh]
    if not courses:
        return summary, dict(meshes)
    from tribodyn.studies.motion.summary import worst_of  # heavy, and few runs change

    over = {name: of_any.over_course(mesh) for name, mesh in meshes.items()}
    return {**summary, **worst_of(list(over.values())), "course": courses[0]}, over


def _beyond(mesh: Mapping[str, Any]) -> float:
    """Share of contact or loss beyond the range of a law from which it is in doubt; 0 below."""
    most = max(of_any.in_doubt_by(mesh, what) for what in ("film", "friction"))
    return most if most >= of_any.IN_DOUBT else 0.0


def _moved(summary: Mapping[str, Any], meshes: Mapping[str, Mapping[str, Any]]) -> Iterable[str]:
    factors = {name: of_any.numbers(mesh).get("dynamic_factor") for name, mesh in meshes.items()}
    idle = idle_meshes(meshes)
    finite = {name: factor for name, factor in factors.items() if factor is not None and name not in idle}
    loss = of_any.numbers(summary).get("contact_loss_fraction", 0.0)
    where = f" in {_worst(summary, meshes, 'contact_loss_fraction')}" if loss > of_any.APART else ""
    if not finite:
        if where:
            yield f"Teeth that carry nothing: {of_any.apart(loss)}{where}."
        return
    if courses := {name: mesh["course"] for name, mesh in meshes.items() if "course" in mesh}:
        name = max(courses, key=lambda name: finite.get(name, 0.0))
        text = of_any.on_course(courses[name])
        yield text if len(meshes) == 1 else f"Mesh {name}: {text[0].lower()}{text[1:]}"
        return
    cause = of_any.raised_by(summary).capitalize()
    if len(finite) <= NAMED:
        parts = _listed([f"{factor:.2f} ({name})" for name, factor in finite.items()])
        text = f"{cause} raises the tooth forces to {parts} times their mean"
    else:
        name = max(finite, key=lambda name: finite[name])
        text = f"{cause} raises the tooth forces to at most {finite[name]:.2f} times their mean ({name})"
    idling = f"; {together(idle)} idle{'s' * (len(idle) == 1)}" if idle else ""
    yield f"{text}; {of_any.apart(loss)}{where}{idling}."


def _pressed(summary: Mapping[str, Any], meshes: Mapping[str, Mapping[str, Any]]) -> Iterable[str]:
    values, parts = of_any.numbers(summary), []
    if (pressure := values.get("hertz_pressure_max")) is not None:
        where = _worst(summary, meshes, "hertz_pressure_max")
        parts.append(
            f"The flanks press with up to {of_any.with_unit('hertz_pressure_max', pressure)} ({where})"
        )
    if (ratio := values.get("film_parameter_min")) is not None:
        where = _worst(summary, meshes, "film_parameter_min")
        film = of_any.numbers(meshes[where]).get("film_min")
        thick = "" if film is None else f"{of_any.with_unit('film_min', film)}, "
        text = f"the oil film is at least {thick}{ratio:.2g} times the roughness ({where})"
        parts.append(f"{text}: {of_any.lubrication(ratio)}")
    if parts:
        yield f"{'; '.join(parts)}."


def _lost(summary: Mapping[str, Any], meshes: Mapping[str, Mapping[str, Any]]) -> Iterable[str]:
    losses = {
        together(names): sum(of_any.numbers(meshes[name]).get("power_friction_mean", 0.0) for name in names)
        for names in groups_of(meshes)
    }
    whole = sum(losses.values())
    for line in of_any.lost(summary):
        if len(losses) <= NAMED:
            parts = [f"{of_any.share(loss / whole)} in {name}" for name, loss in losses.items()]
            yield f"{line[:-1]}: {_listed(parts)}."
        else:
            name = max(losses, key=lambda name: losses[name])
            yield f"{line[:-1]}, most of it in {name}: {of_any.share(losses[name] / whole)}."


def _worst(summary: Mapping[str, Any], meshes: Mapping[str, Any], quantity: str) -> str:
    """Name of the mesh that has the worst value of a quantity; the first where the summary does not say."""
    number = of_any.numbers(summary.get("worst_mesh")).get(quantity, 1.0)
    return list(meshes)[min(max(int(number), 1), len(meshes)) - 1]


def _listed(parts: Sequence[str]) -> str:
    return " and ".join(filter(None, (", ".join(parts[:-1]), *parts[-1:])))


def sentences(record: Record) -> list[str]:
    """Say over which cycles means are, and of all meshes what of a pair is said of it."""
    summary, meshes = record.summary, record.mesh_summaries
    ends = [*on_energy(summary), *on_silent(summary)]
    if not record.names_meshes:
        return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *ends]
    of_train = {name: value for name, value in summary.items() if name != "averaging_cycles"}
    meshes_by_line: dict[str, list[str]] = {}
    for name, mesh in meshes.items():
        for line in (*on_extremes(mesh), *on_closures(mesh)):
            meshes_by_line.setdefault(line, []).append(name)
    of_meshes = [
        line if len(names) == len(meshes) else f"{line[:-1]} ({together(names)})."
        for line, names in meshes_by_line.items()
    ]
    return [*on_methods(of_train), *_on_period(record), *of_meshes, *ends]


def _on_period(record: Record) -> list[str]:
    """Say over which cycles means are, and whether these are whole common periods of the meshes."""
    values = of_any.numbers(record.summary)
    if not {"averaging_cycles", "common_period"} <= set(values):
        return []
    cycles, period = int(values["averaging_cycles"]), max(int(values["common_period"]), 1)
    text = f"Means are over the last {_counted(cycles, 'cycle')} of the mesh {record.meshes[0]}"
    if cycles % period:
        return [f"{text}, less than the common period of {period} cycles."]
    return [f"{text}: {_counted(cycles // period, 'common period')} of all meshes."]


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
