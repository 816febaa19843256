"""The one way by which the program starts processes.

A child runs the code that this process runs: nothing on its path of modules can be replaced by the current
folder. It inherits an environment and three pipes, no open files and no signal handlers. It leads a session
of its own, so that signals of a terminal are for its parent alone.

It ends with its parent, even with one that is killed: its standard input stays open as long as the parent has
use for it, and a thread of the child waits for the end of it, whatever else the child is at. What the child
has started itself ends with it. (Linux's own signal at a parent's death comes when the *thread* ends that
started the child, and other systems have none.) A native call that holds Python's lock is finished first.
"""

import math
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from tribodyn.errors import no_descriptors
from tribodyn.numerics.processes.libraries import ignore_files

if TYPE_CHECKING:
    import subprocess

#: Loads the package from the file of its parent's, whichever else is installed, and begins.
_BOOT = """
import sys
from importlib.util import module_from_spec, spec_from_file_location
spec = spec_from_file_location("tribodyn", sys.argv[1])
sys.modules["tribodyn"] = package = module_from_spec(spec)
spec.loader.exec_module(package)
from tribodyn.numerics.processes.child import begin
begin(*sys.argv[2:])
"""
_PACKAGE = Path(__file__).absolute().parents[2] / "__init__.py"
#: How often a child looks whether it still has its parent, s: the end of its input says so at once, unless
#: another process has inherited the parent's end of the pipe.
_LOOK_EVERY = 1.0


def safe_path() -> list[str]:
    """Folders from which this process imports, without the current one.

    It stays where the user has named it in full in ``PYTHONPATH``, and where an installed package has added
    it behind the standard library: an editable installation, which shadows nothing.
    """
    try:
        here = os.path.realpath(os.curdir)
    except OSError:  # it has been removed
        here = ""
    named = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    chosen = any(os.path.isabs(part) and os.path.realpath(part) == here for part in named)
    path = [part for part in sys.path if isinstance(part, str)]
    library = os.path.dirname(os.__file__)
    installed = path.index(library) if library in path else len(path)
    return [
        part
        for place, part in enumerate(path)
        if os.path.isabs(part) and (chosen or place >= installed or os.path.realpath(part) != here)
    ]


def _environment() -> dict[str, str]:
    """Variables of a child's environment: one core each, and the modules that this process sees."""
    dropped = {"PYTHONINSPECT", "PYTHONSTARTUP"}
    kept = {name: value for name, value in os.environ.items() if name not in dropped}
    # a folder with the separator in its name would be read as two, the second within the current folder
    path = os.pathsep.join(part for part in safe_path() if os.pathsep not in part)
    return kept | {"PYTHONPATH": path, "PYTHONSAFEPATH": "1", "OPENBLAS_NUM_THREADS": "1"}


