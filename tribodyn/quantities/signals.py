"""Numbers of the signals of sensors, `sensors/NAME/…` in a summary: of a signal, and of a shaft's average."""

from tribodyn.quantities.quantity import Quantity

#: In the unit of the signal, or without one.
OF_SIGNAL = (
    Quantity("rms", "RMS").defined_as("Root mean square of a signal about its mean."),
    Quantity("peak_to_peak", "Peak to peak").defined_as("Maximum less minimum of a signal."),
    Quantity("crest_factor", "Crest factor", digits=".3g").defined_as(
        "Largest magnitude of a signal about its mean over its RMS: √2 of a sine."
    ),
    Quantity("kurtosis", "Kurtosis", digits=".3g").defined_as(
        "Fourth moment of a signal about its mean over the square of the second: 1.5 of a sine, 3 of noise."
    ),
)
OF_SHAFT = (
    Quantity("turns", "Turns averaged", digits="d").defined_as(
        "Whole turns of a shaft in the signal, over which its synchronous average is taken."
    ),
    Quantity("fm0", "FM0", digits=".3g").defined_as(
        "Peak to peak of the synchronous average over the sum of the amplitudes of its mesh harmonics."
    ),
    Quantity("fm4", "FM4", digits=".3g").defined_as(
        "Kurtosis of the difference signal: the average without mesh harmonics and their first sidebands."
    ),
    Quantity("m6a", "M6A", digits=".3g").defined_as(
        "Sixth moment of the difference signal over the cube of the second: 15 of noise."
    ),
    Quantity("na4", "NA4", digits=".3g").defined_as(
        "Fourth moment of the residual, the average without mesh harmonics, over the square of the second; "
        "of one record alone."
    ),
    Quantity("energy_ratio", "Energy ratio", digits=".3g").defined_as(
        "RMS of the difference signal over that of the rest of the average."
    ),
    Quantity("sideband_level_factor", "Sideband level factor", digits=".3g").defined_as(
        "Amplitudes of the first sidebands of the mesh frequency over the RMS of the average."
    ),
    Quantity("sideband_energy_ratio", "Sideband energy ratio", digits=".3g").defined_as(
        "Amplitudes of six sidebands on either side of the mesh frequency over that of the mesh."
    ),
)
QUANTITIES = (*OF_SIGNAL, *OF_SHAFT)
