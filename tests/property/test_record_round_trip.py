"""Whatever is written into a record, in whatever blocks, comes back."""

import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from tests.support.record_samples import block, gear_pair_writer, geometry
from tribodyn.errors import harmless
from tribodyn.record.open_record import harmless_data
from tribodyn.record.reader import Record

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)
SCALARS = st.one_of(
    st.booleans(),
    st.integers(-(2**62), 2**62),
    st.floats(allow_nan=False),
    st.text(st.characters(codec="utf-8", exclude_characters="\0")),
)
NAMES = st.text("abcdefghij_", min_size=1, max_size=12)
SUMMARIES = st.dictionaries(
    NAMES, st.one_of(SCALARS, st.dictionaries(NAMES, SCALARS, min_size=1)), max_size=6
)


@settings(max_examples=15, deadline=None)
@given(st.lists(st.integers(1, 7), max_size=6), st.data())
def test_samples_come_back(lengths: list[int], data: st.DataObject):
    total = sum(lengths)
    load = data.draw(arrays.arrays(float, (total, 2), elements=NUMBERS))
    with tempfile.TemporaryDirectory() as folder:
        with gear_pair_writer(Path(folder) / "run.h5", total, outlines=geometry()) as record:
            start = 0
            for length in lengths:
                stop = start + length
                record.write(start, block(start, stop) | {"normal_load": load[start:stop]})
                start = stop
            path = record.finish({})
        with Record(path) as record:
            np.testing.assert_array_equal(record["normal_load"], load)
            np.testing.assert_array_equal(record["velocity"], block(0, total)["velocity"])


@settings(max_examples=15, deadline=None)
@given(SUMMARIES, st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=200))
def test_summary_and_scenario_come_back(summary: dict, scenario: str):
    with tempfile.TemporaryDirectory() as folder:
        with gear_pair_writer(Path(folder) / "run.h5", 1, scenario_toml=scenario) as record:
            record.write(0, block(0, 1))
            path = record.finish(summary)
        with Record(path) as record:
            assert record.summary == harmless_data(summary)
            assert record.attrs["scenario"] == harmless(scenario)
