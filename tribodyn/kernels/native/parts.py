"""Parts of kernels: functions that numba lowers one by one, optimised within the kernel that calls them."""

from collections.abc import Callable
from functools import cache
from typing import Any, cast

import numba
from numba.core import types
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import PassManager
from numba.core.typed_passes import (
    NativeLowering,
    NoPythonBackend,
    NopythonTypeInference,
    PreLowerStripPhis,
)
from numba.core.untyped_passes import FixupArgs, IRProcessing, ReconstructSSA, TranslateByteCode
from numba.extending import overload

#: What LLVM may do with floats: make one rounding of a product and a sum.
FUSE = {"contract"}


class _NotLoaded:
    """What numba calls to connect loaded code with Python: nothing is loaded."""

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
            # callers first: of what nothing calls yet LLVM leaves out what may be merged
            for library in reversed(self._below({})):
                part = (
                    _mergeable(library._final_module)
                    if isinstance(library, PartLibrary)
                    else library._get_module_for_linking()
                )
                module.link_in(part, preserve=True)
            self._shared_module = module
        return self._shared_module

    def _below(self, libraries):
        """All that the function calls, each behind what it calls itself."""
        for library in self._linking_libraries:
            if library not in libraries:
                if isinstance(library, PartLibrary):
                    library._below(libraries)
                libraries[library] = None
        return list(libraries)


def _mergeable(module):
    """A copy whose functions may be there several times and are left out where nobody calls them."""
    copy = module.clone()
    for function in copy.functions:
        if not function.is_declaration and function.linkage == type(function.linkage).external:
            function.linkage = "linkonce_odr"
    return copy


#: Of numba's passes those that a function of this package needs. The others are for closures, `with`, `raise`
#: and tuples of several types, and look for them in vain, or say where a variable ends, for reference counts.
_PASSES = (
    TranslateByteCode,
    FixupArgs,
    IRProcessing,
    ReconstructSSA,
    NopythonTypeInference,
    PreLowerStripPhis,
    NativeLowering,
    NoPythonBackend,
)


@cache
def _passes() -> Any:
    manager: Any = PassManager("part")
    for each in _PASSES:
        manager.add_pass(each, each.__name__)
    manager.finalize()
    return manager


class PartCompiler(Compiler):
    """numba's compiler, for parts of kernels."""

    def define_pipelines(self):
        """Those of `_PASSES` for this package's functions, all of numba's for functions from outside."""
        if cast(Any, self.state).func_id.modname.startswith("tribodyn."):
            return [_passes()]
        return super().define_pipelines()

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


def part(
    function: Callable[..., Any],
    forceinline: bool = False,
    implementation: Callable[..., Any] | None = None,
) -> Callable[..., Any]:
    """Decorator of a part of kernels, compiled into each that calls it; or its `implementation` is."""

    @overload(function, jit_options=cast(Any, {**_PART, "forceinline": forceinline}), strict=False)
    def _(*args, **kwargs):
        return implementation or function

    return function


def part_instead(function: Callable[..., Any]) -> Callable[..., Any]:
    """Decorator of what gives the part to compile in place of `function`, from the types of its arguments."""
    return overload(function, jit_options=_PART, strict=False)


@cache
def as_part(function: Callable[..., Any]) -> Any:
    """A function as numba's dispatcher of a part; see `part`, which numba looks up by the function itself."""
    return cast(Any, numba.njit)(**_PART, error_model="numpy", fastmath=FUSE, _nrt=False)(function)


def type_of_part(function: Callable[..., Any]) -> Any:
    """The type of that to numba."""
    return types.Dispatcher(as_part(function))


def part_for(function: Callable[..., Any], kind: Any) -> Callable[..., Any]:
    """Decorator of what to compile in place of `function` where an argument is of a type, or such a type."""
    of_kind = (lambda one: isinstance(one, kind)) if isinstance(kind, type) else (lambda one: one == kind)

    def given(implementation):
        @part_instead(function)
        def _(*arguments):
            return implementation if any(map(of_kind, arguments)) else None

        return implementation

    return given
