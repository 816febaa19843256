"""Whole numbers of the structure, which kernels are compiled for; hashable, as all that is static for JAX."""


class StaticInt(int):
    """A number that kernels are compiled for, e.g. the number of states, so that their loops are unrolled."""


class Indices(tuple[int, ...]):
    """Whole numbers by place, e.g. the bodies at the ends of links."""


class RuntimeIndices(tuple[int, ...]):
    """The same as kernels read them at run time; hashable, static for JAX."""
