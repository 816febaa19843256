"""Machine code of kernels on disk: read from there or compiled, and brought into memory.

A file holds one kernel for one layout of its arguments: a line of JSON, then an object file as the platform's
linker would take it. Its name is a digest of everything that the code depends on: the source of the kernel
and of all that it imports, the versions of numba and llvmlite, the processor with all that it has, the
compiler's options, and the layout. The file also says what the code was compiled for. One that is damaged, is
for another processor or of other options, or needs a function that this process does not have, is compiled
again; what a process compiles under settings that the name does not have is not kept.
"""

import hashlib
import importlib.util
import json
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from tribodyn.errors import InputError, cut
from tribodyn.kernels.native.arguments import OPTIONS, Code, Compiled, Target, is_kept
from tribodyn.numerics.files.cache import kept_or_made
from tribodyn.numerics.files.sources import code_of, digest_of
from tribodyn.numerics.processes.libraries import without_file
from tribodyn.numerics.processes.work import announced

#: What turns any kernel into machine code.
_COMPILER = "tribodyn.kernels.native.compiler"
#: What is said meanwhile: it takes up to a minute, and its result is kept on disk.
COMPILING = "compiling, once for this kind of gearbox"


def machine_code(function: Callable[..., Any], layout: Any) -> Code:
    """Machine code of a function for arguments of a layout: from disk, else compiled and kept there.

    Raises InputError where nothing can be compiled, by a variable of the environment or the version of numba.
    """

    def made() -> tuple[Code, bytes | None]:
        with announced(COMPILING):
            code = _compiler()(function, layout)
        _refuse_foreign(code.target)
        loaded_code = loaded(code)
        assert loaded_code is not None  # made in this process
        return loaded_code, content_of(code) if code.target.fits(_target()) else None

    def kept(content: bytes) -> Code | None:
        code = compiled_in(content)
        return loaded(code) if code.target.fits(_target()) else None

    place = _place_of(function, layout)
    return kept_or_made(*place, kept, made) if place else made()[0]


def _compiler() -> Callable[..., Compiled]:
    """What compiles a kernel; imports numba, of whose internals it needs more than numba documents."""
    try:
        numba = without_file("numba")
    except ValueError as error:
        name = "NUMBA_NUM_THREADS"
        if name not in os.environ:
            raise
        remedy = "unset it, or set it to 1 or more"
        raise InputError(name, os.environ[name], "numba cannot be imported with it", remedy) from error
    if numba.config.DISABLE_JIT:
        rule = "switches off the compiler by which kernels are made"
        raise InputError("NUMBA_DISABLE_JIT", os.environ.get("NUMBA_DISABLE_JIT"), rule, "unset it")
    try:
        from tribodyn.kernels.native.compiler import compiled
    except (ImportError, AttributeError) as error:
        remedy = "install a version within the bounds of tribodyn's pyproject.toml"
        raise InputError("numba", numba.__version__, f"cannot compile kernels: {error}", remedy) from error
    return compiled


def _target() -> Target:
    """What numba compiles for in this process unless something other than variables says otherwise."""
    processor = os.environ.get("NUMBA_CPU_NAME") or llvm.get_host_cpu_name()
    features = os.environ.get("NUMBA_CPU_FEATURES")
    if features is None:
        features = "" if processor == "generic" else llvm.get_host_cpu_features().flatten()
    options = " ".join(os.environ.get(f"NUMBA_{name}", default) for name, default in OPTIONS.items())
    return Target(processor, features, options)


def _refuse_foreign(target: Target) -> None:
    """Raise InputError where code needs what this machine's processor lacks: it would end the process."""
    here = target._replace(features=llvm.get_host_cpu_features().flatten())
    if not target.fits(here):
        rule = "numba compiles for another processor, of which this one lacks features"
        remedy = "unset it, and import numba in a folder without .numba_config.yaml"
        raise InputError("NUMBA_CPU_FEATURES", cut(target.features, 80), rule, remedy)


@cache
def _digest(module: str) -> str:
    """Digest of a module's source and of all that it imports, of what compiles them, and of the processor."""
    numba = importlib.util.find_spec("numba")
    assert numba is not None
    assert numba.origin is not None
    digest = hashlib.sha256(Path(numba.origin).with_name("_version.py").read_bytes())
    switches = sorted(item for item in os.environ.items() if item[0].startswith("NUMBA_"))
    processor = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
    target = llvm.get_process_triple(), processor, tuple(_target())
    digest.update(repr((llvmlite.__version__, target, switches)).encode())
    digest.update(digest_of(module, _COMPILER))
    return digest.hexdigest()[:16]


def _place_of(function: Callable[..., Any], layout: Any) -> tuple[str, str] | None:
    """Folder of the cache and file; None where not all that the code depends on is in files."""
    source = Path(function.__code__.co_filename)
    if function.__closure__ or not source.is_file() or not is_kept(layout):
        return None
    digest = hashlib.sha256(repr(layout).encode() + code_of(source.read_bytes())).hexdigest()[:16]
    name = f"{function.__module__.removeprefix('tribodyn.')}.{function.__qualname__}-{digest}"
    return f"kernels-{_digest(function.__module__)}", name


def compiled_in(content: bytes) -> Compiled:
    """What a file of the cache holds."""
    head, _, body = content.partition(b"\n")
    header = json.loads(head)
    return Compiled(**header | {"target": Target(*header["target"])}, body=body)


def content_of(code: Compiled) -> bytes:
    """What a file of the cache holds of a kernel."""
    head = {name: value for name, value in code._asdict().items() if name != "body"}
    return json.dumps(head).encode() + b"\n" + code.body


#: What keeps code in memory: as long as the process lives.
_ENGINES: list[Any] = []


def loaded(code: Compiled) -> Code | None:
    """Bring code into memory; None if this process does not have all that it calls."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target = llvm.Target.from_triple(llvm.get_process_triple())
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target.create_target_machine(jit=True))
    if any(llvm.address_of_symbol(name) is None for name in code.needs):
        return None  # LLVM would end the process
    engine.add_object_file(llvm.ObjectFileRef.from_data(code.body))
    engine.finalize_object()
    _ENGINES.append(engine)
    return Code(engine.get_function_address(code.symbol), code.returns, code.single)
