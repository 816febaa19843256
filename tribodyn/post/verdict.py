"""The verdict on a record: what moves, what presses, what is lost, what lies outside the model, what to do.

Each line is a sentence for a reader who has never seen the program; the numbers behind it stand in the
details of the summary. A line is left out where a record lacks what it is about.
"""

import math
from collections.abc import Callable, Iterable, Mapping
from numbers import Real
from typing import Any

import numpy as np

from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.quantities.quantity import from_to
from tribodyn.record import trust
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE
from tribodyn.record.withheld_efficiency import warnings

#: What the table of solved contacts and the kernels of its law take: 51 to 228 s were measured.
SOLVED = "one to four minutes of one core the first time"
#: Lines of a run's verdict, at most.
LINES = 6
#: Share of the contact, or of the loss, outside the limits of a law from which its values are in doubt: of 94
#: meshes those with up to a fifth of their loss outside have friction as right as those with none.
IN_DOUBT = 0.2
#: Film over roughness below which asperities carry much of the load, and above which they carry none.
ROUGH, SMOOTH = 1.0, 3.0
#: Share of time without contact that counts; factor on the mean mesh force that is a resonance; mean
#: transmission error over what teeth bend from which bearings are soft.
APART, RESONANT, SOFT = 1e-4, 1.5, 10.0
#: What a remark says on engagement that is all of a dynamic factor.
KNOCK = "the knock of pairs"
#: What it means that a limit of a law is exceeded, by how the limit begins.
_MEANS = {
    "σ/ρ ≤": "the flanks are rougher than it was fitted for",
    "roughness factor": "roughness raises the film more than twofold",
    "roughness ≤": "the flanks are too rough for it",
    "Ra ≤": "the flanks are too rough for it",
    "M ≥": "the contact is lightly loaded",
    "M ≤": "the contact is heavily loaded",
    "L ≥": "the oil hardly thickens under pressure",
    "L ≤": "the oil is thick or fast",
    "η0 u² ≤": "the oil heats before it enters the contact",
    "p_H ≤": "the pressure is high",
    "p_H ≥": "the pressure is low",
    "W ≥": "the load is low",
    "W ≤": "the load is high",
    "U ≥": "speed or viscosity is low",
    "U ≤": "speed or viscosity is high",
    "Newtonian stress": "the oil is sheared less than it takes to reach its limit",
    "V ≤": "the flanks are harder for their modulus than it was fitted for",
    "V ≥": "the flanks are softer for their modulus than it was fitted for",
    "G ≤": "the oil thickens much under pressure",
    "G ≥": "the oil thickens little under pressure",
    "viscosity measured": "the viscosity at high pressure is estimated by the oil's type",
    "oil within": "the oil's temperature is beyond the measured ones",
    "slide-to-roll": "the flanks slide fast",
    "sliding ≥": "the flanks hardly slide",
    "2 m/s": "speed or load is outside the standard",
}


def over_course(summary: Mapping[str, Any]) -> Mapping[str, Any]:
    """A summary with the extremes of the whole run in place of the last cycles', where its speed changes."""
    course = summary.get("course")
    if not isinstance(course, Mapping):
        return summary
    run = summary.get("extremes", {}).get("run", {})
    names = ("hertz_pressure_max", "film_min", "film_parameter_min", "normal_load_max")
    extremes = {name: run[name]["value"] for name in names if name in run and name in summary}
    of_films = {
        name: course[name]["value"] for name in ("dynamic_factor", "contact_loss_fraction") if name in course
    }
    return {**summary, **extremes, **of_films}


def on_course(course: Mapping[str, Any]) -> str:
    """A sentence on a run whose speed changes: what is largest, at which speed and order."""
    ends = " to ".join(_rpm(course[f"{end}_speed"]) for end in ("first", "last"))
    parts = []
    if "dynamic_factor" in course:
        extreme = course["dynamic_factor"]
        parts.append(
            f"vibration raises the tooth forces to {extreme['value']:.2f} times their mean {_at(extreme)}"
        )
    if "transmission_error_peak_to_peak" in course:
        extreme = course["transmission_error_peak_to_peak"]
        swing = with_unit("transmission_error_peak_to_peak", extreme["value"])
        parts.append(f"the transmission error swings by up to {swing} {_at(extreme)}")
    if "contact_loss_fraction" in course and course["contact_loss_fraction"]["value"] > APART:
        extreme = course["contact_loss_fraction"]
        parts.append(f"the teeth are apart for up to {share(extreme['value'])} of the time {_at(extreme)}")
    else:
        parts.append("contact is never lost")
    return f"On the way from {ends} {'; '.join(parts)}."


