"""Kernels through numba to machine code, in one piece.

numba compiles every function that a kernel calls by itself: optimised with all that it calls in turn, and
turned into machine code that nobody runs. Here the functions are lowered one by one but optimised once, as
parts of the kernel that calls them, and the kernel alone becomes machine code.
"""

from collections.abc import Callable
from typing import Any, cast

import numba
from llvmlite import ir
from numba.core import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, Flags, compile_extra
from numba.core.compiler_lock import global_compiler_lock
from numba.core.cpu_options import FastMathOptions
from numba.core.registry import cpu_target
from numba.extending import overload, typeof_impl

from tribodyn.kernels.native.arguments import Record
from tribodyn.kernels.native.kernel import Kernel
from tribodyn.kernels.native.records import WORDS, RecordType, fields_of, letter_of, put
from tribodyn.kernels.native.store import Compiled

#: What LLVM may do with floats: make one rounding of a product and a sum.
FUSE = {"contract"}


class _NotLoaded:
    """What numba asks to connect loaded code with Python: nothing is loaded."""

    def set_env(self, name, environment):
        pass


class PartLibrary(JITCodeLibrary):
    """Code of a function that only kernels call: as lowered, to be optimised as part of the kernel."""

    @property
    def codegen(self) -> Any:
        """Where numba connects the code."""
        return _NotLoaded()

    def finalize(self):
        """Nothing is done by itself."""
        self._finalized = True

    def get_pointer_to_function(self, name):
        """No machine code: what numba says of a function that is not defined."""
        return 0

    def _get_module_for_linking(self):
        """The function and all that it calls."""
        if self._shared_module is None:
            module = _mergeable(self._final_module)
            for library in self._below({}):
                part = (
                    _mergeable(library._final_module)
                    if isinstance(library, PartLibrary)
                    else library._get_module_for_linking()
                )
                module.link_in(part, preserve=True)
            self._shared_module = module
        return self._shared_module

    def _below(self, found):
        for library in self._linking_libraries:
            if library not in found:
                found[library] = None
                if isinstance(library, PartLibrary):
                    library._below(found)
        return list(found)


def _mergeable(module):
    """A copy whose functions may be there several times and are left out where nobody calls them."""
    copy = module.clone()
    for function in copy.functions:
        if not function.is_declaration and function.linkage == type(function.linkage).external:
            function.linkage = "linkonce_odr"
    return copy


class PartCompiler(Compiler):
    """numba's compiler, for parts of kernels."""

    def __init__(self, typingctx, targetctx, library, args, return_type, flags, locals):
        if library is None:
            library = PartLibrary(targetctx.codegen(), "part")
        super().__init__(typingctx, targetctx, library, args, return_type, flags, locals)


#: Options of all that kernels consist of: no wrappers for Python, and no rewriting, which looks for array
#: expressions.
_PART: Any = {
    "pipeline_class": PartCompiler,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
    "no_rewrites": True,
}


def part(function: Callable[..., Any], forceinline: bool = False) -> Callable[..., Any]:
    """Decorator of a part of kernels, compiled into each that calls it."""

    @overload(function, jit_options=cast(Any, {**_PART, "forceinline": forceinline}), strict=False)
    def implementation(*args, **kwargs):
        return function

    return function


def part_instead(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator of what gives the part to compile in place of `function`, from the types of its arguments."""
    return overload(function, jit_options=_PART)


@typeof_impl.register(Kernel)
def _typeof_kernel(kernel, c):
    """Inside another kernel a kernel is a part as any other."""
    if not hasattr(kernel, "part"):
        kernel.part = cast(Any, numba.njit)(**_PART, error_model="numpy", fastmath=FUSE, _nrt=False)(
            kernel.function
        )
    return types.Dispatcher(kernel.part)


class KernelLibrary(JITCodeLibrary):
    """Code of a kernel with all its parts: optimised as one, and made an object file, which is not loaded."""

    def _finalize_final_module(self):
        self.body = self._codegen._tm.emit_object(self._final_module)
        self._finalized = True

    def needs(self) -> list[str]:
        """Names of the C functions that the code calls."""
        declared = (function.name for function in self._final_module.functions if function.is_declaration)
        found = set()
        for name in declared:
            if not name.startswith("llvm."):
                found.add(name)
            elif (family := name.split(".")[1]) in _C_FUNCTIONS:
                found.add(family)
        return sorted(found)


#: What LLVM calls by a name of its own and takes from the C library, unless the processor has it.
_C_FUNCTIONS = {
    "exp",
    "exp2",
    "log",
    "log2",
    "log10",
    "pow",
    "sin",
    "cos",
    "tan",
    "memcpy",
    "memmove",
    "memset",
}


def compiled(function: Callable[..., Any], layout: Record) -> Compiled:
    """Compile a function for arguments of a layout."""
    from tribodyn.kernels.native.functions import register_laws

    register_laws()
    kernel = Kernel(function)

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
    with global_compiler_lock:
        typing.refresh()
        target.refresh()
        arguments = (record, WORDS)
        lowered = compile_extra(typing, target, entry, arguments, types.none, flags, {}, library)
        symbol = f"tribodyn.{layout.name}"
        library.add_ir_module(_c_function(target, lowered.fndesc, symbol))
        library.finalize()
    kinds = tuple(kind for kind, _ in record.fields.values())
    returned = kernel.part.overloads[kinds].signature.return_type  # pyright: ignore[reportAttributeAccessIssue]
    several = isinstance(returned, types.BaseTuple)
    numbers = list(cast(Any, returned)) if several else () if returned is types.none else (returned,)
    return Compiled(symbol, "".join(map(letter_of, numbers)), not several, library.needs(), library.body)


def _c_function(target, described, symbol):
    """The entry as a C function of two pointers: what numba compiles has a convention of its own."""
    module = target.create_module("entry")
    kind = target.call_conv.get_function_type(described.restype, described.argtypes)
    inner = ir.Function(module, kind, described.llvm_func_name)
    places = [target.get_value_type(argument) for argument in described.argtypes]
    function = ir.Function(module, ir.FunctionType(ir.IntType(32), places), symbol)
    builder = ir.IRBuilder(function.append_basic_block())
    status, _ = target.call_conv.call_function(
        builder, inner, described.restype, described.argtypes, function.args
    )
    builder.ret(builder.zext(status.is_error, ir.IntType(32)))
    return module
