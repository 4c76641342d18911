"""
Browsers of other engines, driven without more packages than they are themselves.

Firefox listens to Marionette's protocol: JSON over a socket, with its length before it.
WebKitGTK comes with a WebDriver, which is asked over HTTP; it wants a screen, which
Xvfb stands in for.  Debian: ``apt-get install firefox-esr webkit2gtk-driver xvfb``.
"""

import contextlib
import json
import os
import shutil
import socket
import subprocess
import time
import urllib.request
from pathlib import Path

PATIENCE = 600  # seconds
PREFERENCES = {
    "marionette.port": 0,
    "datareporting.policy.dataSubmissionEnabled": False,
    "app.update.enabled": False,
    "network.proxy.type": 1,  # of nobody: files only
    "network.proxy.socks": "127.0.0.1",
    "network.proxy.socks_port": 9,
    "ui.prefersReducedMotion": 1,
}


def find(*names):
    """Return the first program of these names that is there, or None."""
    return next(filter(None, map(shutil.which, names)), None)


def wait_for(found, what):
    """Wait until a function returns something; return it."""
    for _ in range(10 * PATIENCE):
        if value := found():
            return value
        time.sleep(0.1)
    raise TimeoutError(f"waited {PATIENCE} s for {what}")


class Firefox:
    """Firefox without a window."""

    def __init__(self, folder: Path):
        lines = [
            f"user_pref({json.dumps(name)}, {json.dumps(value)});"
            for name, value in PREFERENCES.items()
        ]
        (folder / "user.js").write_text("\n".join(lines), encoding="utf-8")
        words = ["--headless", "--marionette", "--no-remote", "--profile", folder]
        self.process = subprocess.Popen(
            [find("firefox-esr", "firefox"), *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": str(folder)},
        )
        note = folder / "MarionetteActivePort"
        port = int(
            wait_for(lambda: note.exists() and note.read_text("utf-8"), "Firefox")
        )
        self.socket = socket.create_connection(("127.0.0.1", port), PATIENCE)
        self.n, self.rest = 0, b""
        self._read()
        self.do("WebDriver:NewSession")
        self.do("WebDriver:SetTimeouts", script=1000 * PATIENCE)

    @staticmethod
    def missing():
        return not find("firefox-esr", "firefox")

    def do(self, command, **parameters):
        self.n += 1
        text = json.dumps([0, self.n, command, parameters]).encode()
        self.socket.sendall(b"%d:%s" % (len(text), text))
        _, _, error, result = self._read()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return result

    def _read(self):
        while b":" not in self.rest:
            self.rest += self.socket.recv(65536)
        length, _, self.rest = self.rest.partition(b":")
        while len(self.rest) < int(length):
            self.rest += self.socket.recv(65536)
        text, self.rest = self.rest[: int(length)], self.rest[int(length) :]
        return json.loads(text)

    def open(self, url):
        self.do("WebDriver:Navigate", url=url)

    def ask(self, function, *arguments):
        """Return what a function of the page promises."""
        script = waited(function)
        return self.do("WebDriver:ExecuteAsyncScript", script=script, args=arguments)[
            "value"
        ]

    def close(self):
        with contextlib.suppress(OSError, RuntimeError):
            self.do("Marionette:Quit", flags=["eForceQuit"])
        self.socket.close()
        end(self.process)


class WebKit:
    """WebKitGTK in its small browser, on a screen that nobody sees."""

    def __init__(self, folder: Path):
        out, into = os.pipe()
        self.screen = subprocess.Popen(
            ["Xvfb", "-displayfd", str(into), "-screen", "0", "1440x900x24"],
            pass_fds=[into],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(into)
        with os.fdopen(out) as pipe:
            display = f":{pipe.readline().strip()}"
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.driver = subprocess.Popen(
            ["WebKitWebDriver", f"--port={port}"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={
                **os.environ,
                "DISPLAY": display,
                "HOME": str(folder),
                "WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS": "1",
            },
        )
        self.url = f"http://127.0.0.1:{port}/session"
        options = {"binary": str(small_browser()), "args": ["--automation"]}
        wanted = {"alwaysMatch": {"webkitgtk:browserOptions": options}}
        made = wait_for(lambda: self._try(wanted), "WebKitGTK")
        self.url += f"/{made['sessionId']}"
        self._post("/timeouts", {"script": 1000 * PATIENCE})

    @staticmethod
    def missing():
        return not (find("WebKitWebDriver") and find("Xvfb") and small_browser())

    def _try(self, wanted):
        with contextlib.suppress(ConnectionRefusedError, urllib.error.URLError):
            return self._post("", {"capabilities": wanted})

    def _post(self, path, body):
        request = urllib.request.Request(
            self.url + path,
            json.dumps(body).encode(),
            {"Content-Type": "application/json"},
        )
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        with opener.open(request, timeout=PATIENCE) as reply:
            return json.load(reply)["value"]

    def open(self, url):
        self._post("/url", {"url": url})

    def ask(self, function, *arguments):
        """Return what a function of the page promises."""
        body = {"script": waited(function), "args": arguments}
        return self._post("/execute/async", body)

    def close(self):
        end(self.driver)
        end(self.screen)


def small_browser():
    """Return the path of WebKitGTK's MiniBrowser, or None."""
    return next(Path("/usr/lib").glob("*/webkit2gtk-4*/MiniBrowser"), None)


def waited(function):
    """Return a script that hands on what a function promises, or why it failed."""
    return (
        "const [give, ...rest] = [arguments[arguments.length - 1], ...arguments];"
        f"Promise.resolve().then(() => ({function})(...rest))"
        ".then(give, (error) => give({ failed: `${error}` }));"
    )


def end(process):
    """End a program, and wait for it."""
    process.terminate()
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


ENGINES = {"Firefox": Firefox, "WebKitGTK": WebKit}