def _rpm(speed: float) -> str:
    """A speed over a few mesh cycles, to three digits."""
    return f"{float(f'{speed * 30.0 / math.pi:.3g}'):g} rpm"


def _at(extreme: Mapping[str, Any]) -> str:
    """Where on the course of a run something is, over a few mesh cycles."""
    order = f", mesh order {extreme['order']:.2g}" if "order" in extreme else ""
    return f"at {_rpm(extreme['speed'])} ({extreme['time']:.3g} s{order})"


def moved(summary: Mapping[str, Any]) -> Iterable[str]:
    """What moves."""
    if isinstance(course := summary.get("course"), Mapping):
        yield on_course(course)
        return
    cause = raised_by(summary)
    summary = numbers(summary)
    if (error := summary.get("transmission_error_peak_to_peak")) is not None:
        parts = [f"The transmission error swings by {with_unit('transmission_error_peak_to_peak', error)}"]
        if (factor := summary.get("dynamic_factor")) is not None:
            parts.append(f"{cause} raises the tooth forces to {factor:.2f} times their mean")
        parts.append(apart(summary.get("contact_loss_fraction") or 0.0))
        yield f"{'; '.join(parts)}."
    mean, bent = (summary.get(f"transmission_error_{of}mean", 0.0) for of in ("", "normal_"))
    if abs(mean) > SOFT * abs(bent) > 0.0:
        both = (with_unit("transmission_error_mean", each) for each in (mean, bent))
        yield "The bearings are soft: of a mean transmission error of {} teeth bend {}.".format(*both)
    if (loaded := summary.get("loaded_transmission_error_peak_to_peak")) is not None:
        text = with_unit("loaded_transmission_error_peak_to_peak", loaded)
        yield f"In slow rotation under load the transmission error swings by {text}."


def pressed(summary: Mapping[str, Any]) -> Iterable[str]:
    """What presses, and what keeps the flanks apart."""
    summary, parts = numbers(summary), []
    if (pressure := summary.get("hertz_pressure_max")) is not None:
        parts.append(f"The flanks press with up to {with_unit('hertz_pressure_max', pressure)}")
    ratio, film = summary.get("film_parameter_min"), summary.get("film_min")
    if ratio is not None:
        thick = f"at least {with_unit('film_min', film)}, " if film is not None else "at least "
        parts.append(f"the oil film is {thick}{ratio:.2g} times the roughness: {lubrication(ratio)}")
    roots = [summary[of] for of in ("pinion_root_tension_max", "gear_root_tension_max") if of in summary]
    if roots:
        parts.append(f"the tooth-root tensile stress is {with_unit('pinion_root_tension_max', max(roots))}")
    if parts:
        yield f"{'; '.join(parts)}."


def lost(summary: Mapping[str, Any]) -> Iterable[str]:
    """What is lost."""
    last = ", over the last cycles" if "course" in summary else ""
    summary = numbers(summary)
    power, friction = summary.get("power_in_mean"), summary.get("power_friction_mean")
    if power and friction is not None and friction > 0.0:
        mean = summary.get("friction_coefficient_mean")
        at = f", at a mean coefficient of {mean:.3f}{band_of(summary)}" if mean is not None else ""
        through = share(friction / abs(power))
        yield f"Friction takes {watts(friction)} of {watts(abs(power))}, {through}{at}{last}."


def band_of(summary: Mapping[str, Any]) -> str:
    """The band of a friction coefficient solved with an estimated viscosity, in brackets; "" without one."""
    values = numbers(summary)
    if not {"friction_coefficient_mean", "friction_band_low", "friction_band_high"} <= set(values):
        return ""
    low, high = (
        values["friction_coefficient_mean"] * values[f"friction_band_{end}"] for end in ("low", "high")
    )
    return f" ({low:.3f} to {high:.3f}: the oil's viscosity at high pressure is estimated)"


