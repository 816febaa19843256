"""Who may speak to the server: pages of this server, by an address that holds its token."""

import secrets
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Message, Receive, Send], Awaitable[None]]

#: Names of this machine under which a page may ask for the server. Any other is a foreign name that somebody
#: let point here (DNS rebinding).
HOSTS = ("127.0.0.1", "localhost")
#: Bytes of a token.
_TOKEN = 24
# everything comes from here; Vue compiles templates and NiceGUI runs scripts of the server in the page
_POLICY = (
    "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; connect-src 'self' ws://{host}; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'self' http://localhost:* http://127.0.0.1:* vscode-webview:"
)
#: Pages of results run scripts, but are no part of this origin.
SANDBOX = "sandbox allow-scripts allow-downloads allow-popups; frame-ancestors 'self'"


def new_token() -> str:
    """Make a token that cannot be guessed, for an address."""
    return secrets.token_urlsafe(_TOKEN)


class Guard:
    """Passes on requests and websockets whose Host, Origin and path are right, and refuses all others.

    Parameters
    ----------
    inner
        The application that answers.
    token
        First part of every path.
    port
        Port of the server, a part of Host and Origin.
    invitation
        A path that leads to the token once: the words of a command that starts a browser can be read by other
        users of the machine.
    """

    def __init__(self, inner: Application, token: str, port: int, invitation: str | None = None) -> None:
        self.inner = inner
        self.token = token.encode()
        self.invitation = invitation
        self.hosts = tuple(f"{name}:{port}".encode() for name in HOSTS)

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        """Answer a request, or refuse it with 403."""
        if scope["type"] == "lifespan":
            await self.inner(scope, receive, send)
            return
        headers = [(name.lower(), value) for name, value in scope["headers"]]
        hosts = [value for name, value in headers if name == b"host"]
        origins = [value for name, value in headers if name == b"origin"]
        if not self._own(hosts, origins):
            await _refuse(scope, receive, send)
            return
        named = (str(scope["path"]).split("/")[1:2] or [""])[0].encode()
        invitation = self.invitation
        if invitation is not None and secrets.compare_digest(named, invitation.encode()):
            self.invitation = None
            await _redirect(f"/{self.token.decode()}/", send)
            return
        if not secrets.compare_digest(named, self.token):
            await _refuse(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                given = {name.lower() for name, _ in message.get("headers", [])}
                policy = _POLICY.format(host=hosts[0].decode()).encode()
                own = {
                    b"content-security-policy": policy,
                    b"referrer-policy": b"no-referrer",
                    b"x-content-type-options": b"nosniff",
                    b"cross-origin-resource-policy": b"same-origin",
                }
                message = {
                    **message,
                    "headers": [
                        *message.get("headers", []),
                        *(item for item in own.items() if item[0] not in given),
                    ],
                }
            await send(message)

        await self.inner(scope, receive, send_guarded)

    def _own(self, hosts: list[bytes], origins: list[bytes]) -> bool:
        own = len(hosts) == 1 and hosts[0] in self.hosts
        # a browser names the origin of a page that opens a websocket or sends something
        same = all(origin in [b"http://" + host for host in self.hosts] for origin in origins)
        return own and same


async def _redirect(path: str, send: Send) -> None:
    headers = [(b"location", path.encode()), (b"content-length", b"0"), (b"referrer-policy", b"no-referrer")]
    await send({"type": "http.response.start", "status": 303, "headers": headers})
    await send({"type": "http.response.body", "body": b""})


async def _refuse(scope: Message, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008})
        return
    text = b"Refused: open the address that `tribodyn app` has printed, with its token.\n"
    headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(text)).encode())]
    await send({"type": "http.response.start", "status": 403, "headers": headers})
    await send({"type": "http.response.body", "body": text})
