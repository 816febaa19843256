"""A gear pair as an object: its teeth, path of contact, geometry sheet and stiffness."""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import tomli_w

from tribodyn.drawing.picture import gears_in_mesh
from tribodyn.gears.check import sheet_of_gear, sheet_tables
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import gear_polygon
from tribodyn.geometry.drive import Side
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.limits.limits import plain_distances
from tribodyn.interface import shown
from tribodyn.interface.scenario import changes_of, in_toml, public
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import pair_slots, tabulate
from tribodyn.post.figures.gears_in_mesh import GearsInMesh
from tribodyn.quantities.quantity import in_si
from tribodyn.studies.drive_file import DriveModel, as_spline, load_drive, load_gear

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def _loaded(
    model: str | Path | Mapping[str, Any], overrides: Mapping[str, Any] | None, mesh: str | None = None
) -> DriveModel:
    text = in_toml(model) if isinstance(model, Mapping) else str(model)
    return load_drive(text, changes_of(overrides), mesh)


class GearPair:
    """A gear pair; `drive` makes one.

    Parameters
    ----------
    model, overrides, mesh
        As `drive` takes them.

    Attributes
    ----------
    title : str
        Of the drive or scenario.
    family : str
        Name of the tooth family.
    contact_ratio : float
        Theoretical transverse contact ratio.
    """

    def __init__(
        self,
        model: str | Path | Mapping[str, Any] | DriveModel,
        overrides: Mapping[str, Any] | None = None,
        mesh: str | None = None,
    ) -> None:
        self._model = model if isinstance(model, DriveModel) else _loaded(model, overrides, mesh)
        self.title, self.family = self._model.title, self._model.family
        with self._model.origins.naming():
            self._assembly = check(family(self.family), self._model.drive)
        self.contact_ratio = float(self._assembly.contact_ratio)

    @cached_property
    def sheet(self) -> dict[str, Any]:
        """The geometry sheet: name to (value, SI unit), of pinion and gear in dictionaries of their own."""
        return in_si(self._model.sheet(self._assembly))

    @cached_property
    def _mesh(self) -> GearsInMesh:
        return gears_in_mesh(self._assembly)

    @cached_property
    def outlines(self) -> dict[str, np.ndarray]:
        """Closed outlines of pinion and gear, (points, 2), m, as they stand when a pair begins contact.

        The origin is the pitch point; y points along the line of centres from pinion to gear.
        """
        return {"pinion": np.asarray(self._mesh.pinion), "gear": np.asarray(self._mesh.gear)}

    @cached_property
    def path(self) -> np.ndarray:
        """The path of contact from the first to the last contact, (points, 2), m; in axes as `outlines`."""
        return np.asarray(self._mesh.path)

    @public
    def stiffness(self, gear_torque: float | str | Any = 100.0) -> "xarray.DataArray":
        """Mesh stiffness over a mesh cycle by the energy method, N/m: all pairs, along the pitch tangent.

        Parameters
        ----------
        gear_torque : float, str or quantity of pint
            Torque on the gear; a plain number is in N m.

        Returns
        -------
        xarray.DataArray
            Over the mesh phase, 0 … 1 from the moment when a pair comes into contact.

        Raises
        ------
        InputError
            For what is no torque, and a body without a bore, by which it is held.
        """
        import xarray as xr

        from tribodyn.input.units import TORQUE, to_si_at

        text = in_toml(gear_torque)
        torque = to_si_at("gear_torque", text, TORQUE) if isinstance(text, str) else float(text)
        slots = pair_slots(self._assembly)
        cycle = tabulate(self._assembly, self._model.materials, MeshData("energy", 0.05), slots)
        phase = np.asarray(cycle.phase).ravel()
        total = np.asarray(quasi_static(cycle, cycle.gear_sense * torque).mesh_stiffness).ravel()
        named = {"units": "N/m", "long_name": "mesh stiffness, all pairs"}
        axis = ("phase", phase, {"units": "1", "long_name": "mesh phase"})
        return xr.DataArray(total, {"phase": axis}, ("phase",), "mesh_stiffness", named)

    @cached_property
    def constraints(self) -> dict[str, float]:
        """Distances from the limits of existence by name, as `constraints` gives them."""
        return plain_distances(self._assembly)

    @property
    def toml(self) -> str:
        """The pair as a drive file, with everything that it refers to."""
        return tomli_w.dumps(self._model.table)

    @public
    def as_spline(self, n: int = 9) -> "GearPair":
        """Fit a free-form path, family ``"spline"``, to the path of contact: teeth to change value by value.

        Parameters
        ----------
        n : int
            Number of pressure angles along the path, 4 … 100.

        Returns
        -------
        GearPair
            Of the same heights and thicknesses; ``toml`` is its drive file, whose source says how far the
            flanks are from the original's.

        Raises
        ------
        InputError
            For another number of values.
        """
        return GearPair(as_spline(self._model, n).table)

    @public
    def plot(self, ax: "Axes | None" = None) -> "Figure":
        """Draw the pair: both gears, and the teeth in contact with their path.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Draw where these stand, in place of them; default: a figure of its own.

        Returns
        -------
        Figure
            Of matplotlib, or the part of one that took the place of `ax`.
        """
        from tribodyn.drawing.picture import pair_figure
        from tribodyn.post.style import in_place_of

        with in_place_of(ax):
            return pair_figure(self._assembly, self.title)

    def __repr__(self) -> str:
        return f"<tribodyn gear pair: {self.title} ({self.family}), contact ratio {self.contact_ratio:.3f}>"

    def _repr_html_(self) -> str:
        """Title, teeth in contact and geometry sheet, for notebooks."""
        return shown.block(
            shown.heading(self.title, self.family),
            shown.picture_of_gears(self._mesh),
            shown.tables(sheet_tables(self._model.sheet(self._assembly))),
        )


