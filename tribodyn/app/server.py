"""The server of the page: on this machine alone, for who knows its address, with the files of one folder."""

import asyncio
import socket
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tribodyn.app.core.document import Document
from tribodyn.app.core.worker import Worker
from tribodyn.app.examples import FIRST
from tribodyn.app.folder import MOST_BYTES, WorkFolder
from tribodyn.app.guard import SANDBOX, Guard, new_token
from tribodyn.app.kept import KeptWork
from tribodyn.errors import InputError, OutputError, quoted
from tribodyn.input.sources import is_shipped
from tribodyn.numerics.processes import child

if TYPE_CHECKING:
    import subprocess

HOST = "127.0.0.1"
#: Port where none is named and it is free: what a browser keeps of a page it keeps by port.
USUAL_PORT = 8417
#: How long a window that the browser has lost is kept, s: a machine that sleeps, a page that is loaded again.
_KEPT = 30.0
#: Files of results that a browser opens.
_SHOWN = (".html", ".png", ".svg")
#: What a link to a state begins with, behind its address.
_STATE = "?state="


def serve(
    scenario: str | None,
    announce: Callable[[str, str], None],
    folder: Path | None = None,
    port: int | None = None,
) -> None:
    """Serve the page until the process is asked to end.

    Parameters
    ----------
    scenario
        A file, the name of a shipped scenario or a link; None: an example.
    announce
        Called with the address, and with one that leads there once, before anybody is served.
    folder
        The only folder whose files are read and written; default: that of the file, or the current one.
    port
        None: the usual one, or any that is free.

    Raises
    ------
    InputError
        Where the scenario cannot be opened, or the port is taken.
    """
    import uvicorn

    work_folder, first = opened(scenario, folder)
    listening = _listen(port)
    token, invitation = new_token(), new_token()
    number = listening.getsockname()[1]
    address = f"http://{HOST}:{number}/{token}/"
    spare = [Worker()]  # it imports what it needs while this process does
    inner = _application(work_folder, first, address, token, spare)
    application = Guard(inner, token, number, invitation)
    config = uvicorn.Config(
        application,
        log_level="critical",
        access_log=False,
        server_header=False,
        lifespan="on",
        timeout_graceful_shutdown=1,
        ws_max_size=8 * 2**20,
        ws_per_message_deflate=False,  # to this machine it takes longer than it spares
    )
    announce(address, f"http://{HOST}:{number}/{invitation}")
    with listening:
        try:
            uvicorn.Server(config).run([listening])
        finally:
            for worker in spare:
                worker.close()


def started(scenario: str, limit: float) -> "tuple[str, subprocess.Popen[bytes]]":
    """Begin a server in a child process; its address and the process.

    InputError where the scenario cannot be opened; TimeoutError where it does not begin within the limit, s.
    """
    opened(scenario, None)
    process = child.start(f"{__name__}:serve_for_parent", scenario)
    try:
        address = child.answer(process, limit, line=True).decode().strip()
        if not address:
            raise TimeoutError("it ended")
    except TimeoutError:
        child.end(process)
        raise
    return address, process


def serve_for_parent(scenario: str) -> None:
    """Serve a notebook; in a child process that writes the address as its answer."""

    def announce(address: str, _: str) -> None:
        sys.stdout.write(address + "\n")
        sys.stdout.flush()

    serve(scenario, announce, port=0)


def opened(scenario: str | None, folder: Path | None) -> tuple[WorkFolder, Document]:
    """The folder to work in, and the document that is open at first."""
    if scenario is not None and _STATE in scenario:
        work_folder = WorkFolder(folder or Path.cwd())
        return work_folder, _of_state(scenario.partition(_STATE)[2].partition("&")[0], work_folder)
    document = Document.open(scenario or FIRST)
    own = scenario is not None and Path(scenario).is_file()
    work_folder = WorkFolder(folder or (document.path.parent if own else Path.cwd()))
    if own and not work_folder.holds(document.path):
        rule = f"does not lie in {work_folder.root}"
        raise InputError("scenario", quoted(str(scenario)), rule, "name its folder with --folder")
    return work_folder, document


def _anew(first: Document) -> Document:
    """The document that is open at first, as its file says it now."""
    if first.has_file:
        with suppress(InputError):
            return Document.open(first.path)
    document = Document(first.text, first.path)
    document.variants = first.variants
    return document


def _of_state(state: str, folder: WorkFolder) -> Document:
    """The document of a link. A file of its name may have been changed since: it is not taken for saved."""
    document = Document.of_link(state, folder.root)
    if not folder.holds(document.path) and not is_shipped(document.path):
        raise InputError("link", quoted(document.path.name), "leads out of this folder", "name its --folder")
    return document


def _listen(port: int | None) -> socket.socket:
    """A socket of this machine alone."""
    for number in (USUAL_PORT, 0) if port is None else (port,):
        listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        if sys.platform != "win32":  # there it would let two servers have one port
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((HOST, number))
            listening.listen(64)
        except (OSError, OverflowError) as error:
            listening.close()
            if port is not None:
                rule = f"cannot be used: {getattr(error, 'strerror', None) or error}"
                raise InputError("--port", str(port), rule, "name another, or none") from None
            continue
        return listening
    raise InputError("--port", None, "no port is free", "end another program")


def _application(folder: WorkFolder, first: Document, address: str, token: str, spare: list[Worker]) -> Any:
    """The application: the page of a window, and the pages of results; the first window takes the spare."""
    from fastapi import FastAPI, Request
    from fastapi.responses import FileResponse, PlainTextResponse, Response
    from nicegui import Client, app, ui

    from tribodyn.app.page import DesignPage

    kept = KeptWork()

    @ui.page("/", title="tribodyn")
    def design(client: Client, state: str = "", few: str = "", at: str = "", text: str = "") -> None:
        document, problem = kept.copy(at), ""
        if document is None:
            document = _anew(first)
            try:
                document = _of_state(state, folder) if state else document
            except InputError as error:
                problem = str(error)
        worker = spare.pop() if spare else None
        page = DesignPage(
            folder, document, client, address, kept, few=bool(few), as_text=bool(text), worker=worker
        )
        if problem:
            page.bar.say(problem)

    @app.get("/files/{name:path}")
    def result(name: str) -> Response:
        try:
            path = folder.file(name, _SHOWN)
        except InputError:
            path = None
        if path is None or not path.is_file():
            return PlainTextResponse("There is no such file here.\n", 404)
        return FileResponse(path, headers={"content-security-policy": SANDBOX})

    @app.post("/bring/{name:path}")
    async def bring(name: str, request: Request) -> Response:
        content = bytearray()
        async for part in request.stream():
            content += part
            if len(content) > MOST_BYTES:
                break
        try:
            path = await asyncio.to_thread(folder.bring, name, bytes(content))  # which reads it
        except (InputError, OutputError) as error:
            return PlainTextResponse(str(error), 400)
        return PlainTextResponse(folder.named(path))

    application = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    ui.run_with(
        application,
        title="tribodyn",
        language="en-US",
        dark=None,
        reconnect_timeout=_KEPT,
        mount_path=f"/{token}",
        tailwind=False,
        show_welcome_message=False,
        favicon=_ICON,
    )
    return application


_ICON = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -10 20 20"><g fill="none" stroke="#0072b2">'
    '<circle r="6.4" stroke-width="4" stroke-dasharray="2.2 1.15"/><circle r="5" stroke-width="2"/></g></svg>'
)
