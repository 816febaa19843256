"""The tests as on other machines: other BLAS kernels, vector widths, targets of compilers, threads and load.

Each configuration runs all tests, one after the other, with a cache for what the compilers' target makes::

    python -m tools.elsewhere --write                 # all; their rows into docs/development.md
    python -m tools.elsewhere nehalem busy --write    # these; the other rows stay
    python -m tools.elsewhere nehalem --tests tests/unit/solve

A configuration that needs what this processor does not have is left out. Logs: .cache/elsewhere/NAME.txt.
"""

import json
import os
import re
import subprocess
import sys
import time
from datetime import date
from pathlib import Path
from typing import NamedTuple

from tools.marked_block import DOCS, ROOT, parser_of, put

PAGE = DOCS / "development.md"
KEPT = ROOT / ".cache" / "elsewhere"


class Configuration(NamedTuple):
    """Settings under which all tests run; empty: as on this machine."""

    blas: str = ""  # processor whose kernels OpenBLAS takes
    target: str = ""  # processor that numba compiles for
    numpy_without: str = ""  # instruction sets that NumPy does without
    xla_up_to: str = ""  # largest instruction set in XLA's programs
    glibc: str = ""  # changes to what the functions of the C library use
    threads: int = 1  # of the BLAS
    loops: int = 0  # busy loops beside the tests
    needs: str = ""  # what the processor must have, as /proc/cpuinfo names it

    def environment(self) -> dict[str, str]:
        """Return the environment of the tests."""
        given = {
            "OPENBLAS_CORETYPE": self.blas,
            "NUMBA_CPU_NAME": self.target,
            "NPY_DISABLE_CPU_FEATURES": self.numpy_without,
            "GLIBC_TUNABLES": self.glibc and f"glibc.cpu.hwcaps={self.glibc}",
            "OPENBLAS_NUM_THREADS": str(self.threads),
            "TRIBODYN_CACHE": self.target and str(KEPT / self.target),
        }
        features = {"NUMBA_CPU_FEATURES": ""} if self.target else {}  # the target's own, not this machine's
        return os.environ | {name: value for name, value in given.items() if value} | features


NO_WIDE = "-AVX512F,-AVX512VL,-AVX512BW,-AVX512DQ"
CONFIGURATIONS = {
    "nehalem": Configuration(
        "Nehalem", "generic", "X86_V3 X86_V4 AVX512_ICL", "SSE4_2", f"-FMA,-FMA4,-AVX2,-AVX,{NO_WIDE}"
    ),
    "haswell": Configuration("Haswell", "haswell", "X86_V4 AVX512_ICL", "AVX2", NO_WIDE, needs="avx2"),
    "zen": Configuration("Zen", numpy_without="X86_V4 AVX512_ICL", glibc=NO_WIDE, threads=4, needs="avx2"),
    "skylake": Configuration("SkylakeX", numpy_without="AVX512_ICL", threads=4, needs="avx512vl"),
    "busy": Configuration(loops=2),
}
#: What the libraries report of themselves.
PROBE = """
import ctypes, json, numpy, scipy.linalg
from numba.core.registry import cpu_target
from numpy._core._multiarray_umath import __cpu_features__ as there
names = ("scipy_openblas_get_corename64_", "scipy_openblas_get_corename", "openblas_get_corename")
blas = set()
for path in {line.split()[-1] for line in open("/proc/self/maps") if "openblas" in line}:
    library = ctypes.CDLL(path)
    function = next((getattr(library, name) for name in names if hasattr(library, name)), None)
    if function:
        function.restype = ctypes.c_char_p
        blas.add(function().decode())
wide = [name for name in ("X86_V2", "X86_V3", "X86_V4", "AVX512_ICL", "AVX512_SPR") if there.get(name)]
target = cpu_target.target_context.codegen()._get_host_cpu_name()
print(json.dumps(["/".join(sorted(blas)), wide[-1] if wide else "", target]))
"""
HEAD = "configuration | BLAS | NumPy | numba | XLA | threads | busy loops | passed | failed | min | on | of"


def row(name: str, chosen: Configuration, tests: str) -> tuple[str, bool]:
    """Run the tests under a configuration; its row of the table, and whether all passed."""
    KEPT.mkdir(parents=True, exist_ok=True)
    environment = chosen.environment()
    found = json.loads(subprocess.check_output([sys.executable, "-c", PROBE], env=environment, text=True))
    command = ["make", "--no-print-directory", "in-parallel", f"CHOSEN={tests}"]
    if chosen.xla_up_to:
        command += [f"TESTS_XLA=--xla_cpu_use_fusion_emitters=false --xla_cpu_max_isa={chosen.xla_up_to}"]
    log = KEPT / f"{name}.txt"
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(chosen.loops)]
    begun = time.monotonic()
    try:
        with log.open("wb") as stream:
            ended = subprocess.run(
                command, env=environment, cwd=ROOT, stdout=stream, stderr=stream, check=False
            )
    finally:
        for loop in loops:
            loop.kill()
    minutes = (time.monotonic() - begun) / 60
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    ended_how = re.findall(r"(\d+) (passed|failed|error)", "\n".join(lines[-3:]))
    counts = {how: int(many) for many, how in ended_how}
    sys.stdout.writelines(f"{line}\n" for line in lines if line.startswith(("FAILED", "ERROR")))
    version = subprocess.check_output(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, text=True).strip()
    cells = [*found[:3], chosen.xla_up_to, chosen.threads, chosen.loops, counts.get("passed", 0)]
    cells += [counts.get("failed", 0) + counts.get("error", 0), f"{minutes:.1f}", date.today(), version]
    return f"| `{name}` | {' | '.join(map(str, cells))} |", ended.returncode == 0


def table(rows: dict[str, str]) -> str:
    """Rows in the order of the configurations, with those of the page that were not run now."""
    page = re.findall(r"^(\| `(\w+)` \|.*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    known = {name: line for line, name in page} | rows
    lines = [known[name] for name in CONFIGURATIONS if name in known]
    return "\n".join([f"| {HEAD} |", "|---" * (HEAD.count("|") + 1) + "|", *lines])


def main() -> None:
    """Run what the command line names, and print or write the table."""
    parser = parser_of(__doc__)
    parser.add_argument("names", nargs="*", choices=[[], *CONFIGURATIONS], metavar="CONFIGURATION")
    parser.add_argument("--tests", default="", help="paths and options of pytest")
    parser.add_argument("--write", action="store_true", help=f"into {PAGE.relative_to(ROOT)}")
    given = parser.parse_args()
    cpuinfo = Path("/proc/cpuinfo")
    features = cpuinfo.read_text(encoding="utf-8").split() if cpuinfo.is_file() else []
    rows, green = {}, True
    for name in given.names or CONFIGURATIONS:
        chosen = CONFIGURATIONS[name]
        if chosen.needs and chosen.needs not in features:
            sys.stdout.write(f"{name}: this processor has no {chosen.needs}\n")
            continue
        rows[name], passed = row(name, chosen, given.tests)
        green &= passed
        sys.stdout.write(f"{rows[name]}\n")
        sys.stdout.flush()
        if given.write and not given.tests:
            put(PAGE, "elsewhere", table(rows))
    sys.exit(not green)


if __name__ == "__main__":
    main()
