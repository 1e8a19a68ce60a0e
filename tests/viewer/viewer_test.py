#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
"""Plays a viewer page in headless Chromium through chromedriver: it is not blank, plays, pauses, scrubs, answers keys and
pointer, and logs no error. Standard library only. Exit code 77 = skipped because Chromium or its driver is missing.

usage: viewer_test.py MAKE_PAGE [--keep FOLDER]   (--keep leaves page and screenshots there)
"""
import argparse
import base64
import json
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

SKIPPED = 77
CHROMIUM_FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
    "--force-device-scale-factor=2", "--hide-scrollbars",
]
# Share of pixels that are not transparent, and a hash, of a canvas.
CANVAS_STATE = """
const canvas = document.getElementById(arguments[0]);
const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
let hash = 0, painted = 0;
const colours = new Set();
for (let i = 0; i < data.length; i += 4) {
  if (data[i + 3]) ++painted;
  const c = data[i] << 16 | data[i + 1] << 8 | data[i + 2];
  if (data[i + 3] === 255) colours.add(c);
  hash = (hash * 31 + c + data[i + 3]) | 0;
}
return {hash, painted: painted * 4 / data.length, colours: colours.size, width: canvas.width};
"""


class Driver:
    """The few WebDriver commands that the test needs."""

    def __init__(self, chromium, chromedriver, profile):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            port = s.getsockname()[1]
        self.process = subprocess.Popen([chromedriver, f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.base = f"http://127.0.0.1:{port}"
        self.session = ""
        self.wait_until_ready()
        flags = CHROMIUM_FLAGS + [f"--user-data-dir={profile}"]
        capabilities = {"goog:chromeOptions": {"binary": chromium, "args": flags}, "goog:loggingPrefs": {"browser": "ALL"}}
        value = self.call("POST", "/session", {"capabilities": {"alwaysMatch": capabilities}})
        self.session = f"/session/{value['sessionId']}"

    def wait_until_ready(self):
        for _ in range(200):
            try:
                if self.call("GET", "/status")["ready"]:
                    return
            except (urllib.error.URLError, ConnectionError):
                time.sleep(0.05)
        raise RuntimeError("chromedriver did not start within 10 s")

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + self.session + path, data=data, method=method,
                                         headers={"Content-Type": "application/json"})
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{method} {path}: {error.read().decode()[:400]}") from None

    def run(self, script, *args):
        return self.call("POST", "/execute/sync", {"script": script, "args": list(args)})

    def resize(self, width, height):
        self.call("POST", "/window/rect", {"width": width, "height": height})

    def press(self, *keys):
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def pointer(self, *steps):
        """steps: (x, y) to move to, or "down", "up"."""
        actions = [{"type": "pointerDown" if s == "down" else "pointerUp", "button": 0} if isinstance(s, str) else
                   {"type": "pointerMove", "x": round(s[0]), "y": round(s[1]), "duration": 30} for s in steps]
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    def screenshot(self, path):
        path.write_bytes(base64.b64decode(self.call("GET", "/screenshot")))

    def console(self):
        return self.call("POST", "/se/log", {"type": "browser"})

    def quit(self):
        try:
            if self.session:
                self.call("DELETE", "")
        finally:
            self.process.terminate()
            self.process.wait()


def check(condition, message):
    if not condition:
        raise AssertionError(message)


def frame(driver):
    return driver.run("return motexViewer.frame")


def state(driver, canvas="view"):
    """After the page has painted twice, so that pending changes are on the canvas."""
    driver.call("POST", "/execute/async", {"script": "const done = arguments[0];"
                "requestAnimationFrame(() => requestAnimationFrame(() => done(1)));", "args": []})
    return driver.run(CANVAS_STATE, canvas)


def check_loaded(driver):
    check(driver.run("return motexViewer.numFrames") == 1188, "the page does not know its frames")
    check(driver.run("return document.getElementById('name').textContent").startswith("salsa </script>"), "the name is wrong")
    check(driver.run("return document.querySelectorAll('b').length") == 3, "a name became markup")


def check_not_blank(driver):
    driver.run("motexViewer.pause(); motexViewer.seek(100)")
    view, strip = state(driver), state(driver, "strip")
    check(view["painted"] > 0.02 and view["colours"] > 200, f"the view is blank: {view}")
    check(strip["painted"] > 0.9 and strip["colours"] >= 10, f"the strip is blank: {strip}")
    check(view["width"] == 2 * driver.run("return document.getElementById('view').clientWidth"), "not drawn at the screen's density")
    check(state(driver) == view, "a paused page changes")


def check_plays(driver):
    driver.run("motexViewer.seek(0)")
    before = state(driver)
    driver.run("motexViewer.play()")
    check(driver.run("return motexViewer.playing"), "play() does not play")
    deadline = time.time() + 10
    while frame(driver) < 20 and time.time() < deadline:
        time.sleep(0.05)
    check(frame(driver) >= 20, "frames do not advance")
    driver.press(" ")
    check(not driver.run("return motexViewer.playing"), "space does not pause")
    stopped = frame(driver)
    check(state(driver)["hash"] != before["hash"], "the picture does not change while playing")
    check(frame(driver) == stopped, "frames advance while paused")


def check_scrubs(driver):
    seen = set()
    for target in (0, 300, 600, 1187):
        driver.run("motexViewer.seek(arguments[0])", target)
        check(frame(driver) == target, f"seek({target}) went to {frame(driver)}")
        seen.add(state(driver)["hash"])
        text = driver.run("return document.getElementById('readout').textContent")
        check(f"frame {target} / 1187" in text and "texton" in text, f"the read-out says {text!r}")
    check(len(seen) == 4, "seeking does not change the picture")
    driver.run("motexViewer.seek(1e9)")
    check(frame(driver) == 1187, "seeking past the end leaves the clip")
    driver.run("const s = document.getElementById('slider'); s.value = 250; s.dispatchEvent(new Event('input'))")
    check(frame(driver) == 250, "the slider does not seek")
    driver.press("\ue014")
    check(frame(driver) == 251, "the right arrow does not step")
    driver.press("\ue012", "\ue012")
    check(frame(driver) == 249, "the left arrow does not step")


def check_pointer(driver):
    box = driver.run("return document.getElementById('view').getBoundingClientRect().toJSON()")
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    before = state(driver)
    driver.pointer((x, y), "down", (x + 120, y + 20), "up")
    turned = state(driver)
    check(turned["hash"] != before["hash"], "dragging does not turn the view")
    strip = driver.run("return document.getElementById('strip').getBoundingClientRect().toJSON()")
    driver.pointer((strip["x"] + strip["width"] * 0.6, strip["y"] + 8))
    tip = driver.run("const t = document.getElementById('tip'); return t.hidden ? '' : t.textContent")
    check(tip.startswith("texton ") and "from salsa_cmu61_10 <frames>" in tip, f"the tip says {tip!r}")
    driver.pointer((strip["x"] + strip["width"] * 0.6, strip["y"] + 8), "down", "up")
    start = driver.run("return JSON.parse(document.getElementById('motex-data').textContent).spans"
                       ".filter(s => s.start <= 0.6 * 1188).pop().start")
    check(frame(driver) == start, f"a click on the strip goes to {frame(driver)}, not {start}")


def check_console(driver):
    errors = [e for e in driver.console() if e["level"] == "SEVERE"]
    check(not errors, f"the console says {errors}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("make_page")
    parser.add_argument("--keep", type=pathlib.Path)
    args = parser.parse_args()
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    chromedriver = shutil.which("chromedriver")
    if not chromium or not chromedriver:
        print("skipped: install chromium and chromium-driver to test the viewer page")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        out = args.keep or pathlib.Path(folder)
        out.mkdir(parents=True, exist_ok=True)
        page = out / "page.html"
        subprocess.run([args.make_page, str(page)], check=True)
        driver = Driver(chromium, chromedriver, pathlib.Path(folder) / "profile")
        try:
            driver.resize(1280, 800)
            driver.call("POST", "/url", {"url": page.resolve().as_uri()})
            for test in (check_loaded, check_not_blank, check_plays, check_scrubs, check_pointer, check_console):
                test(driver)
                print(f"{test.__name__}: ok")
                if args.keep:
                    driver.screenshot(out / f"{test.__name__}.png")
        finally:
            driver.quit()
    return 0


if __name__ == "__main__":
    sys.exit(main())
