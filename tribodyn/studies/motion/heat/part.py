"""The part `heat` of the study: the thermal network of a gearbox."""

from tribodyn.studies.motion.heat.nodes import heat_of

HEAT = heat_of