def outside(summary: Mapping[str, Any]) -> Iterable[str]:
    """How far film and friction are from the solved contact, and where they are in doubt."""
    holding, here = [], True
    for what, where in (("film", "contact"), ("friction", "loss")):
        law, judged = summary.get(f"{what}_law"), numbers(summary.get(f"{what}_judged"))
        if not {"low", "median", "high"} <= set(judged):
            continue
        beyond = in_doubt_by(summary, what)
        in_doubt = beyond >= IN_DOUBT
        low, middle, high = (
            1.0 / judged.get(f"{end}_outside" if in_doubt else end, judged[end])
            for end in ("high", "median", "low")
        )
        if not in_doubt:
            holding.append(f"{from_to(low, high)} times the printed {what} ({law})")
            here = here and "at_duty" in judged
            continue
        why = _why(summary.get("closure_exceeded" if what == "film" else "friction_exceeded"))
        times = f"probably {middle:.1g} times what is printed ({low:.1g} to {high:.1g})"
        beyond_in = f"{law} is beyond its range in {share(beyond)} of the {where}{why}"
        yield f"{what.capitalize()} in doubt, {times}: {beyond_in}."
    if holding:
        contacts = "contacts solved at this duty" if here else "solved contacts"
        yield f"By {contacts}, expect {' and '.join(holding)}."


def in_doubt_by(summary: Mapping[str, Any], what: str) -> float:
    """Share of contact or loss in which a law is beyond its range; 0 of one compared at the duty itself."""
    if "at_duty" in numbers(summary.get(f"{what}_judged")):
        return 0.0
    return numbers(summary).get(f"{what}_outside", 0.0)


def advised(summary: Mapping[str, Any]) -> Iterable[str]:
    """What to do, the most urgent first."""
    values, engaged = numbers(summary), str(summary.get("engagement_remark") or "")
    if "is too few" in (slices := str(summary.get("slice_remark"))):
        yield f"To do: {slices}"
    for what in ("film", "friction"):
        if isinstance(summary.get(f"{what}_judged"), Mapping) and in_doubt_by(summary, what) >= IN_DOUBT:
            nearest = "" if summary.get(f"{what}_chosen") else f'{what}.law = "auto" takes the nearest law; '
            solved = f'{what}.law = "solved" solves the contact itself, {SOLVED}'
            yield f"To do: {nearest}{solved}. {engaged}".rstrip()
            return
    if values.get("contact_loss_fraction", 0.0) > APART:
        yield "To do: more load, more damping, tip relief or another speed keeps the teeth together."
    elif engaged or values.get("dynamic_factor", 0.0) > RESONANT:
        resonance = "find the resonance with tribodyn sweep, and move speed or stiffness away from it."
        yield f"To do: {engaged or resonance}"
    elif values.get("film_parameter_min", SMOOTH) < ROUGH:
        yield "To do: smoother flanks, thicker or cooler oil, or more speed raise the film."


def first(record: Record) -> Iterable[str]:
    """What stands before all else: why a record is not complete, or not to be trusted."""
    if record.status != "complete":
        yield f"The run is {record.status}{': ' if record.message else ''}{record.message}."
    if brief := trust.brief(record.summary):
        yield f"{brief[0].upper()}{brief[1:]}: these numbers are not to be trusted."
    for warning in warnings(record.summary):
        if not warning.startswith(trust.OUTSIDE):
            yield f"{warning[0].upper()}{warning[1:]}."


def of_gears(record: Record) -> list[str]:
    """Lines of a record of gears; of any record those for which it has the quantities."""
    summary = over_course(record.summary)
    start = [str(summary.get("settling_remark") or "")]
    parts = (moved(summary), start, pressed(summary), lost(summary), outside(summary), advised(summary))
    return [line for part in parts for line in part if line]