class NamedGear:
    """One gear of a pair or of a train, a planet or a ring as well; `gear` makes one.

    Attributes
    ----------
    name : str
        Of the gear.
    pairs : dict of GearPair
        The pair in each of its meshes, by the name of the mesh (``""`` of a pair alone); meshes that differ
        by their planet alone are there once.
    sides : dict of str
        What it is in them, "pinion" or "gear". A ring is always the gear.
    """

    def __init__(self, name: str, pairs: Mapping[str, tuple[DriveModel, Side]]) -> None:
        self.name = name
        self.pairs = {mesh: GearPair(pair) for mesh, (pair, _) in pairs.items()}
        self.sides: dict[str, Side] = {mesh: side for mesh, (_, side) in pairs.items()}

    @property
    def sheet(self) -> dict[str, dict[str, Any]]:
        """Its lines of the geometry sheet by the name of the mesh: name to (value, SI unit)."""
        return {mesh: sheet_of_gear(pair.sheet, self.sides[mesh]) for mesh, pair in self.pairs.items()}

    @property
    def outline(self) -> np.ndarray:
        """Its closed outline about its axis, (points, 2), m."""
        mesh, pair = next(iter(self.pairs.items()))
        return np.asarray(gear_polygon(pair._assembly, self.sides[mesh]))

    @property
    def constraints(self) -> dict[str, float]:
        """Its distances from the limits of existence, see `constraints`: the smallest of all meshes."""
        found: dict[str, float] = {}
        for mesh, pair in self.pairs.items():
            for name, value in pair.constraints.items():
                limit = name.removesuffix(f"_{self.sides[mesh]}")
                if limit != name:
                    found[limit] = min(value, found.get(limit, value))
        return found

    def __repr__(self) -> str:
        meshes = ", ".join(filter(None, self.pairs)) or "one mesh"
        teeth = next(iter(self.sheet.values()))["teeth"][0]
        return f"<tribodyn gear: {self.name}, {teeth:g} teeth, in {meshes}>"


@public
def gear(
    model: str | Path | Mapping[str, Any], name: str, overrides: Mapping[str, Any] | None = None
) -> NamedGear:
    """Take one gear of a train, or of a pair, by its name.

    Parameters
    ----------
    model, overrides
        As `drive` takes them.
    name : str
        Of the gear in the scenario: a planet by its own name, or all of a set by the name of their table; of
        a pair "pinion" or "gear".

    Returns
    -------
    NamedGear

    Raises
    ------
    InputError
        If there is none of that name, or no such gears can be made.
    """
    text = in_toml(model) if isinstance(model, Mapping) else str(model)
    return NamedGear(name, load_gear(text, changes_of(overrides), name))


@public
def drive(
    model: str | Path | Mapping[str, Any],
    overrides: Mapping[str, Any] | None = None,
    mesh: str | None = None,
) -> GearPair:
    """Make a gear pair, without a load or a speed.

    Parameters
    ----------
    model : str, Path or mapping
        Name of a shipped drive or scenario, or a file of either sort; or what a drive file holds.
    overrides : mapping, optional
        Dotted key to value: ``{"drive.pinion.profile_shift": 0.3}``.
    mesh : str, optional
        Of a scenario of a train: the mesh whose gears are meant, its driver the pinion.

    Returns
    -------
    GearPair

    Raises
    ------
    InputError
        If there is none, or no such gears can be made.
    """
    return GearPair(model, overrides, mesh)


@public
def constraints(
    model: str | Path | Mapping[str, Any] | GearPair,
    overrides: Mapping[str, Any] | None = None,
    mesh: str | None = None,
) -> dict[str, float]:
    """How far a pair is from the limits of its existence: signed distances, positive where gears exist.

    They are continuous in the numbers of the pair; `gradient` and `differentiable` know them by name.

    Parameters
    ----------
    model, overrides, mesh
        As `drive` takes them, or a gear pair; its teeth need not exist. Of one gear: `NamedGear.constraints`.

    Returns
    -------
    dict
        For pinion and gear each, m: ``undercut_…`` (speed of the contact along the flank per speed of the
        pinion, zero at a singular point), ``interference_…`` (flank left below the lowest contact),
        ``tip_corner_…`` (gap between fillet and the mate's tip), ``tip_thickness_…``, ``clearance_…`` (of the
        tip from the mate's root), ``rack_tip_…`` (width left at the rack's tip);
        ``contact_ratio_above_1``; of pairs with an internal gear, and a module of others,
        ``trochoidal_clearance`` (of the tips where they pass), ``tool_flank`` (speed along the tools' flanks)
        and ``base_circle``. What does not exist, because the path ends before the teeth do, counts as a
        module (or 1) beyond the limit.

    Raises
    ------
    InputError
        If there is no such model, or its keys are wrong; never because of its shape.
    """
    if isinstance(model, GearPair):
        return model.constraints
    loaded = _loaded(model, overrides, mesh)
    return plain_distances(assemble(family(loaded.family), loaded.drive))
