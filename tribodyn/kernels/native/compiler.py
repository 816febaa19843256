"""Kernels through numba to machine code, in one piece.

numba compiles every function that a kernel calls by itself: optimised with all that it calls in turn, and
turned into machine code that nobody runs. Here the functions are lowered one by one but optimised once, as
parts of the kernel that calls them, and the kernel alone becomes machine code.
"""

import gc
import operator
import re
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, cast

from llvmlite import ir
from numba.core import cgutils, config, event, types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Flags, compile_extra
from numba.core.compiler_lock import global_compiler_lock
from numba.core.cpu_options import FastMathOptions
from numba.core.errors import NumbaError
from numba.core.registry import cpu_target
from numba.core.typing.templates import signature
from numba.extending import lower_builtin
from numba.np import arrayobj

from tribodyn.errors import InputError
from tribodyn.kernels.native.arguments import OPTIONS, Compiled, RecordLayout, Target, functions_in
from tribodyn.kernels.native.functions import register_laws
from tribodyn.kernels.native.parts import FUSE, as_part
from tribodyn.kernels.native.records import WORDS, RecordType, fields_of, letter_of, put

#: Instructions of a function that becomes part of its callers, and of one that is called at a single place.
#: LLVM alone counts loops over constants as if nothing in them were known, and leaves calls in them; and it
#: does not know that nothing else calls a function.
SMALL, SMALL_ONCE = 60, 160
_CALLED = re.compile(r'(?:call|invoke) [^@\n]*@"?([^"(\n]+)"?\(')


class KernelLibrary(JITCodeLibrary):
    """Code of a kernel with all its parts: optimised as one, and made an object file, which is not loaded."""

    def _optimize_final_module(self):
        calls = Counter(_CALLED.findall(str(self._final_module)))
        for function in self._final_module.functions:
            size = sum(1 for block in function.blocks for _ in block.instructions)
            small = SMALL_ONCE if calls[function.name] == 1 else SMALL
            if 0 < size <= small and b"noinline" not in list(function.attributes):
                function.add_function_attribute("alwaysinline")
        super()._optimize_final_module()

    def _finalize_final_module(self):
        self.body = self._codegen._tm.emit_object(self._final_module)
        self._finalized = True

    def needs(self) -> list[str]:
        """Names of the C functions that the code calls."""
        declared = (function.name for function in self._final_module.functions if function.is_declaration)
        names = set()
        for name in declared:
            if not name.startswith("llvm."):
                names.add(name)
            elif (family := name.split(".")[1]) in _C_FUNCTIONS:
                names.add(family)
        return sorted(names)


#: What LLVM calls by a name of its own and takes from the C library, unless the processor has it.
_C_FUNCTIONS = set("exp exp2 log log2 log10 pow sin cos tan memcpy memmove memset".split())


@contextmanager
def _in_less_time() -> Iterator[None]:
    """Type every call once, announce no step, and collect no garbage: nearly all lives until the end.

    numba asks for the type of each call four times and more, and goes through all that its function may mean;
    and it announces each of its 40 000 calls of LLVM.
    """
    known: dict[Any, Any] = {}
    collects, typed, told = gc.isenabled(), types.BaseFunction.get_call_type, event.broadcast

    def type_once(self: Any, context: Any, args: Any, kws: Any) -> Any:
        call = self, tuple(args), tuple(kws.items())
        if call not in known:
            known[call] = typed(self, context, args, kws)
        return known[call]

    gc.disable()
    types.BaseFunction.get_call_type = type_once
    event.broadcast = lambda event: None
    try:
        yield
    finally:
        types.BaseFunction.get_call_type = typed
        event.broadcast = told
        if collects:
            gc.enable()


# all of it under the lock: a thread that refreshes numba's tables hides types from one that compiles
@global_compiler_lock
@_in_less_time()
def compiled(function: Callable[..., Any], layout: RecordLayout) -> Compiled:
    """Compile a function for arguments of a layout."""
    register_laws()
    kernel = as_part(function)

    def entry(block, results):
        put(results, kernel(*fields_of(block)))

    # IEEE division, no reordering, but a product and a sum may be one rounding; none of numba's reference
    # counts, which would cost a quarter of the right-hand side: so a kernel is handed its buffers
    flags: Any = Flags()
    flags.nrt = False
    flags.error_model = "numpy"
    flags.fastmath = FastMathOptions(FUSE)
    flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
    flags.no_compile = True  # not before the C function is there
    typing, target = cast(Any, cpu_target.typing_context), cast(Any, cpu_target.target_context)
    record = RecordType(layout)
    library = KernelLibrary(target.codegen(), layout.name)
    typing.refresh()
    target.refresh()
    arguments = (record, WORDS)
    try:
        lowered = compile_extra(typing, target, entry, arguments, types.none, flags, {}, library)
    except NumbaError as error:
        raise explained(error, layout) from error
    symbol = f"tribodyn.{layout.name}"
    library.add_ir_module(_c_function(target, lowered.fndesc, symbol))
    library.finalize()
    kinds = tuple(kind for kind, _ in record.fields.values())
    returned = kernel.overloads[kinds].signature.return_type
    several = isinstance(returned, types.BaseTuple)
    numbers = list(cast(Any, returned)) if several else () if returned is types.none else (returned,)
    returns = "".join(map(letter_of, numbers))
    return Compiled(symbol, returns, not several, library.needs(), target_of(library.codegen), library.body)


