"""Drives Chromium by its debugging pipe: real pointer input, scripts and pictures of a page, without a network."""
import base64
import json
import os
import select
import shutil
import signal
import subprocess
import time

PROGRAM = shutil.which("chromium")
OPTIONS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--no-first-run", "--hide-scrollbars", "--remote-debugging-pipe"]


class Page:
    """A page in a browser of its own. Use it in a `with` block."""

    def __init__(self, folder, width=900, height=900):
        self.folder, self.size = folder, (width, height)

    def __enter__(self):
        (to_browser, self.to), (self.back, from_browser) = os.pipe(), os.pipe()

        def arrange():  # the browser reads descriptor 3 and writes descriptor 4
            copies = [os.dup(to_browser), os.dup(from_browser)]
            os.dup2(copies[0], 3)
            os.dup2(copies[1], 4)

        self.process = subprocess.Popen(
            [PROGRAM, *OPTIONS, f"--user-data-dir={self.folder}", f"--window-size={self.size[0]},{self.size[1]}",
             "about:blank"], preexec_fn=arrange, close_fds=False, start_new_session=True,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.number, self.session, self.events = b"", 0, None, []
        targets = self.ask("Target.getTargets")["targetInfos"]
        target = next(one["targetId"] for one in targets if one["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.ask("Page.enable")
        self.ask("Runtime.enable")
        self.ask("Emulation.setDeviceMetricsOverride", width=self.size[0], height=self.size[1], deviceScaleFactor=1,
                 mobile=False)
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGKILL)  # the group has only this browser
        self.process.wait()
        os.close(self.to)
        os.close(self.back)

    def read(self, until):
        """Returns the next message; None if there is none until then."""
        while b"\0" not in self.buffer:
            if not select.select([self.back], [], [], max(0, until - time.monotonic()))[0]:
                return None
            part = os.read(self.back, 1 << 20)
            if not part:
                raise RuntimeError("the browser has ended")
            self.buffer += part
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def ask(self, method, seconds=300, **parameters):
        """Calls a method of the DevTools protocol and returns its result."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        until = time.monotonic() + seconds
        while (answer := self.read(until)) is not None:
            if answer.get("id") != self.number:
                self.events.append(answer)
            elif "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']}")
            else:
                return answer["result"]
        raise RuntimeError(f"{method}: no answer in {seconds} s")

    def open(self, address, seconds=300):
        """Opens a page and waits until it is loaded. Returns the seconds that this took."""
        start = time.monotonic()
        self.events = [event for event in self.events if event.get("method") != "Page.loadEventFired"]
        self.ask("Page.navigate", url=address)
        while True:
            if any(event.get("method") == "Page.loadEventFired" for event in self.events):
                return time.monotonic() - start
            event = self.read(start + seconds)
            if event is None:
                raise RuntimeError(f"{address} is not loaded in {seconds} s")
            self.events.append(event)

    def before_pages(self, script):
        """Lets a script run before those of each page that is opened from now on."""
        self.ask("Page.addScriptToEvaluateOnNewDocument", source=script)

    def run(self, script, seconds=300):
        """Returns the value of a script, which may be a promise."""
        result = self.ask("Runtime.evaluate", seconds, expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(json.dumps(result["exceptionDetails"])[:2000])
        return result["result"].get("value")

    def complaints(self):
        """Returns the exceptions and errors of the page so far."""
        self.ask("Page.getLayoutMetrics")  # what came before it has been read then
        return [event for event in self.events if event.get("method") == "Runtime.exceptionThrown" or
                event.get("method") == "Runtime.consoleAPICalled" and event["params"]["type"] == "error"]

    def mouse(self, kind, x, y, button="left", buttons=1):
        self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1)

    def drag(self, start, end, steps=10):
        """Drags the pointer with the left button from a place to another, in CSS pixels of the window."""
        self.mouse("mouseMoved", *start, button="none", buttons=0)
        self.mouse("mousePressed", *start)
        for step in range(1, steps + 1):
            self.mouse("mouseMoved", *(a + (b - a) * step / steps for a, b in zip(start, end)))
        self.mouse("mouseReleased", *end, buttons=0)

    def picture(self, whole=False, clip=None):
        """Returns a PNG of the window, of the whole page, or of a part of the page (x, y, width, height)."""
        more = {"clip": dict(zip(("x", "y", "width", "height"), clip), scale=1)} if clip else {}
        if whole:
            size = self.ask("Page.getLayoutMetrics")["cssContentSize"]
            more = {"clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}}
        answer = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=bool(more), **more)
        return base64.b64decode(answer["data"])
