"""Datasets of an assessment: along the path of contact of one pair."""

from tribodyn.geometry.sheet.outlines import GEOMETRY
from tribodyn.numerics.variable import Variable
from tribodyn.record.schema import Layout

_ALONG = ("roll_angle",)

ROLL = Variable(
    _ALONG, "rad", "rotation of the pinion since the pair met at the pitch point, negative before it"
)

SAMPLES: dict[str, Variable] = {
    "normal_load": Variable(_ALONG, "N", "normal load of the pair in slow rotation"),
    "hertz_pressure": Variable(
        _ALONG, "Pa", "maximum Hertz pressure over the face, with application and dynamic factor"
    ),
    "equivalent_radius": Variable(_ALONG, "m", "radius of relative curvature"),
    "sliding_speed": Variable(_ALONG, "m/s", "sliding speed"),
    "flash_temperature_rise": Variable(_ALONG, "K", "flash temperature rise above the bulk"),
    "contact_temperature": Variable(_ALONG, "K", "contact temperature: bulk and flash"),
    "film_thickness": Variable(_ALONG, "m", "film thickness of ISO/TS 6336-22, method A"),
    "specific_film": Variable(_ALONG, "1", "specific film thickness: film over mean roughness Ra"),
}

LAYOUT = Layout(ROLL, SAMPLES, groups={"geometry": GEOMETRY})
