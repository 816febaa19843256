"""Reported quantities of a drive cycle, its verdict, and how far to trust it."""

from tribodyn.cases.loss_part import TERMS
from tribodyn.cases.results import TextTable
from tribodyn.post.verdict import lubrication, numbers, with_unit
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record
from tribodyn.tribology.oil import ZERO_CELSIUS

REPORTED: Reported = {
    "Energy": quantities(
        *("cycle_duration", "cycle_energy_in", "cycle_energy_out", "cycle_energy_lost", "cycle_efficiency"),
        *("cycle_loss_mean", "cycle_loss_max", "cycle_heat_stored", "cycle_heat_gone"),
    ),
    "Temperature": quantities(
        *("cycle_oil_temperature_max", "cycle_oil_temperature_end", "cycle_bulk_temperature_max"),
        "cycle_hottest_part",
    ),
    "Tribology": quantities("film_min", "film_parameter_min"),
    "Solver": quantities("cycle_heat_balance", "cycle_loss_error", "wall_time"),
}
SWEPT = quantities(
    *("cycle_energy_in", "cycle_energy_out", "cycle_energy_lost", "cycle_efficiency", "cycle_loss_mean"),
    *("cycle_oil_temperature_max", "cycle_oil_temperature_end", "cycle_bulk_temperature_max"),
    *("film_min", "film_parameter_min", "cycle_heat_balance"),
)
SHORT = {"efficiency": "cycle_efficiency", "loss": "cycle_loss_mean"}
PANELS = ("power_loss", "oil_temperature", "input_speed", "load")


def tables(record: Record) -> list[TextTable]:
    """Energies by term, and temperatures of all parts."""
    summary = record.summary
    lost = summary["cycle_energy_lost"]
    of_terms = [
        (term, about, f"{1e-3 * energy:.4g}", f"{100.0 * energy / lost:.3g}" if lost else "–")
        for term, about in TERMS.items()
        if (energy := summary["energy_by_term"][term])
    ]
    of_parts = [
        (part, f"{warmest - ZERO_CELSIUS:.1f}", f"{summary['temperature_end'][part] - ZERO_CELSIUS:.1f}")
        for part, warmest in summary["temperature_max"].items()
    ]
    return [
        TextTable("Energy lost by term", ("term", "", "kJ", "%"), of_terms),
        TextTable("Temperatures of the parts (°C)", ("part", "highest", "at the end"), of_parts),
    ]


def verdict(record: Record) -> list[str]:
    """Say what the cycle takes, how warm the oil gets and how thick the film stays."""
    summary, lines = numbers(record.summary), []
    lost, taken = summary["cycle_energy_lost"], summary["cycle_energy_in"]
    of_it = f", {100.0 * lost / taken:.3g} % of what the input takes" if taken > 0.0 else ""
    lines.append(f"The cycle loses {1e-3 * lost:.4g} kJ{of_it}.")
    warmest, end = (
        with_unit(f"cycle_oil_temperature_{when}", summary[f"cycle_oil_temperature_{when}"])
        for when in ("max", "end")
    )
    part = record.summary["cycle_hottest_part"]
    lines.append(f"The oil reaches {warmest} and ends at {end}; the warmest part is {part}.")
    if (ratio := summary.get("film_parameter_min")) is not None:
        lines.append(f"The oil film is at least {ratio:.2g} times the roughness: {lubrication(ratio)}.")
    return lines


def sentences(record: Record) -> list[str]:
    """Say what the model leaves out, and how well heat balances."""
    summary = record.summary
    lines = [
        "Quasi-static: at every moment the losses are those of steady running at that speed, load and "
        "temperature; energy stored in rotation is left out.",
        f"Heat that arises is stored or given off within {summary['cycle_heat_balance']:.1e} of it; losses "
        f"at the rows are those integrated within {summary['cycle_loss_error']:.1e} of the largest.",
    ]
    exceeded = summary.get("exceeded") or {}
    lines += [f"{source}: outside {limits}." for source, limits in exceeded.items()]
    return lines
