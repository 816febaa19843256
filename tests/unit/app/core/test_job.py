"""A verb as a job: what it prints, its progress, its files, and its end before its time."""

from time import monotonic, sleep

from tests.support.verbs import invoke
from tribodyn.app.core.job import Job


def test_a_job_says_what_the_verb_prints(tmp_path):
    job = Job("list", ["kinds"], tmp_path)
    assert job.wait(120.0)
    assert (job.state, job.status, job.files) == ("done", 0, ())
    assert job.output.split() == invoke("list", "kinds").split()


def test_a_job_says_how_far_it_is_and_what_it_wrote(tmp_path):
    job = Job("run", ["involute-18-36", "--no-plot", "--set", "solver.cycles=60"], tmp_path)
    seen = set()
    while not job.wait(0.02):
        seen.add(job.fraction)
    assert job.state == "done"
    assert job.fraction == 1.0
    assert [file.name for file in job.files] == ["involute-18-36.h5"]
    assert any(share is not None and 0.0 < share <= 1.0 for share in seen)


def test_bad_input_fails_with_the_message_of_the_verb(tmp_path):
    job = Job("run", ["no-such-scenario"], tmp_path)
    assert job.wait(120.0)
    assert (job.state, job.status) == ("failed", 2)
    assert "no such scenario" in job.output
    assert "Traceback" not in job.output


def test_a_job_that_is_cancelled_concludes_its_record(tmp_path):
    longer = ["--set", "solver.cycles=40000", "--set", "output.window=[0, 1]"]
    job = Job("run", ["spur-25-51", "--no-plot", *longer], tmp_path)
    begun = monotonic()
    while job.fraction is None and monotonic() - begun < 60.0:
        sleep(0.05)
    job.cancel()
    assert job.wait(30.0)
    assert (job.state, job.status) == ("cancelled", 143)
    assert [file.name for file in job.files] == ["spur-25-51.partial.h5"]
