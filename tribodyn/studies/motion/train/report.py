"""What a sweep keeps of a train."""

from tribodyn.studies.motion.report import swept_of

SWEPT = swept_of(named=True)