@contextmanager
def isolated_environment() -> Iterator[None]:
    """Give the environment of a child to what starts processes of Python itself: Dask."""
    names = ("PYTHONPATH", "PYTHONSAFEPATH")
    before = {name: os.environ.get(name) for name in names}
    isolated = _environment()
    os.environ.update({name: isolated[name] for name in names})
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def start(
    target: str, *words: str, environment: Mapping[str, str] | None = None
) -> "subprocess.Popen[bytes]":
    """Start a process of Python that calls a function of this package; the caller has to `end` it.

    The `target` is ``module:function``, its arguments are `words`. What it writes to standard output is the
    answer. Its standard input has no end: where the caller closes it, the child is killed. Variables of the
    environment are this process's but for those given. Raises OSError if it cannot be started.
    """
    import subprocess

    if not sys.executable:
        raise OSError("where Python's interpreter lies is not known")
    return subprocess.Popen(
        [sys.executable, "-P", "-c", _BOOT, str(_PACKAGE), target, *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=_environment() | dict(environment or {}),
        start_new_session=True,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    )


def end(process: "subprocess.Popen[bytes]") -> None:
    """End a child and what it has started, at once."""
    if process.poll() is None:
        _kill(process)
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            with suppress(OSError, ValueError):
                stream.close()
    process.wait()


def _kill(process: "subprocess.Popen[bytes]") -> None:
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg") and os.getpgid(process.pid) == process.pid:
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()


def tell(process: "subprocess.Popen[bytes]", content: bytes) -> None:
    """Write to a child's standard input; raises OSError where it has ended."""
    assert process.stdin is not None
    process.stdin.write(content)
    process.stdin.flush()


def answer(process: "subprocess.Popen[bytes]", limit: float, *, line: bool = False) -> bytes:
    """What a child answers: all that it writes, or the next line.

    It is killed, and TimeoutError raised, if it does not answer within the limit, s.
    """
    assert process.stdout is not None
    late = threading.Event()
    timer = threading.Timer(limit, lambda: (late.set(), _kill(process)))
    timer.daemon = True
    timer.start()
    try:
        content = process.stdout.readline() if line else process.stdout.read()
    finally:
        timer.cancel()
    if late.is_set():
        raise TimeoutError(f"no answer within {limit:g} s")
    return content


def begin(target: str, *words: str) -> None:
    """Call the function that a child is for; in the child."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # on Windows Ctrl-C reaches children too
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
    _end_with_input()
    ignore_files()
    module, _, name = target.partition(":")
    getattr(import_module(module), name)(*words)


def _end_with_input() -> None:
    """Let this process end with its standard input, which it reads by way of a thread that notices."""
    outer = open(os.dup(0), "rb", buffering=0)
    reading, writing = os.pipe()
    inner = open(writing, "wb", buffering=0)
    with open(reading, "rb", buffering=0) as replaced:
        os.dup2(replaced.fileno(), 0, inheritable=False)
    # the thread may come to run only after the parent has ended, where this process computes at once
    threading.Thread(target=_pass_on, args=(os.getppid(), outer, inner), daemon=True).start()


def _pass_on(parent: int, outer: Any, inner: Any) -> NoReturn:
    import select

    while True:
        # Windows waits for sockets alone, and no process inherits a pipe there
        if os.name == "nt" or select.select([outer], [], [], _LOOK_EVERY)[0]:
            content = outer.read(65536)
            if not content:
                _end_all()
            inner.write(content)
        elif os.getppid() != parent:
            _end_all()


def _end_all() -> NoReturn:
    """End this child and all that it has started."""
    if hasattr(os, "killpg") and os.getpgrp() == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(0)


def copies_are_safe() -> bool:
    """Whether a copy of this process can go on: no other thread holds a lock that it needs."""
    return hasattr(os, "fork") and threading.active_count() == 1


def in_a_copy(work: Callable[[], bytes], limit: float, processor: float) -> bytes:
    """Result of a function, at most 64 KiB, that is called in a copy of this process.

    Where the copy may have no more files open, what the system says of that. Raises TimeoutError if it does
    not end within the limit, s, or takes more time of the processor, s, and ChildProcessError if it crashes.
    """
    import select
    import warnings

    reading, writing = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that others' threads do not come along is known
        child = os.fork()
    if child == 0:
        _work_as_a_copy(work, writing, limit, processor)
    os.close(writing)
    content, status = b"", None
    try:
        if not select.select([reading], [], [], limit)[0]:
            raise TimeoutError(f"did not end within {limit:g} s")
        while part := os.read(reading, 65536):
            content += part
        _, status = os.waitpid(child, 0)
    finally:
        os.close(reading)
        if status is None:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    if status and os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGXCPU:
        raise TimeoutError(f"did not end within {processor:.2g} s of the processor")
    if status:
        raise ChildProcessError("the copy crashed")
    return content


def _work_as_a_copy(work: Callable[[], bytes], writing: int, limit: float, processor: float) -> NoReturn:
    """Write what the function says and end, without what a process does at its end."""
    import resource

    status = 1
    try:
        used, most = math.ceil(time.process_time() + processor), resource.getrlimit(resource.RLIMIT_CPU)[1]
        allowed = used if most == resource.RLIM_INFINITY else min(used, most)
        signal.signal(signal.SIGXCPU, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_CPU, (allowed, most))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM):
            signal.signal(number, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, limit + 1.0)  # where the parent has been killed
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # a crash is reported by the parent
        os.write(writing, work()[:65536])
        status = 0
    except OSError as error:
        if no_descriptors(error):
            os.write(writing, str(error).encode(errors="replace")[:65536])
            status = 0
    finally:
        os._exit(status)


def installed_program(names: Sequence[str]) -> str | None:
    """Path of the first program that is installed; what lies in the current folder is none."""
    import shutil

    path = os.pathsep.join(part for part in os.get_exec_path() if os.path.isabs(part))
    paths = (shutil.which(name, path=path) for name in names)
    return next((path for path in paths if path and os.path.isabs(path)), None)


def open_address(address: str) -> None:
    """Show an address in the user's browser, where there is a screen for one."""
    import webbrowser

    if sys.platform.startswith("linux") and not os.environ.keys() & {"DISPLAY", "WAYLAND_DISPLAY", "BROWSER"}:
        return  # a browser of a terminal would take it from us
    with suppress(webbrowser.Error, OSError):
        webbrowser.open(address)


def run_program(
    command: Sequence[str], limit: float, environment: Mapping[str, str] | None = None
) -> "subprocess.CompletedProcess[str]":
    """Run a program that is not ours to its end, by a child that ends it with this process.

    It is killed, with all that it started, and TimeoutError raised, if it does not end within the limit, s.
    Raises OSError if it cannot be started.
    """
    import pickle
    import subprocess

    process = start(f"{__name__}:_supervise", *command, environment=environment)
    try:
        content = answer(process, limit)
    finally:
        end(process)
    if not content:
        raise OSError(f"{command[0]} could not be run")
    status, *printed = pickle.loads(content)
    return subprocess.CompletedProcess(command, status, *(text.decode(errors="replace") for text in printed))


def _supervise(*command: str) -> None:
    import pickle
    import subprocess

    ended = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    pickle.dump((ended.returncode, ended.stdout, ended.stderr), sys.stdout.buffer)
