"""Whether a result lies within what its model assumes; if not, what is outside, how far, where, how long.

One table of rules for all studies (`RULES`). A study hands over those of the quantities that it has, as they
are sampled, to a `Judge`, and puts what that says into its summary. Writers copy it to the root of a record,
and reports take it from there. A result outside the model is complete, but not to be trusted.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np


class Rule(NamedTuple):
    """What a model assumes of a quantity."""

    label: str  # the quantity in words
    most: float  # above it a result lies outside the model; SI
    units: str
    least: float = -math.inf  # below it likewise
    #: factor, unit, offset: from SI to what is shown, value · factor + offset, and the unit of that
    factor: float = 1.0
    unit: str = ""
    offset: float = 0.0
    extrapolates: bool = False  # whether beyond the limit a result is extrapolated, not outside the model

    def outside(self, values: np.ndarray) -> np.ndarray:
        """Where values are outside; NaN is not."""
        return (values > self.most) | (values < self.least)

    def beyond(self, values: np.ndarray) -> np.ndarray:
        """How far values are beyond the limit that they come nearest to, below 0 inside."""
        return np.maximum(values - self.most, self.least - values)

    def limit(self, value: float) -> float:
        """The limit that a value is beyond."""
        return self.least if value < self.least else self.most

    def shown(self, value: float) -> str:
        """A value as it is read."""
        return f"{value * self.factor + self.offset:.4g}{' ' if self.unit else ''}{self.unit}"

    def short(self, value: float) -> str:
        """The quantity and the limit that a value is beyond."""
        side = "below" if value < self.least else "above"
        return f"{self.label} {side} {self.shown(self.limit(value))}"


RULES: dict[str, Rule] = {
    # Stiffness and path of contact are those of teeth that keep their form; a tenth of the module is ten
    # times what gears are designed for, and bends them beyond any yield strength.
    "deflection": Rule("deflection of a pair of teeth over the module", 0.1, "1", factor=100.0, unit="%"),
    # No lubricated contact has more; regressions extrapolated give it.
    "friction_coefficient": Rule("friction coefficient", 1.0, "1"),
    # Case-hardened steel yields under its surface at about 3 GPa and shakes down to no more than 4; the
    # elastic half space says nothing of it.
    "hertz_pressure": Rule("Hertz pressure", 4e9, "Pa", factor=1e-9, unit="GPa"),
    # Scuffing temperature of case-hardened steel with an oil of the highest failure load stage S = 14:
    # 80 + 2.25 S² °C (ISO/TS 6336-20, (99)); no oil is known to separate flanks beyond it.
    "contact_temperature": Rule(
        "contact temperature", 80.0 + 2.25 * 14**2 + 273.15, "K", unit="°C", offset=-273.15
    ),
    # The same where the temperature of the oil is not known: teeth are warmer than 20 °C.
    "flash_temperature": Rule("flash temperature rise", 500.0, "K", unit="K"),
    # Films of gears are 0.01 to 3 µm thick, and heat of the inlet and want of oil thin those of cold oil; a
    # thickness ten times that, at the thinnest place, is a regression extrapolated.
    "film_thickness": Rule("minimum film thickness", 20e-6, "m", factor=1e6, unit="µm"),
    # Above 3 a film separates the flanks; 100 takes polished teeth of 0.03 µm under the thickest film.
    "film_parameter": Rule("minimum film parameter", 100.0, "1"),
    # A share of a power; outside, a force makes power that no source gives.
    "efficiency": Rule("efficiency", 1.0 + 1e-12, "1", least=-1e-12, factor=100.0, unit="%"),
    # Works are integrated with the motion and close within some ten times the tolerance.
    "energy_residual": Rule("residual of the energy balance over solver.rtol", 100.0, "1"),
    # Tips would touch the roots of the mate; the path of contact is that of fixed centres.
    "bearing_displacement": Rule(
        "displacement of a gear in its bearings over the tip clearance", 1.0, "1", factor=100.0, unit="%"
    ),
    # Friction at 1 GPa goes as a viscosity that no data sheet has.
    "viscosity_unmeasured": Rule(
        "share of the contact whose viscosity at high pressure is estimated, or beyond its measurement",
        0.01,
        "1",
        factor=100.0,
        unit="%",
        extrapolates=True,
    ),
    # A law that is nowhere used where it was fitted is a guess; one that leaves its range in a part of the
    # contact is a remark.
    **{
        f"{law}_law_range": Rule(
            f"share of the contact in which the {law} law is outside its range",
            0.99,
            "1",
            factor=100.0,
            unit="%",
            extrapolates=True,
        )
        for law in ("film", "friction")
    },
}
#: Names in a summary, and of attributes of a record: the verdict, and the reasons by name of the rule.
TRUST, REASONS = "trust", "trust_reasons"
#: The verdicts. Without one nothing was judged: a study without such quantities, or a record of 0.1.0.
#: Extrapolated: inside, but for a law that is nowhere used in its range.
INSIDE, OUTSIDE, EXTRAPOLATED = "inside the model", "outside the model", "laws extrapolated"
#: The same as numbers, for the cases of a sweep.
VERDICTS = {OUTSIDE: 0, INSIDE: 1, EXTRAPOLATED: 2}
NOT_JUDGED = -1


class Judge:
    """Takes quantities of a run as they come, and says at the end what lies outside the model."""

    def __init__(self) -> None:
        self._worst: dict[str, tuple[float, dict[str, float]]] = {}
        self._samples: dict[str, int] = {}
        self._outside: dict[str, int] = {}

    def take(
        self,
        #: name of a rule -> a number, or values (n,) or (n, pairs, …); NaN where there is nothing to judge
        quantities: Mapping[str, Any],
        places: Mapping[str, Any] | None = None,  # name -> where the n samples lie (n,)
        pairs: Sequence[int] = (),  # numbers of the pairs along the second axis
        between_samples: bool = False,  # whether values are extremes between samples, which count in no share
    ) -> None:
        """Take a block of values."""
        for name, quantity_values in quantities.items():
            rule, values = RULES[name], np.asarray(quantity_values, dtype=float)
            if values.size == 0:
                continue
            ends = np.array([np.fmax.reduce(values, axis=None), np.fmin.reduce(values, axis=None)])
            inside = not rule.outside(ends).any()
            if values.ndim and not between_samples:
                broken = 0 if inside else np.sum(rule.outside(values).reshape(len(values), -1).any(axis=1))
                self._samples[name] = self._samples.get(name, 0) + len(values)
                self._outside[name] = self._outside.get(name, 0) + int(broken)
            if inside:  # where that is, nobody asks
                self._worst.setdefault(name, (float(ends[0]), {}))
                continue
            beyond = np.where(np.isnan(values), -np.inf, rule.beyond(values))
            at = np.unravel_index(int(np.argmax(beyond)), values.shape)
            value, worst = float(values[at]), self._worst.get(name)
            if worst is None or not rule.beyond(np.array(value)) <= rule.beyond(np.array(worst[0])):
                details = {place: float(where[at[0]]) for place, where in (places or {}).items()}
                if pairs and len(at) > 1:
                    details["pair"] = int(pairs[int(at[1])])
                self._worst[name] = value, details

    def summary(self) -> dict[str, Any]:
        """What a summary says: the verdict, and the reasons; nothing where nothing was judged.

        A reason has the value that is furthest outside and the limit, SI, the share of the samples in which
        the rule is broken (None of a single number), and where the value is: time (s), mesh_cycle, pair, …
        """
        if not self._worst:
            return {}
        reasons = {}
        for name, rule in RULES.items():
            value, places = self._worst.get(name, (math.nan, {}))
            if rule.outside(np.array(value)):
                share = self._outside[name] / self._samples[name] if name in self._samples else None
                limit = {"value": value, "limit": rule.limit(value), "units": rule.units, "share": share}
                reasons[name] = limit | places
        if not reasons:
            return {TRUST: INSIDE}
        extrapolated = all(RULES[name].extrapolates for name in reasons)
        return {TRUST: EXTRAPOLATED if extrapolated else OUTSIDE, REASONS: reasons}


def judge_tribology(judge: Judge, summary: Mapping[str, Any]) -> None:
    """Judge films by their minimum, and ranges of laws, of a summary.

    Not by their maximum: where the load vanishes, laws give a film without bound.
    """
    films = {"film_thickness": summary.get("film_min"), "film_parameter": summary.get("film_parameter_min")}
    for name, law in (("film_law_range", "closure"), ("friction_law_range", "friction")):
        inside = summary.get(f"{law}_in_range_fraction")
        films[name] = None if inside is None else 1.0 - inside
    judge.take({name: value for name, value in films.items() if value is not None})


def heat_of(flash_rise: Any, temperature: float | None) -> dict[str, Any]:
    """Flash temperature rises (K) as a quantity to judge, with the temperature of teeth or oil if known."""
    if temperature is None:
        return {"flash_temperature": flash_rise}
    return {"contact_temperature": temperature + flash_rise}


def verdict(summary: Mapping[str, Any]) -> str:
    """`INSIDE`, `OUTSIDE`, `EXTRAPOLATED`, or "" where nothing was judged."""
    verdict_text = summary.get(TRUST)
    return verdict_text if verdict_text in VERDICTS else ""


def number(summary: Mapping[str, Any]) -> int:
    """The verdict as the cases of a sweep have it."""
    return VERDICTS.get(verdict(summary), NOT_JUDGED)


def reasons(summary: Mapping[str, Any]) -> list[str]:
    """Why a result is not inside the model: quantity, value, limit, for what share, and where; in words."""
    return [_sentence(rule, breach) for rule, breach in _broken(summary)]


def warnings(summary: Mapping[str, Any]) -> list[str]:
    """What lies outside the model, in words; laws that are extrapolated are no warning."""
    return [
        f"{OUTSIDE}: {_sentence(rule, breach)}" for rule, breach in _broken(summary) if not rule.extrapolates
    ]


def brief(summary: Mapping[str, Any]) -> str:
    """The same without values, for the remark on a case of a sweep; "" where it is not outside."""
    broken = [rule.short(float(value["value"])) for rule, value in _broken(summary) if not rule.extrapolates]
    return f"{OUTSIDE}: {', '.join(broken)}" if broken else ""


def attributes(summary: Mapping[str, Any]) -> dict[str, str]:
    """What the root of a record says: the verdict, and the reasons, one per line."""
    verdict_text = verdict(summary)
    return {TRUST: verdict_text, REASONS: "\n".join(reasons(summary))} if verdict_text else {}


def _broken(summary: Mapping[str, Any]) -> Iterator[tuple[Rule, Mapping[str, Any]]]:
    stated = summary.get(REASONS)
    if verdict(summary) not in (OUTSIDE, EXTRAPOLATED) or not isinstance(stated, Mapping):
        return
    for name, rule in RULES.items():
        breach = stated.get(name)
        if isinstance(breach, Mapping) and {"value", "limit"} <= set(breach):
            yield rule, breach


#: How places are written.
_PLACES = {
    "time": "at t = {:.4g} s",
    "mesh_cycle": "mesh cycle {:.4g}",
    "phase": "at phase {:.4g}",
    "pair": "pair {:.0f}",
}


def _sentence(rule: Rule, breach: Mapping[str, Any]) -> str:
    value, limit = float(breach["value"]), float(breach["limit"])
    side = "at least" if value < limit else "at most"
    sentence = f"{rule.label} {rule.shown(value)}, {side} {rule.shown(limit)}"
    share = breach.get("share")
    if share is not None and float(share) <= 0.0:  # an extreme that lies between two samples
        sentence += ", outside between samples only"
    elif share is not None and float(share) >= 1.0:
        sentence += ", outside in all samples"
    elif share is not None:
        sentence += f", outside in {min(max(100.0 * float(share), 0.01), 99.9):.3g} % of the samples"
    places = [
        text.format(float(breach[name])) for name, text in _PLACES.items() if breach.get(name) is not None
    ]
    return f"{sentence}, worst {', '.join(places)}" if places else sentence
