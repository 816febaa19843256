"""How soon the page shows a value that is set on its slider, in a browser, as ratios to the verb `run`.

Wall times, scaled to a machine on which the verb takes what it takes at rest: by its quickest run beside the
page's quickest answer of several.
"""

import subprocess
import sys
from time import perf_counter

import pytest

pytest.importorskip("nicegui")
pytest.importorskip("playwright")
from tests.support.design_page import UP_TO_DATE, browser, opened, served

pytestmark = pytest.mark.bench

#: Scenario -> the key of the slider, what finds it, the time of the verb on two cores at rest, s, and the
#: stages that are seen to change: outlines are drawn without reliefs.
DRAGGED = {
    "spur-25-51": ("drive.pinion.profile_shift", "profile shift", 0.9, ("geometry", "static", "motion")),
    "helical-23-47": ("drive.pinion.modification.tip_relief", "tip relief", 1.4, ("static", "motion")),
}
#: From the command to the teeth, and from the slider to what each stage changes, s.
FIRST, AT_MOST = 10.0, {"geometry": 0.1, "static": 0.3, "motion": 1.0}
#: Stage -> what is drawn anew in the page; curves are looked for in their chart, not in its words.
WATCHED = {
    "geometry": ".tb-teeth path.tb-body",
    "static": '[data-plot="te-static"]',
    "motion": '[data-plot="te-motion"]',
}
#: Sets a slider, and waits for the frame behind what each stage draws; s by stage.
TAKEN = """async ([key, share, watched]) => {
  const slider = document.querySelector(`[data-field="${key}"] input[type=range]`);
  const low = Number(slider.min), begun = performance.now();
  const drawn = Object.entries(watched).map(([stage, place]) => new Promise((done) => {
    const observer = new MutationObserver(() => {
      observer.disconnect();
      requestAnimationFrame(() => done([stage, (performance.now() - begun) / 1e3]));
    });
    observer.observe(document.querySelector(place), { attributes: true, childList: true, subtree: true });
  }));
  slider.value = low + share * (Number(slider.max) - low);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  return Object.fromEntries(await Promise.all(drawn));
}"""


def verb(name, folder) -> float:
    """Time of one run, s."""
    words = [sys.executable, "-m", "tribodyn", "run", name, "--no-plot", "--force", "-o", "a.h5"]
    begun = perf_counter()
    subprocess.run(words, cwd=folder, check=True, capture_output=True)
    return perf_counter() - begun


@pytest.mark.parametrize("name", DRAGGED)
def test_a_slider_moves_teeth_error_and_motion_in_time(name, tmp_path, capsys):
    key, words, at_rest, stages = DRAGGED[name]
    watched = {stage: WATCHED[stage] for stage in stages}
    runs = [verb(name, tmp_path) for _ in range(2)]
    taken: dict[str, list[float]] = {stage: [] for stage in stages}
    with browser() as chromium:
        begun = perf_counter()
        with served(tmp_path, name, "--folder", str(tmp_path)) as (address, _):
            page = opened(chromium, address, wait=False)
            page.wait_for_selector(WATCHED["geometry"])
            first = perf_counter() - begun
            page.wait_for_selector(UP_TO_DATE)
            page.get_by_label("Find a field").fill(words)
            page.wait_for_selector(f'[data-field="{key}"] input[type=range]')
            page.locator(WATCHED["static"]).scroll_into_view_if_needed()
            for share in (0.5137, 0.5619, 0.4873, 0.5391, 0.4417, 0.5277, 0.4651):
                for stage, seconds in page.evaluate(TAKEN, [key, share, watched]).items():
                    taken[stage].append(seconds)
                page.wait_for_selector(UP_TO_DATE)
                page.wait_for_timeout(800)  # charts out of sight are drawn
    runs += [verb(name, tmp_path) for _ in range(2)]
    scale = at_rest / min(runs)
    found = {stage: scale * min(times) for stage, times in taken.items()}
    with capsys.disabled():
        shown = ", ".join(f"{stage} {1e3 * time:.0f} ms" for stage, time in found.items())
        print(f"\n{name}: first picture {scale * first:.1f} s, {shown}; scaled by {scale:.2f}")
    assert scale * first < FIRST
    for stage, time in found.items():
        assert time < AT_MOST[stage], (stage, taken, runs)
