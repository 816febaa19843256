"""What a sweep keeps of a pair."""

from tribodyn.studies.motion.report import swept_of

SWEPT = swept_of(named=False)
