"""An editor: a client of the Language Server Protocol that speaks with ``roslens lsp``."""

import json
import os
import subprocess
import sys


class Editor:
    """A client of the Language Server Protocol; what the server sends in between is kept by method."""

    def __init__(self, root, *words, **more):
        environment = {**os.environ, "XDG_CONFIG_HOME": str(root / ".config"), **more}
        command = [sys.executable, "-m", "roslens.cli.main", "lsp", "--stdio", *words]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
        self.root = root
        self.number = 0
        self.reported = []

    def send(self, method, params, *, answered=True):
        message = {"jsonrpc": "2.0", "method": method, "params": params}
        if answered:
            self.number += 1
            message["id"] = self.number
        content = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(content), content))
        self.process.stdin.flush()
        if answered:
            return self.until(lambda one: one.get("id") == self.number)["result"]
        return None

    def until(self, wanted):
        while True:
            length = 0
            while line := self.process.stdout.readline().strip():
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            message = json.loads(self.process.stdout.read(length))
            if wanted(message):
                return message
            self.reported.append(message)

    def notify(self, method, params):
        self.send(method, params, answered=False)

    def start(self):
        uri = self.root.as_uri()
        folders = [{"uri": uri, "name": "ws"}]
        reported = self.send(
            "initialize", {"processId": None, "rootUri": uri, "workspaceFolders": folders, "capabilities": {}}
        )
        self.notify("initialized", {})
        return reported["capabilities"]

    def open(self, path):
        place = self.root / path
        document = {"uri": place.as_uri(), "languageId": "python", "version": 1, "text": place.read_text()}
        self.notify("textDocument/didOpen", {"textDocument": document})
        return self.diagnostics(place.as_uri())

    def save(self, path):
        uri = (self.root / path).as_uri()
        self.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
        return self.diagnostics(uri)

    def diagnostics(self, uri):
        def published(one):
            return one.get("method") == "textDocument/publishDiagnostics" and one["params"]["uri"] == uri

        return self.until(published)["params"]["diagnostics"]

    def stop(self):
        self.send("shutdown", None)
        self.notify("exit", None)
        self.process.stdin.close()
        code = self.process.wait(30)
        self.process.stdout.close()
        return code

    def end(self):
        """End the server, whatever it does."""
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
