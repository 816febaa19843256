"""Files of settings in the current folder, and variables, that change what libraries do: none is taken."""

import json
import os
import subprocess
import sys
from pathlib import Path

import llvmlite.binding as llvm
import pytest

from tests.support.soak_parameters import all_in_soak
from tribodyn.kernels.native import store

COMMAND = "import sys; from tribodyn.cli import main; sys.exit(main())"
#: Values that numba, matplotlib, ezdxf, JAX, XLA or Dask refuse, print endlessly for, or end the process for.
VARIABLES = {
    "NUMBA_OPT": "none",
    "NUMBA_DUMP_LLVM": "1",
    "MPLBACKEND": "none",
    "EZDXF_CONFIG_FILE": "ezdxf.ini",
    "JAX_ENABLE_X64": "none",
    "XLA_FLAGS": "--no_such_flag=1",
    "SOURCE_DATE_EPOCH": "none",
    "DASK_DISTRIBUTED__LOGGING": "3",
}
#: A kernel in a file, compiled from Python, and what the file of the cache says it was compiled for.
SCRIPT = """
from tribodyn.kernels.native import kernel

@kernel
def half(x):
    return 0.5 * x

assert half(3.0) == 1.5
"""
FOREIGN = next(name for name, there in llvm.get_host_cpu_features().items() if not there)
CONFIGURATIONS = {
    "other options": "opt: '1'\ndump_llvm: 1\n",
    "no YAML": "a: [\n",
    "numba imported before": f"cpu_features: '+{FOREIGN}'\n",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder whose files of settings cannot be read."""
    folder = tmp_path_factory.mktemp("planted")
    for name in (".numba_config.yaml", "matplotlibrc", "ezdxf.ini"):
        (folder / name).write_bytes(b"\xff\xfe[")
    return folder


def ended(folder: Path, *words: str, **variables: str) -> "subprocess.CompletedProcess[str]":
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2]), **variables}
    command = [sys.executable, "-P", *words]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=300
    )


#: A run is computed by kernels and draws its overview, in a child where there are two cores; a drawing.
VERBS = (
    ("run", "irefc", "-o", "one.h5", "--force", "--set", "output.samples_per_cycle=8"),
    ("gear", "involute-18-36", "-o", "drawings"),
)
#: Pictures of the record that the first leaves.
PLOTS = ("plot", "one.h5", "--force"), ("plot", "one.h5", "-o", "one.pdf")


@pytest.mark.parametrize("verbs", all_in_soak([VERBS, VERBS + PLOTS], [VERBS]))
def test_no_verb_takes_them(verbs: tuple[tuple[str, ...], ...], folder: Path):
    for words in verbs:
        run = ended(folder, "-c", COMMAND, *words, **VARIABLES)
        assert (run.returncode, run.stderr) == (0, ""), words


@pytest.mark.slow
@pytest.mark.soak
def test_a_cluster_takes_none(folder: Path):
    """Nor does JAX in this process."""
    words = "sweep efficiency-involute-18-36 --vary operating.gear_torque=100:200:100N*m --engine dask"
    run = ended(folder, "-c", COMMAND, *words.split(), "--workers", "1", "-o", "sweep.h5", **VARIABLES)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize("name", CONFIGURATIONS)
def test_machine_code_is_of_this_processor(name: str, tmp_path: Path):
    pytest.importorskip("yaml", reason="without which numba reads no file")
    (tmp_path / ".numba_config.yaml").write_text(CONFIGURATIONS[name], encoding="utf-8")
    first = "import numba\n" if name == "numba imported before" else ""
    (tmp_path / "half.py").write_text(first + SCRIPT, encoding="utf-8")
    run = ended(tmp_path, "half.py", TRIBODYN_CACHE=str(tmp_path / "cache"))
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    (file,) = (tmp_path / "cache").glob("kernels-*/*")
    assert json.loads(file.read_bytes().splitlines()[1])["target"] == list(store._target())


def test_a_compiler_set_for_another_processor_is_refused(tmp_path: Path):
    """It would end the process by a signal."""
    (tmp_path / "half.py").write_text(SCRIPT, encoding="utf-8")
    variables = {"TRIBODYN_CACHE": str(tmp_path / "cache"), "NUMBA_CPU_FEATURES": f"+{FOREIGN}"}
    run = ended(tmp_path, "half.py", **variables)
    assert run.returncode == 1
    assert f"NUMBA_CPU_FEATURES = +{FOREIGN}: numba compiles for another processor" in run.stderr
    assert not list((tmp_path / "cache").glob("kernels-*/*"))


def test_code_of_other_options_is_neither_kept_nor_loaded(tmp_path: Path):
    """Set from Python, where no variable says so."""
    cache = str(tmp_path / "cache")
    script = tmp_path / "half.py"
    script.write_text("import numba\nnumba.core.config.OPT = numba.core.config._OptLevel(1)\n" + SCRIPT)
    assert ended(tmp_path, "half.py", TRIBODYN_CACHE=cache).returncode == 0
    assert not list((tmp_path / "cache").glob("kernels-*/*"))
