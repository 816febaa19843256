"""Indices of arrays in kernels: those that are not constants count from the start.

numba lets every index count from the end where it is negative: four instructions of an access. What this
package compiles has no such index; functions from outside keep it.
"""

import operator
from typing import Any, cast

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import signature
from numba.extending import lower_builtin
from numba.np import arrayobj

#: How numba's names of functions of this package begin.
_OURS = "_ZN8tribodyn"


def _counted(kind: Any, value: Any) -> Any:
    """Type of an index, without a sign where it counts from the start."""
    return types.uint64 if kind is types.int64 and not isinstance(value, ir.Constant) else kind


def _in_package(builder: Any) -> bool:
    return builder.function.name.startswith(_OURS)


def _from_the_start(builder: Any, sig: Any, args: Any) -> Any:
    """The signature of an access to an array, with its indices as they count."""
    if not _in_package(builder):
        return sig
    array, index, *others = sig.args
    if isinstance(index, types.BaseTuple):
        values = cgutils.unpack_tuple(builder, args[1])
        index = types.Tuple([_counted(*one) for one in zip(cast(Any, index), values, strict=True)])
    else:
        index = _counted(index, args[1])
    return signature(sig.return_type, array, index, *others)


@lower_builtin(operator.getitem, types.Array, types.Integer)
def _at(context, builder, sig, args):
    """An element, or a part whose address is not taken apart.

    Else LLVM keeps and moves on an address for every quantity of a mesh's contacts that a loop over meshes
    uses, some forty, where one would do.
    """
    part = arrayobj.getitem_arraynd_intp(context, builder, _from_the_start(builder, sig, args), args)
    kind = sig.return_type
    whole = not isinstance(kind, types.Array) or kind.ndim < 2 or isinstance(args[1], ir.Constant)
    if whole or not _in_package(builder):
        return part
    view = context.make_array(kind)(context, builder, part)
    same = ir.FunctionType(view.data.type, [view.data.type])
    view.data = builder.asm(same, "", "=r,0", [view.data], False)
    return view._getvalue()


@lower_builtin(operator.getitem, types.Array, types.BaseTuple)
def _at_several(context, builder, sig, args):
    return arrayobj.getitem_array_tuple(context, builder, _from_the_start(builder, sig, args), args)


@lower_builtin(operator.setitem, types.Array, types.Integer, types.Any)
@lower_builtin(operator.setitem, types.Array, types.BaseTuple, types.Any)
def _put_at(context, builder, sig, args):
    return arrayobj.setitem_array(context, builder, _from_the_start(builder, sig, args), args)
