"""Constants of SKF's model of friction by type and series of bearings.

Catalogues 6000 EN (2008) and 10000 EN (2013), "Friction". Constants of deep groove ball bearings and of the
series 222 and 232 compared with public programs that quote them; the rest from memory.
"""

#: R_1, R_2, S_1, S_2 of deep groove ball bearings.
DEEP_GROOVE: dict[str, tuple[float, ...]] = {
    "62": (3.9e-7, 1.7, 3.23e-3, 36.5),
    "2": (4.4e-7, 1.7, 2.00e-3, 100.0),
    "3": (4.4e-7, 1.7, 2.00e-3, 100.0),
    "42": (5.4e-7, 0.96, 3.00e-3, 40.0),
    "43": (5.4e-7, 0.96, 3.00e-3, 40.0),
    "60": (4.1e-7, 1.7, 3.73e-3, 14.6),
    "630": (4.1e-7, 1.7, 3.73e-3, 14.6),
    "622": (3.9e-7, 1.7, 3.23e-3, 36.5),
    "63": (3.7e-7, 1.7, 2.84e-3, 92.8),
    "623": (3.7e-7, 1.7, 2.84e-3, 92.8),
    "64": (3.6e-7, 1.7, 2.43e-3, 198.0),
    "160": (4.3e-7, 1.7, 4.63e-3, 4.25),
    "161": (4.3e-7, 1.7, 4.63e-3, 4.25),
    **dict.fromkeys(("617", "618", "628", "637", "638"), (4.7e-7, 1.7, 6.50e-3, 0.78)),
    **dict.fromkeys(("619", "639"), (4.3e-7, 1.7, 4.75e-3, 3.6)),
}
#: R_1, R_2, R_3, S_1, S_2, S_3.
ANGULAR_CONTACT: dict[str, tuple[float, ...]] = {"": (5.03e-7, 1.97, 1.90e-12, 1.30e-2, 0.68, 1.91e-12)}
FOUR_POINT: dict[str, tuple[float, ...]] = {"": (4.78e-7, 2.42, 1.40e-12, 1.20e-2, 0.9, 1.40e-12)}
SELF_ALIGNING: dict[str, tuple[float, ...]] = {
    "12": (3.25e-7, 6.51, 2.43e-12, 4.36e-3, 9.33, 2.43e-12),
    "13": (3.11e-7, 5.76, 3.52e-12, 5.76e-3, 8.03, 3.52e-12),
    "22": (3.13e-7, 5.54, 3.12e-12, 5.84e-3, 6.60, 3.12e-12),
    "23": (3.11e-7, 3.87, 5.41e-12, 1.0e-2, 4.35, 5.41e-12),
}
#: R_1, S_1, S_2.
CYLINDRICAL: dict[str, tuple[float, ...]] = {
    "2": (1.09e-6, 0.16, 0.0015),
    "3": (1.09e-6, 0.16, 0.0015),
    "4": (1.00e-6, 0.16, 0.0015),
    "10": (1.12e-6, 0.16, 0.0015),
    "12": (1.23e-6, 0.16, 0.0015),
    "20": (1.23e-6, 0.16, 0.0015),
    "22": (1.40e-6, 0.16, 0.0015),
    "23": (1.48e-6, 0.16, 0.0015),
}
#: R_1, R_2, S_1, S_2.
TAPERED: dict[str, tuple[float, ...]] = {
    "302": (1.76e-6, 10.9, 0.017, 2.0),
    "303": (1.69e-6, 10.9, 0.017, 2.0),
    "313": (1.84e-6, 10.9, 0.048, 2.0),
    "320": (2.38e-6, 10.9, 0.014, 2.0),
    "322": (2.27e-6, 10.9, 0.018, 2.0),
    "323": (2.38e-6, 10.9, 0.019, 2.0),
    "329": (2.31e-6, 10.9, 0.009, 2.0),
    "330": (2.71e-6, 11.3, 0.010, 2.0),
    "331": (2.71e-6, 10.9, 0.015, 2.0),
    "332": (2.71e-6, 10.9, 0.018, 2.0),
}
#: R_1, R_2, R_3, R_4, S_1, S_2, S_3, S_4.
SPHERICAL: dict[str, tuple[float, ...]] = {
    "222": (1.6e-6, 5.84, 2.81e-6, 5.8, 3.62e-3, 508.0, 8.8e-3, 117.0),
    "213": (1.6e-6, 5.84, 2.81e-6, 5.8, 3.62e-3, 508.0, 8.8e-3, 117.0),
    "230": (2.4e-6, 6.44, 4.76e-6, 6.41, 4.13e-3, 755.0, 1.1e-2, 160.0),
    "231": (2.4e-6, 4.7, 4.84e-6, 4.7, 6.7e-3, 231.0, 1.7e-2, 65.0),
    "232": (2.3e-6, 4.1, 4.0e-6, 4.05, 8.66e-3, 126.0, 2.1e-2, 41.0),
    "239": (2.7e-6, 8.53, 3.87e-6, 8.47, 2.77e-3, 2330.0, 8.5e-3, 371.0),
    "240": (2.9e-6, 4.87, 4.78e-6, 4.84, 6.95e-3, 240.0, 2.1e-2, 68.0),
    "241": (2.6e-6, 3.8, 4.79e-6, 3.7, 1.0e-2, 86.7, 2.9e-2, 31.0),
}
#: R_1, R_2, S_1, S_2.
TOROIDAL: dict[str, tuple[float, ...]] = {
    "C22": (1.17e-6, 2.08e-6, 1.32e-3, 0.8e-2),
    "C23": (1.20e-6, 2.28e-6, 1.24e-3, 0.9e-2),
    "C30": (1.40e-6, 2.59e-6, 1.58e-3, 1.0e-2),
    "C31": (1.37e-6, 2.77e-6, 1.30e-3, 1.1e-2),
    "C32": (1.33e-6, 2.63e-6, 1.31e-3, 1.1e-2),
    "C39": (1.45e-6, 2.55e-6, 1.84e-3, 1.0e-2),
    "C40": (1.53e-6, 3.15e-6, 1.50e-3, 1.3e-2),
    "C41": (1.49e-6, 3.11e-6, 1.32e-3, 1.3e-2),
}
#: Constants by type and series; of a bearing without a series those of the first one.
CONSTANTS = {
    "deep-groove-ball": DEEP_GROOVE,
    "angular-contact-ball": ANGULAR_CONTACT,
    "four-point-contact-ball": FOUR_POINT,
    "self-aligning-ball": SELF_ALIGNING,
    "cylindrical-roller": CYLINDRICAL,
    "tapered-roller": TAPERED,
    "spherical-roller": SPHERICAL,
    "toroidal-roller": TOROIDAL,
}
#: K_Z of all, K_L of rollers, with cage.
SHAPES = {
    "deep-groove-ball": (3.1, 0.0),
    "angular-contact-ball": (4.4, 0.0),
    "four-point-contact-ball": (3.1, 0.0),
    "self-aligning-ball": (4.8, 0.0),
    "cylindrical-roller": (5.1, 0.65),
    "tapered-roller": (6.0, 0.7),
    "spherical-roller": (5.5, 0.8),
    "toroidal-roller": (5.3, 0.8),
}
#: Contact seals on both sides, by name: largest outside diameter, mm, and β, K_S1, K_S2.
SEALS = {
    "RSL": ((52.0, 2.25, 0.0018, 0.0),),
    "RSH": ((52.0, 2.25, 0.028, 2.0),),
    "RS1": (
        (62.0, 2.25, 0.023, 2.0),
        (80.0, 2.25, 0.018, 20.0),
        (100.0, 2.25, 0.018, 15.0),
        (float("inf"), 2.25, 0.018, 0.0),
    ),
    "LS": ((360.0, 2.0, 0.032, 50.0),),
    "CS": ((300.0, 2.0, 0.057, 50.0),),
}
