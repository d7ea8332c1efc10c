"""The page of ``cuspaudit show``, served to this machine's own browser only."""

from __future__ import annotations

import errno
import webbrowser
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from cuspaudit.errors import UnableError

__all__ = ["open_server", "serve"]

HOST = "127.0.0.1"
TRIES = 100  # ports looked at before giving up


def serve(
    html: str,
    port: int = 7000,
    *,
    open_browser: bool = True,
    say: Callable[[str], None] = print,
) -> None:
    """Serve ``html`` on loopback until Ctrl-C.

    Args:
        html: the page.
        port: where to listen; when it is taken, the next free port after it.
        open_browser: whether to open the page in the user's browser.
        say: gets the line with the address.

    Raises:
        UnableError: no port of the hundred after ``port`` is free.
    """
    with open_server(html, port) as server:
        address = f"http://{HOST}:{server.server_port}/"
        say(f"Serving {address} (Ctrl-C ends it)")
        if open_browser:
            webbrowser.open(address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            say("Stopped.")


def open_server(html: str, port: int = 7000) -> ThreadingHTTPServer:
    """A server of ``html`` on the first free port from ``port`` on, not yet running.

    Raises:
        UnableError: no port of the hundred after ``port`` is free.
    """
    body = html.encode()

    class Page(_PageHandler):
        page = body

    for candidate in range(port, min(port + TRIES, 65536)):
        try:
            return _Server((HOST, candidate), Page)
        except OSError as error:
            if error.errno not in (errno.EADDRINUSE, errno.EACCES):
                raise
    raise UnableError("show", f"no free port from {port} on; choose another")


class _Server(ThreadingHTTPServer):
    daemon_threads = True


class _PageHandler(BaseHTTPRequestHandler):
    """Answers ``/`` with the page, to callers who know this machine by its own name.

    The name is checked so that no site can reach the page through a name of its own
    that leads to this machine.
    """

    page = b""

    def do_GET(self) -> None:
        """Send the page, or say why not."""
        name = (self.headers.get("Host") or "").rsplit(":", 1)[0]
        if name not in (HOST, "localhost"):
            self.send_error(403)
        elif self.path.split("?")[0] != "/":
            self.send_error(404)
        else:
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(self.page)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(self.page)

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing: the terminal is the user's."""
