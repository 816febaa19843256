"""Derivatives of a gear pair's quantities by the numbers of its scenario, through JAX."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from tribodyn.derivatives.differentiable import Differentiable
from tribodyn.derivatives.quantities import quantity_of
from tribodyn.errors import InputError, quoted
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.interface import shown
from tribodyn.interface.scenario import Source, public, scenario
from tribodyn.studies import study_of
from tribodyn.tribology.closure import closure_of


@dataclass(frozen=True)
class Gradient:
    """A quantity and its derivatives; `gradient` makes one.

    Attributes
    ----------
    of : str
        Name of the quantity.
    about, unit : str
        What it is, and its SI unit.
    value : float
        SI.
    gradient : dict
        Key to derivative, SI: the quantity's unit over the key's.
    at : dict
        Key to the value that it has in the scenario, SI.
    units : dict
        Key to its SI unit.
    """

    of: str
    about: str
    unit: str
    value: float
    gradient: dict[str, float]
    at: dict[str, float]
    units: dict[str, str]

    def __getitem__(self, key: str) -> float:
        return self.gradient[key]

    @property
    def sensitivity(self) -> dict[str, float]:
        """Key to x/f df/dx: by how many per cent the quantity changes where the key's value grows by one.

        0 for a value of 0, which has no per cent.
        """
        return {key: self.at[key] * slope / self.value for key, slope in self.gradient.items()}

    def __repr__(self) -> str:
        slopes = ", ".join(f"d/d {key} = {slope:.6g}" for key, slope in self.gradient.items())
        return f"<tribodyn gradient: {self.of} = {_with_unit(self.value, self.unit)}; {slopes}>"

    def _repr_html_(self) -> str:
        rows = []
        for key, slope in self.gradient.items():
            over = f"{self.unit} per {self.units[key]}" if self.units[key] != "1" else self.unit
            more = f"{self.sensitivity[key]:+.3g} %" if self.at[key] else "–"
            rows.append((key, _with_unit(self.at[key], self.units[key]), _with_unit(slope, over), more))
        title = f"{escape(self.about)}: <b>{escape(_with_unit(self.value, self.unit))}</b>"
        columns = "key", "value", "derivative", "change for 1 % more"
        return shown.block(f"<p>{title}</p>", shown.table(columns, rows))


def _with_unit(value: float, unit: str) -> str:
    return f"{value:.6g}" if unit == "1" else f"{value:.6g} {unit}"


@public
def gradient(
    source: Source, of: str, wrt: str | Sequence[str], overrides: Mapping[str, Any] | None = None
) -> Gradient:
    """Differentiate a quantity of a gear pair or a train by numbers of its scenario, exactly, through JAX.

    Parameters
    ----------
    source, overrides
        As `scenario` takes them; any scenario of a pair or a train with the tables that the quantity needs.
    of : str
        "contact_ratio", "centre_distance", "pressure_angle", "equivalent_radius", "hertz_pressure",
        "mean_stiffness", "stiffness_swing", "transmission_error_swing", "loss_factor", "efficiency",
        "friction_power", "normal_load_max", "hertz_pressure_max", "film_min", "film_parameter_min",
        "flash_temperature_max"; or a distance of `constraints`. All are quasi-static, of elastic load
        sharing. Of a train ``"MESH.NAME"``, and of all its meshes "efficiency" and "friction_power".
        "mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "loaded_transmission_error_peak_to_peak" and
        "power_friction_mean" of a summary are understood too.
    wrt : str or sequence of str
        Dotted keys of real numbers: geometry (``"drive.module"``, ``"drive.pinion.addendum"``,
        ``"drive.shape.…"``, entries of a list by their index, ``"drive.shape.angles.3"``), materials,
        roughness, lubricant, speed and torque, keys of the laws.

    Returns
    -------
    Gradient
        Value and derivatives in SI units.

    Raises
    ------
    InputError
        For a quantity or a key that cannot be differentiated, with those that can; and as `scenario`.

    Notes
    -----
    The first gradient of a quantity and a tooth family takes seconds to tens of seconds, in which XLA makes
    its program; that is kept in the cache folder, and the next ones take a fraction of a second. Where the
    set of pairs in contact is about to change, at a whole contact ratio, derivatives are one-sided.
    """
    keys = [wrt] if isinstance(wrt, str) else list(wrt)
    function = differentiable(source, of, keys, overrides)
    for pair, name in function.parts:
        _check(pair, name)
    value, slopes = function.gradient(function.at)
    by_key = dict(zip(keys, slopes.tolist(), strict=True))
    at = dict(zip(keys, function.at.tolist(), strict=True))
    units = dict(zip(keys, function.key_units, strict=True))
    return Gradient(of, function.about[0], function.units[0], value, by_key, at, units)


@public
def differentiable(
    source: Source,
    of: str | Sequence[str],
    wrt: str | Sequence[str],
    overrides: Mapping[str, Any] | None = None,
) -> Differentiable:
    """Make quantities of a pair or a train a differentiable function of its numbers, as a search needs.

    Parameters
    ----------
    source, overrides, of, wrt
        As `gradient` takes them; `of` may be several quantities, which one program then evaluates together.

    Returns
    -------
    Differentiable
        With ``at``, the numbers of the scenario, ``values(x)``, ``jacobian(x)`` and ``gradient(x)``, all in
        SI units. None of them raises for gears that cannot be made.

    Raises
    ------
    InputError
        As `gradient`, but not for gears that cannot be made.
    """
    case = scenario(source, overrides)
    of, wrt = ([names] if isinstance(names, str) else list(names) for names in (of, wrt))
    return study_of({"kind": case.kind}).differentiable(case, of, wrt)


def _check(case: Any, of: str) -> None:
    """Refuse quantities that the case does not have, gears that cannot be made, laws that do not fit."""
    quantity = quantity_of(case, of)
    gears = check(family(case.family), case.drive)
    if quantity.at_pitch_point and float(gears.path.pressure_angle(0.0)) < 1e-9:
        rule = f"{of} has no meaning: curvature is infinite at the pitch point of this family"
        raise InputError("drive.family", quoted(case.family), rule, "differentiate another quantity")
    if "friction" in quantity.needs:
        closure_of(case)  # raises where the laws do not fit
