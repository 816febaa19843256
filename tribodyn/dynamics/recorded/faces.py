"""What is recorded of pairs that are cut into slices: sums over the face, and what is worst along it."""

from collections.abc import Collection

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Datasets that are sums over the slices of a pair.
SUMMED = ("normal_load", "friction_force", "mesh_stiffness", "tangent_load", "tangent_stiffness")
#: Datasets of which the smallest or largest along the face is recorded.
SMALLEST = ("central_film_thickness", "film_parameter")
LARGEST = (
    *("hertz_pressure", "flash_temperature_rise", "asperity_load_ratio", "contact_temperature"),
    *("closure_shares", "friction_shares"),
)
#: Flags: 1 where all slices are in range.
ALL = ("closure_in_range", "friction_in_range")


def over_faces(
    slots: dict[str, np.ndarray],
    pairs: int,
    line_load: Float[Array, "sample slot"],
    others: Collection[str] = (),
) -> dict[str, np.ndarray]:
    """Datasets of pairs (n, pairs, …) of those of slots (n, slots, …); what has no slots stays, as `others`.

    The friction coefficient is that of the whole face, the transmission error the mean weighted by the load
    (of a pair without load over the path of contact). What is neither a sum nor an extreme is of the slice
    with the largest line load, N/m, of a pair without load of the first one on the path of contact.
    """
    count, slots_of_all = line_load.shape
    slices = slots_of_all // pairs
    if slices == 1:
        return slots
    result = {}
    loaded = line_load.reshape(count, pairs, slices)
    evaluated = ~np.isnan(slots["pressure_angle"].reshape(count, pairs, slices))
    chosen = np.argmax(np.where(evaluated, loaded + 1e-300, 0.0), axis=2)[:, :, None]
    for name, values in slots.items():
        if values.ndim < 2 or name in others:
            result[name] = values
            continue
        face = values.reshape(count, pairs, slices, *values.shape[2:])
        if name == "transmission_error_normal":
            result[name] = _weighted_mean(face, slots["normal_load"].reshape(face.shape))
        elif name in SUMMED:
            result[name] = np.sum(np.nan_to_num(face), axis=2)
        elif name in SMALLEST:
            result[name] = np.fmin.reduce(face, axis=2)
        elif name in LARGEST:
            result[name] = np.fmax.reduce(face, axis=2)
        elif name in ALL:
            result[name] = np.fmin.reduce(face, axis=2)
        else:
            result[name] = np.take_along_axis(face, chosen, axis=2)[:, :, 0]
    load = result["normal_load"]
    with np.errstate(invalid="ignore", divide="ignore"):
        # not the friction force: where the pitch line crosses a slice it acts to either side
        rubbing = np.nan_to_num(slots["friction_coefficient"] * slots["normal_load"])
        total = np.sum(rubbing.reshape(count, pairs, slices), axis=2)
        result["friction_coefficient"] = np.where(load > 0.0, total / load, np.nan)
    result["line_load"] = np.where(evaluated, loaded, 0.0)
    return result


def _weighted_mean(
    face: Float[Array, "sample pair slice"], load: Float[Array, "sample pair slice"]
) -> Float[Array, "sample pair"]:
    """Mean over the slices that are not NaN; those without load count where none of the pair has any."""
    defined = ~np.isnan(face)
    weight = np.where(defined, np.nan_to_num(load), 0.0)
    weight = np.where(np.sum(weight, axis=2, keepdims=True) > 0.0, weight, defined)
    total = np.sum(weight, axis=2)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(total > 0.0, np.sum(weight * np.nan_to_num(face), axis=2) / total, np.nan)