def of_sweep(record: SweepRecord, place: Callable[[tuple[int, ...]], str]) -> list[str]:
    """Lines of a sweep of gears; `place` writes the values of the parameters of a case."""
    lines = []

    def extreme(name: str, find: Callable[[Any], Any]) -> tuple[float, str] | None:
        values = (
            np.where(record["status"] == DONE, record[name], np.nan) if name in record else np.array(np.nan)
        )
        if not np.any(np.isfinite(values)):
            return None
        at = tuple(map(int, np.unravel_index(int(find(values)), values.shape)))
        return float(values[at]), place(at)

    if loud := extreme("dynamic_factor", np.nanargmax):
        lines.append(f"Vibration is largest at {loud[1]}: tooth forces of {loud[0]:.2f} times their mean.")
    if separated := extreme("contact_loss_fraction", np.nanargmax):
        many = int(np.sum(np.nan_to_num(record["contact_loss_fraction"]) > APART))
        longest = f"case{'s' * (many != 1)}, for {share(separated[0])} of the time at {separated[1]}"
        lines.append(f"The teeth separate in {many} {longest}." if many else "Contact is never lost.")
    if thin := extreme("film_parameter_min", np.nanargmin):
        lines.append(f"The film is thinnest at {thin[1]}: {thin[0]:.2g} times the roughness.")
    low, high = (extreme("efficiency", find) for find in (np.nanargmin, np.nanargmax))
    if low and high and low[0] < high[0]:
        ends = [f"{with_unit('efficiency', end[0])} at {end[1]}" for end in (low, high)]
        lines.append(f"The efficiency lies between {' and '.join(ends)}.")
    lines += _of_laws(record)
    if failed := record.count()["failed"]:
        lines.append(f"{failed} of {record.count()['cases']} cases failed.")
    return lines


def _of_laws(record: SweepRecord) -> Iterable[str]:
    """How far the laws of a sweep are from solved contacts, and in how many cases they are extrapolated."""
    judged = np.asarray(record["trust"])[record["status"] == DONE] if "trust" in record else np.zeros(0)
    many = int(np.sum(judged == trust.VERDICTS[trust.EXTRAPOLATED]))
    beyond = f"in {many} of {len(judged)} cases a law is nowhere inside its range, and that is in doubt"
    for line in outside(record.settings.get("laws") or {}):
        yield f"{line[:-1]}; {beyond}." if many else line


def raised_by(summary: Mapping[str, Any]) -> str:
    """What raises the loads of teeth: engagement where a remark says that it is all, else vibration."""
    return "engagement" if KNOCK in str(summary.get("engagement_remark")) else "vibration"


def apart(fraction: float) -> str:
    """Whether contact is lost, by the share of the time without contact."""
    lost = f"the teeth are apart for {share(fraction)} of the time"
    return lost if fraction > APART else "contact is never lost"


def lubrication(ratio: float) -> str:
    """What keeps the flanks apart, by the film over the roughness."""
    if ratio >= SMOOTH:
        return "a full film"
    return f"asperities carry {'part' if ratio >= ROUGH else 'much'} of the load"


def numbers(summary: Any) -> dict[str, float]:
    """The finite numbers of a summary: a record that somebody changed may hold anything."""
    items = summary.items() if isinstance(summary, Mapping) else ()
    return {str(name): float(one) for name, one in items if isinstance(one, Real) and math.isfinite(one)}


def share(part: float) -> str:
    """A share in words or per cent."""
    return "all" if part > 0.995 else f"{100.0 * part:.2g} %"


def watts(power: float) -> str:
    """A power to three digits."""
    return f"{power * 1e-3:.3g} kW" if power >= 1000.0 else f"{power:.3g} W"


def with_unit(name: str, value: float) -> str:
    """A value with the unit and the digits of its quantity."""
    return QUANTITIES[name].with_unit(float(value))


def meaning(limit: str) -> str:
    """What it means that a limit of a law is exceeded; the limit itself where it is not known."""
    return next((text for begins, text in _MEANS.items() if limit.startswith(begins)), limit)


def _why(exceeded: Any) -> str:
    """The limit that is exceeded in the largest share, one by the solved contact first; "" without any."""
    each = exceeded.values() if isinstance(exceeded, Mapping) else ()
    limits = [
        (str(excess.get("limit")), numbers(excess).get("share", 0.0))
        for excess in each
        if isinstance(excess, Mapping)
    ]
    if not limits:
        return ""
    worst, _ = max(limits, key=lambda limit: (limit[0].endswith("(judged)"), limit[1]))
    return f" ({meaning(worst)})"