def target_of(codegen: Any) -> Target:
    """What numba compiles for at present, by whoever has set it."""
    _, processor, features = codegen.magic_tuple()
    return Target(processor, features, " ".join(str(int(getattr(config, name))) for name in OPTIONS))


def explained(error: NumbaError, layout: RecordLayout) -> Exception:
    """Say of an error of numba's in a function from outside this package what its author can do about it."""
    outside = [
        part for part in functions_in(layout) if not (part.function.__module__ or "").startswith("tribodyn.")
    ]
    if not outside:
        return error
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    reasons = [line for line in lines if "Untyped global" in line or "Unknown attribute" in line]
    names = ", ".join(part.function.__qualname__ for part in outside)
    return InputError(
        "law",
        names,
        f"cannot be compiled: {(reasons or lines)[0]}",
        "use arithmetic, the functions of tribodyn.numerics.elementary, "
        "and functions marked with its `law`, and no fields but those of the arguments",
    )


def _c_function(target, descriptor, symbol):
    """The entry as a C function of two pointers: what numba compiles has a convention of its own."""
    module = target.create_module("entry")
    kind = target.call_conv.get_function_type(descriptor.restype, descriptor.argtypes)
    inner = ir.Function(module, kind, descriptor.llvm_func_name)
    places = [target.get_value_type(argument) for argument in descriptor.argtypes]
    function = ir.Function(module, ir.FunctionType(ir.IntType(32), places), symbol)
    builder = ir.IRBuilder(function.append_basic_block())
    status, _ = target.call_conv.call_function(
        builder, inner, descriptor.restype, descriptor.argtypes, function.args
    )
    builder.ret(builder.zext(status.is_error, ir.IntType(32)))
    return module


# Indices of arrays in kernels: those that are not constants count from the start.
#
# numba lets every index count from the end where it is negative: four instructions of an access. What this
# package compiles has no such index; functions from outside keep it.


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


def _place(context, builder, sig, args):
    """Address of an element by whole numbers, which LLVM makes of numba's code too; None where it is numba's.

    That is a fifth of what numba emits, and most of a kernel is elements of arrays.
    """
    array, index, *_ = sig.args
    several = isinstance(index, types.BaseTuple)
    kinds = list(cast(Any, index)) if several else [index]
    values = cgutils.unpack_tuple(builder, args[1]) if several else [args[1]]
    if not _in_package(builder) or len(kinds) != array.ndim:
        return None
    if any(not isinstance(kind, types.Integer) for kind in kinds):
        return None
    if any(isinstance(value, ir.Constant) and value.constant < 0 for value in values):
        return None
    model = context.data_model_manager[array]
    data, shape, strides = (model.get(builder, args[0], name) for name in ("data", "shape", "strides"))
    whole = [context.cast(builder, *one, types.intp) for one in zip(values, kinds, strict=True)]
    return cgutils.get_item_pointer2(
        context,
        builder,
        data,
        cgutils.unpack_tuple(builder, shape),
        cgutils.unpack_tuple(builder, strides) if array.layout == "A" else [],
        array.layout,
        whole,
    )


@lower_builtin(operator.getitem, types.Array, types.Integer)
def _at(context, builder, sig, args):
    """An element, or a part whose address is not taken apart.

    Else LLVM keeps and moves on an address for every quantity of a mesh's contacts that a loop over meshes
    uses, some forty, where one would do.
    """
    if (place := _place(context, builder, sig, args)) is not None:
        return arrayobj.load_item(context, builder, sig.args[0], place)
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
    if (place := _place(context, builder, sig, args)) is not None:
        return arrayobj.load_item(context, builder, sig.args[0], place)
    return arrayobj.getitem_array_tuple(context, builder, _from_the_start(builder, sig, args), args)


@lower_builtin(operator.setitem, types.Array, types.Integer, types.Any)
@lower_builtin(operator.setitem, types.Array, types.BaseTuple, types.Any)
def _put_at(context, builder, sig, args):
    if (place := _place(context, builder, sig, args)) is not None:
        array, _, kind = sig.args
        value = context.cast(builder, args[2], kind, array.dtype)
        arrayobj.store_item(context, builder, array, value, place)
        return None
    return arrayobj.setitem_array(context, builder, _from_the_start(builder, sig, args), args)
