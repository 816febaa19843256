"""A writing process that is killed, at whatever moment, leaves a record that is right as far as it goes."""

import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

from tests.support.record_samples import block
from tribodyn.record.reader import Record

BLOCK, BLOCKS, KILLS = 50, 40, 24

#: Forks one writer after another and kills each: a third at any moment of its life, the others while samples
#: are written or the record is being finished.
WRITERS = """
import os, random, signal, sys, time
from pathlib import Path
from tests.support.record_samples import block, gear_pair_writer, geometry

folder, length, blocks, kills = Path(sys.argv[1]), *map(int, sys.argv[2:])
chance = random.Random(20220101)
samples = [block(i * length, (i + 1) * length) for i in range(blocks)]
for kill in range(kills):
    path = folder / f"{kill}.h5"
    child = os.fork()
    if child == 0:
        with gear_pair_writer(path, length * blocks, outlines=geometry()) as record:
            for i, values in enumerate(samples):
                record.write(i * length, values)
                time.sleep(0.0002)
            record.finish({"efficiency": 0.98})
        os._exit(0)
    if kill % 3:
        while not (folder / f"{kill}.partial.h5").exists() and not path.exists():
            time.sleep(0.0001)
    time.sleep(chance.uniform(0, 0.03))
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
"""


def test_what_a_killed_run_wrote_is_right(tmp_path: Path):
    command = [sys.executable, "-c", WRITERS, str(tmp_path), str(BLOCK), str(BLOCKS), str(KILLS)]
    subprocess.run(command, check=True, cwd=Path(__file__).parents[2], timeout=300)
    expected = block(0, BLOCK * BLOCKS)
    states = []
    for kill in range(KILLS):
        for path in tmp_path.glob(f"{kill}.*h5"):
            with h5py.File(path) as plain:
                status = plain.attrs["status"]
                assert status == ("partial" if path.name.endswith(".partial.h5") else "complete")
                assert plain["summary"].attrs.get("efficiency") == (0.98 if status == "complete" else None)
            with Record(path) as record:
                states.append((record.status, record.samples))
                assert record.samples % BLOCK == 0
                for name in record:
                    np.testing.assert_array_equal(
                        record[name], expected[name][: record.samples], err_msg=name
                    )
                assert record.mesh_cycle["pinion_teeth"] == 23
    written = [samples for status, samples in states if status == "partial"]
    assert any(0 < samples < BLOCK * BLOCKS for samples in written), "no kill fell into the writing"
