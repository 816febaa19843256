"""Oils and materials: from REXS to the tables of a scenario."""

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.reading.draft import Draft, text

#: Steel that stands for one of which the file says nothing.
TYPICAL_MATERIAL = "18CrNiMo7-6"
#: Materials that the package ships, by the letters and digits of their designation.
_SHIPPED = {
    "".join(filter(str.isalnum, name)).lower(): name
    for name in ("18CrNiMo7-6", "16MnCr5", "20MnCr5", "42CrMo4", "C45", "EN-GJS-600-3", "CuSn12")
}
_MINERAL, _SYNTHETIC = ("mineral", "mineraloel"), ("synthetic",)


def material_of(draft: Draft, gear: Component) -> str | None:
    """The material of a gear as an inline table; None: the file names none, and that of all gears holds."""
    sheet = draft.sheet
    found = sheet.model.related("reference", "origin", gear.number, "referenced", "material")
    if not found:
        return None
    designation = sheet.text(found[0], rexs.MATERIAL_NAME) or ""
    name = _SHIPPED.get("".join(filter(str.isalnum, designation)).lower(), "")
    table = {"title": text(designation or found[0].name or "a material of REXS")}
    table |= {key.key: value for key in rexs.MATERIAL if (value := sheet.toml(found[0], key)) is not None}
    lacking = [key.key for key in rexs.MATERIAL[:6] if key.key not in table]
    if name or lacking:
        table = {"like": text(name or TYPICAL_MATERIAL), **table}
    if lacking:
        draft.assumed.append(f"gear.{draft.name(gear)}.material: {', '.join(lacking)} of {table['like']}")
    treatment = sheet.text(found[0], rexs.TREATMENT)
    treated = {name: treatment for treatment, name in rexs.TREATMENTS.items()}.get(treatment or "")
    if treated is not None:
        table["treatment"] = text(treated)
    elif treatment is not None:
        sheet.leave(found[0], rexs.TREATMENT, "no such treatment in a scenario")
    return "{ " + ", ".join(f"{key} = {value}" for key, value in table.items()) + " }"


def put_lubricant(draft: Draft) -> None:
    """Write the oil; several oils are one too many."""
    sheet = draft.sheet
    oils = list(sheet.model.of_type("lubricant"))
    draft.table("[lubricant]", oils[0].name if oils else "")
    if not oils:
        draft.assume("like", text("iso-vg-220-mineral"))
        return
    oil = oils[0]
    for other in oils[1:]:
        draft.change(other, f"{oil} stands for all oils")
    draft.put("title", text(sheet.text(oil, rexs.OIL_NAME) or oil.name or "an oil of REXS"))
    named = {
        **{name: kind for kind, name in rexs.OIL_TYPES.items()},
        "non_water_soluble_polyglycol": "pag",
    }.get(sheet.text(oil, rexs.OIL_TYPE) or "")
    if named is None:
        basis = (sheet.text(oil, rexs.OIL_BASIS) or sheet.text(oil, rexs.OIL_KIND) or "").lower()
        named = "mineral" if basis in _MINERAL else "pao" if basis in _SYNTHETIC else None
    if (sheet.text(oil, rexs.OIL_KIND) or "").lower() == "grease":
        raise sheet.refused(
            oil, "is a grease: films and losses here are of oil", "name an oil", rexs.OIL_KIND.name
        )
    if named is None:
        draft.assume("type", text("mineral"))
    else:
        draft.put("type", text(named))
    viscosity = 1e6 * (sheet.si(oil, rexs.LUBRICANT[0]) or 220e-6)
    hot = 0.34 * viscosity**0.75  # mineral oils of ISO 3448 within 15 %
    for key, typical in zip(
        rexs.LUBRICANT, ("220 mm**2/s", f"{hot:.3g} mm**2/s", "0.89 g/cm**3"), strict=True
    ):
        value = sheet.toml(oil, key)
        if value is None:
            draft.assume(key.key, text(typical))
        draft.put(key.key, value)
    draft.suggest("fzg_micropitting_stage", "10")
