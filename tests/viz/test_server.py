from __future__ import annotations

import http.client
import threading
import webbrowser
from collections.abc import Iterator
from http.server import ThreadingHTTPServer

import pytest

from cuspaudit.viz import serve
from cuspaudit.viz import server as module
from cuspaudit.viz.server import open_server

PORT = 7345


@pytest.fixture
def running() -> Iterator[ThreadingHTTPServer]:
    """A server in a thread."""
    with open_server("<p>é</p>", PORT) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


def ask(port: int, path: str, host: str) -> tuple[int, bytes]:
    """Status and body of one request."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
    connection.request("GET", path, headers={"Host": host})
    answer = connection.getresponse()
    return answer.status, answer.read()


def test_the_page_is_served_on_loopback_only(running: ThreadingHTTPServer) -> None:
    """The page is there under its own name, and nothing else is."""
    port = running.server_port
    assert running.server_address[0] == "127.0.0.1"
    assert ask(port, "/", f"127.0.0.1:{port}") == (200, "<p>é</p>".encode())
    assert ask(port, "/etc/passwd", f"localhost:{port}")[0] == 404
    assert ask(port, "/", "evil.example")[0] == 403


def test_a_taken_port_gives_the_next_one(running: ThreadingHTTPServer) -> None:
    """A second page finds the next free port."""
    with open_server("", running.server_port) as second:
        assert second.server_port > running.server_port


@pytest.mark.parametrize("wanted", [True, False])
def test_serve_says_its_address_and_ends_on_interrupt(
    monkeypatch: pytest.MonkeyPatch, wanted: bool
) -> None:
    """The address is printed, the browser opened unless told not to, Ctrl-C ends it."""
    said: list[str] = []
    opened: list[str] = []

    def interrupt(self: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr(module._Server, "serve_forever", interrupt)
    serve("", PORT + 200, open_browser=wanted, say=said.append)
    assert said[0].startswith("Serving http://127.0.0.1:")
    assert said[-1] == "Stopped."
    assert len(opened) == int(wanted)
