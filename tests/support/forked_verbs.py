"""Verbs in processes of their own, each a fork of one that has imported what they need.

To import it takes longer than most verbs. A fork starts where a new process would be after its imports, and
leaves nothing behind for the next; what a verb imports itself is tested in `cli/test_start_up.py`.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from subprocess import CompletedProcess

#: Reads a line of JSON a verb, answers with its exit status. SIGALRM ends a verb that hangs.
SERVER = """
import gc, json, os, signal, sys
import llvmlite.binding, matplotlib.backends.backend_agg, matplotlib.figure, numba, scipy.interpolate
import tribodyn.cli.app, tribodyn.studies.pages
import tribodyn.studies.motion.run, tribodyn.studies.motion.pair.scenario
from tribodyn.cli import main
from tribodyn.post.style import STYLE

STYLE["savefig.dpi"] = 60
gc.freeze()
for line in sys.stdin:
    request = json.loads(line)
    child = os.fork()
    if child == 0:
        signal.alarm(300)
        files = (os.devnull, os.O_RDONLY), (request["out"], os.O_WRONLY), (request["err"], os.O_WRONLY)
        for number, file in enumerate(files):
            os.dup2(os.open(*file), number)
        os.chdir(request["folder"])
        sys.argv = ["tribodyn", *request["words"]]
        main()
        break
    _, ended = os.waitpid(child, 0)
    print(os.waitstatus_to_exitcode(ended), flush=True)
"""


class ForkedVerbs:
    """Runs verbs as `python -W error -m tribodyn` would, in no terminal; `scratch` is for what they print.

    The interpreter, else the running one, sees this checkout, whatever is installed for it.
    """

    def __init__(self, scratch: Path, python: Path | str = sys.executable, **environment: str):
        self.out, self.err = scratch / "out", scratch / "err"
        own = {"PYTHONPATH": str(Path(__file__).parents[2]), "OPENBLAS_NUM_THREADS": "1"}
        self.server = subprocess.Popen(
            [str(python), "-P", "-W", "error", "-c", SERVER],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, **own, **environment},
        )

    def __call__(self, *words: str, folder: Path) -> CompletedProcess[str]:
        """Run one verb in a folder."""
        assert self.server.stdin is not None
        assert self.server.stdout is not None
        for file in (self.out, self.err):
            file.write_text("", encoding="utf-8")
        request = {"words": words, "folder": str(folder), "out": str(self.out), "err": str(self.err)}
        self.server.stdin.write(json.dumps(request) + "\n")
        self.server.stdin.flush()
        status = int(self.server.stdout.readline())
        said = (file.read_text(encoding="utf-8") for file in (self.out, self.err))
        return CompletedProcess(words, status, *said)

    def close(self) -> None:
        """End the process that forks."""
        self.server.communicate()
