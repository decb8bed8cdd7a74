"""A headless Chromium, spoken to by the DevTools protocol over a pipe, so that no package of Python is needed."""

import base64
import json
import os
import select
import struct
import subprocess
import time
import zlib


def find_browser():
    """The path of Chromium, or None."""
    for name in ("chromium", "chromium-browser", "google-chrome"):
        for folder in os.environ.get("PATH", "/usr/bin").split(":") + ["/usr/bin"]:
            path = os.path.join(folder, name)
            if os.access(path, os.X_OK):
                return path
    return None


class Browser:
    """One page of a browser without a window, whose OpenGL is software."""

    def __init__(self, program, scratch, width=1400, height=1000):
        to_browser, self.out = os.pipe()
        self.into, from_browser = os.pipe()
        # The browser reads from descriptor 3 and writes to 4.
        command = [program, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe", "--use-gl=angle",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
                   "--disable-background-networking", f"--user-data-dir={scratch}/profile", f"--window-size={width},{height}", "about:blank"]
        self.log = open(os.path.join(scratch, "chromium.log"), "wb")
        self.process = subprocess.Popen(["bash", "-c", f'exec 3<&{to_browser} 4>&{from_browser}; exec "$@"', "browser"] + command,
                                        pass_fds=(to_browser, from_browser), stdout=self.log, stderr=self.log, stdin=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.number = 0
        self.events = []
        target = self.send("Target.createTarget", {"url": "about:blank"}, session=None)["targetId"]
        self.session = self.send("Target.attachToTarget", {"targetId": target, "flatten": True}, session=None)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(domain + ".enable")
        self.resize(width, height)

    def close(self):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        for descriptor in (self.out, self.into):
            os.close(descriptor)
        self.log.close()

    def receive(self, patience_s):
        """The next message, or None."""
        end = time.monotonic() + patience_s
        while b"\0" not in self.buffer:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.into], [], [], left)[0]:
                return None
            piece = os.read(self.into, 1 << 20)
            if not piece:
                raise RuntimeError("the browser has ended; see chromium.log")
            self.buffer += piece
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def send(self, method, parameters=None, session=True, patience_s=120):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters or {}}
        if session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive(patience_s)
            if answer is None:
                raise RuntimeError(f"{method}: no answer")
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def resize(self, width, height, scale=1, mobile=False):
        self.send("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": scale, "mobile": mobile})

    def prefer(self, scheme):
        """Makes the page light or dark."""
        self.send("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, path, patience_s=90):
        """Opens a file and waits until the page says that it is ready."""
        self.send("Page.navigate", {"url": "file://" + os.path.abspath(path)})
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            if self.value("document.readyState === 'complete' && document.documentElement.dataset.ready === 'yes'"):
                return
            time.sleep(0.1)
        raise RuntimeError(f"{path}: not ready: {self.complaints()}")

    def value(self, expression):
        """The value of an expression of JavaScript."""
        answer = self.send("Runtime.evaluate", {"expression": expression, "returnByValue": True, "awaitPromise": True})
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def settle(self):
        """Waits for two frames, so that what was asked for is drawn."""
        self.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")

    def key(self, key, code=None, count=1):
        codes = {"Tab": 9, "ArrowRight": 39, "ArrowLeft": 37, "End": 35, "Home": 36, " ": 32, "Enter": 13}
        for _ in range(count):
            for kind in ("keyDown", "keyUp"):
                event = {"type": kind, "key": key, "code": code or key, "windowsVirtualKeyCode": codes[key]}
                if key == " " and kind == "keyDown":
                    event["text"] = " "
                self.send("Input.dispatchKeyEvent", event)

    def picture(self, path=None, clip=None, whole=False):
        """A picture of what is shown, or of a part, as bytes of a PNG file."""
        parameters = {"format": "png", "captureBeyondViewport": whole or clip is not None}
        if clip:
            parameters["clip"] = dict(clip, scale=1)
        elif whole:
            size = self.send("Page.getLayoutMetrics")["cssContentSize"]
            parameters["clip"] = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 16000), "scale": 1}
        data = base64.b64decode(self.send("Page.captureScreenshot", parameters)["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return data

    def box(self, selector):
        """Where an element is on the page."""
        return self.value(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                          " return {x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height}; })()")

    def complaints(self):
        """What the page wrote to its console as warnings or errors, what it threw, and what it tried to load from elsewhere."""
        while (event := self.receive(0.2)) is not None:
            self.events.append(event)
        found = []
        for event in self.events:
            method, parameters = event.get("method"), event.get("params", {})
            if method == "Runtime.exceptionThrown":
                details = parameters["exceptionDetails"]
                found.append("thrown: " + details.get("exception", {}).get("description", details.get("text", "")))
            elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
                found.append("console: " + " ".join(str(a.get("value", a.get("description"))) for a in parameters["args"]))
            elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
                found.append(f"log: {parameters['entry']['text']}")
            elif method == "Network.requestWillBeSent":
                url = parameters["request"]["url"]
                if not url.startswith(("file:", "data:", "about:", "blob:")):
                    found.append("network: " + url)
        return found


def pixels(png):
    """The pixels of a PNG file with 8 bits per channel, as (width, height, channels, rows of bytes)."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, size = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            data += body
        at += 12 + length
    width, height, depth, colour = size[:4]
    assert depth == 8 and size[6] == 0
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    raw, stride, rows, before = zlib.decompress(data), width * channels, [], bytearray(width * channels)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            left = row[x - channels] if x >= channels else 0
            up, corner = before[x], before[x - channels] if x >= channels else 0
            if kind == 1:
                row[x] = (row[x] + left) & 255
            elif kind == 2:
                row[x] = (row[x] + up) & 255
            elif kind == 3:
                row[x] = (row[x] + (left + up) // 2) & 255
            elif kind == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                row[x] = (row[x] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        rows.append(bytes(row))
        before = row
    return width, height, channels, rows
