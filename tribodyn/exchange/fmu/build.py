"""Shared libraries of an FMU for Linux, Windows and macOS, by the compiler of the package ziglang."""

import struct
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from tribodyn.errors import InputError, OutputError, quoted
from tribodyn.numerics.processes.child import run_program
from tribodyn.numerics.processes.work import in_threads, usable_cores


class Platform(NamedTuple):
    """A platform by its names in FMUs."""

    target: str  # as the compiler names it
    ending: str
    fmi3: str
    fmi2: str  # "": the standard has no name for it


#: glibc of 2012, so that the libraries run on any Linux of today.
PLATFORMS: Mapping[str, tuple[Platform, ...]] = {
    "linux": (
        Platform("x86_64-linux-gnu.2.17", ".so", "x86_64-linux", "linux64"),
        Platform("aarch64-linux-gnu.2.17", ".so", "aarch64-linux", ""),
    ),
    "windows": (Platform("x86_64-windows-gnu", ".dll", "x86_64-windows", "win64"),),
    "macos": (
        Platform("x86_64-macos.11.0", ".dylib", "x86_64-darwin", "darwin64"),
        Platform("aarch64-macos.11.0", ".dylib", "aarch64-darwin", "darwin64"),
    ),
}
#: In place of platforms: sources alone.
NONE = "none"
_FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-shared", "-fPIC", "-g0", "-s")
#: Longest time in which a library is compiled, s.
_LIMIT = 600.0
#: Types of processors in Mach-O files, and the alignment of their parts, a power of 2.
_PROCESSORS, _ALIGNMENT = {"x86_64": (0x01000007, 3), "aarch64": (0x0100000C, 0)}, 14


def chosen_platforms(text: str) -> tuple[Platform, ...]:
    """Platforms by a list of names: "linux,windows", or one like "x86_64-linux"; InputError for others.

    Also where there is no compiler for them.
    """
    single = {each.fmi3: (each,) for several in PLATFORMS.values() for each in several}
    known = {**PLATFORMS, **single}
    found: list[Platform] = []
    for name in text.split(",") if text != NONE else ():
        if name.strip() not in known:
            rule = f"no such platform: one or more of {', '.join(known)}; or {NONE}, for sources alone"
            raise InputError("platforms", quoted(name.strip()), rule, 'write it like "linux,windows,macos"')
        found += [each for each in known[name.strip()] if each not in found]
    if found:
        _compiler()
    return tuple(found)


def binaries(
    files: Mapping[str, str],
    compiled: Sequence[str],
    identifier: str,
    platforms: Sequence[Platform],
    version: str,
) -> dict[str, bytes]:
    """Libraries by their paths in the FMU. OutputError where they cannot be compiled."""
    if not platforms:
        return {}
    compiler = _compiler()
    libraries: dict[Platform, bytes] = {}
    with TemporaryDirectory(prefix="tribodyn-fmu-") as name:
        folder = Path(name)
        for file, content in files.items():
            (folder / file).write_text(content, encoding="utf-8", newline="\n")

        def compile_for(platform: Platform) -> None:
            library = folder / platform.fmi3 / f"{identifier}{platform.ending}"
            library.parent.mkdir()
            libraries[platform] = _compiled(compiler, [folder / file for file in compiled], library, platform)

        in_threads(compile_for, platforms, usable_cores())
    built: dict[str, bytes] = {}
    for platform in platforms:
        place = platform.fmi3 if version == "3.0" or not platform.fmi2 else platform.fmi2
        path, library = f"binaries/{place}/{identifier}{platform.ending}", libraries[platform]
        built[path] = both_processors(built[path], library) if path in built else library
    return built


def _compiler() -> Path:
    found = find_spec("ziglang")
    for folder in (found.submodule_search_locations or ()) if found is not None else ():
        for name in ("zig", "zig.exe"):
            if (Path(folder) / name).is_file():
                return Path(folder) / name
    rule = "the compiler for Linux, Windows and macOS is not installed"
    raise InputError("platforms", None, rule, f"pip install tribodyn[fmu], or write platforms = {NONE}")


def _compiled(compiler: Path, sources: Sequence[Path], library: Path, platform: Platform) -> bytes:
    """The library of a platform."""
    more = ["-lm"] if platform.ending == ".so" else []
    if platform.ending == ".dylib":
        more = [f"-Wl,-install_name,@rpath/{library.name}"]
    command = [str(compiler), "cc", "-target", platform.target, *_FLAGS, *map(str, sources)]
    try:
        done = run_program([*command, "-o", str(library), *more], _LIMIT)
    except (OSError, TimeoutError) as error:
        raise OutputError(f"binaries/{platform.fmi3}", f"the compiler could not be run: {error}") from None
    if done.returncode != 0 or not library.is_file():
        lines = done.stderr.strip().splitlines() or ["no message"]
        raise OutputError(f"binaries/{platform.fmi3}", f"the compiler failed: {lines[0]}")
    return library.read_bytes()


def both_processors(intel: bytes, arm: bytes) -> bytes:
    """One library for macOS of two: a universal binary."""
    header, offset, content = struct.pack(">II", 0xCAFEBABE, 2), 1 << _ALIGNMENT, b""
    for library, (kind, variant) in zip((intel, arm), _PROCESSORS.values(), strict=True):
        start = offset + len(content)
        header += struct.pack(">IIIII", kind, variant, start, len(library), _ALIGNMENT)
        content += library + b"\0" * (-len(library) % (1 << _ALIGNMENT))
    return header + b"\0" * (offset - len(header)) + content
