"""Arrays of dual numbers: floats whose last axis holds a number's slopes, its value, and room behind it."""

from tribodyn.kernels.duals.numbers import DIRECTIONS, DOUBLE, DUAL, SLOPES, made, taken_apart
from tribodyn.kernels.lanes.arrays import ALIGNMENT, Element, elements_of
from tribodyn.kernels.lanes.vectors import INT64

#: Place of the value behind the slopes, and floats that a dual number takes: whole cache lines, so that none
#: is read across two where the array begins on one.
VALUE, LENGTH = DIRECTIONS, DIRECTIONS + 8


def _load(context, builder, pointer):
    slope = builder.load(builder.bitcast(pointer, SLOPES.as_pointer()), align=ALIGNMENT)
    return made(context, builder, builder.load(builder.gep(pointer, [INT64(VALUE)])), slope)


def _store(context, builder, pointer, number):
    value, slope = taken_apart(context, builder, DUAL, number)
    builder.store(slope, builder.bitcast(pointer, SLOPES.as_pointer()), align=ALIGNMENT)
    last = builder.gep(pointer, [INT64(VALUE)])
    builder.store(value, builder.bitcast(last, DOUBLE.as_pointer()), align=ALIGNMENT)


#: An array of floats, contiguous and its last axis of `LENGTH`, as dual numbers.
duals_of = elements_of(Element(DUAL, LENGTH, _load, _store))
