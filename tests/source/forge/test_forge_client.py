"""A forge that speaks http only is named as such, with what asks it so."""

import http.server
import threading

import pytest

from roslens.source.forge.answers import Answers
from roslens.source.forge.forge_client import ForgeClient
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import Forge, ForgeKind


def test_https_at_a_port_that_speaks_http(tmp_path):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), http.server.BaseHTTPRequestHandler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"127.0.0.1:{server.server_address[1]}"
    try:
        forge = Forge(ForgeKind.GITLAB, f"https://{address}/api/v4")
        client = ForgeClient(forge, Answers(tmp_path / "kept"), environment={}, sleep=lambda _: None)
        with client, pytest.raises(ForgeError) as raised:
            client.get("/projects")
    finally:
        server.shutdown()
        server.server_close()
    assert f"--forge-host http://{address}=KIND" in raised.value.advice
