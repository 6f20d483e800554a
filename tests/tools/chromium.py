"""Chromium without a window, driven by its DevTools protocol over a pipe; nothing but Python's own library is needed."""

import base64
import contextlib
import itertools
import json
import os
import select
import shutil
import subprocess
import time

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
OPTIONS = ("--headless", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run", "--disable-extensions",
           "--disable-background-networking", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
           "--remote-debugging-pipe")
SECONDS = 300  # for what a page is waited for
PAUSE = 0.1


class Browser:
    """One browser with a profile of its own; its tabs are pages."""

    def __init__(self, profile):
        (theirs_in, self.to), (self.of, theirs_out) = os.pipe(), os.pipe()
        command = ["sh", "-c", f'exec "$@" 3<&{theirs_in} 4>&{theirs_out}', "sh", BROWSER, *OPTIONS, f"--user-data-dir={profile}", "about:blank"]
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        pass_fds=(theirs_in, theirs_out))
        os.close(theirs_in)
        os.close(theirs_out)
        self.numbers, self.answers, self.events, self.rest = itertools.count(1), {}, [], b""

    def close(self):
        """Ends it."""
        with contextlib.suppress(OSError):
            self.send("Browser.close", None, {})
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(10)
        self.process.kill()
        self.process.wait()
        os.close(self.to)
        os.close(self.of)

    def send(self, method, session, values):
        """Sends a call; its number."""
        number = next(self.numbers)
        words = {"id": number, "method": method, "params": values} | ({"sessionId": session} if session else {})
        os.write(self.to, json.dumps(words).encode() + b"\0")
        return number

    def call(self, method, session=None, **values):
        """Sends a call; its answer."""
        number, end = self.send(method, session, values), time.monotonic() + SECONDS
        while number not in self.answers:
            self.listen(end)
        answer = self.answers.pop(number)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def listen(self, end):
        """Takes what the browser says, until then at most."""
        if not select.select([self.of], [], [], max(0.0, end - time.monotonic()))[0]:
            raise TimeoutError("Chromium does not answer")
        piece = os.read(self.of, 2**16)
        if not piece:
            raise ConnectionError("Chromium has ended")
        *whole, self.rest = (self.rest + piece).split(b"\0")
        for words in map(json.loads, whole):
            if "id" in words:
                self.answers[words["id"]] = words
            else:
                self.events.append(words)

    def page(self, address, width=1300, height=900):
        """A new tab."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        return Page(self, target, self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"], address, width, height)


class Page:
    """A tab."""

    def __init__(self, browser, target, session, address, width, height):
        self.browser, self.target, self.session = browser, target, session
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height)
        self.call("Page.navigate", url=address)

    def call(self, method, **values):
        """A call for this tab."""
        return self.browser.call(method, self.session, **values)

    def close(self):
        """Ends it."""
        self.browser.call("Target.closeTarget", targetId=self.target)

    def resize(self, width, height):
        """The size of its window."""
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def run(self, script):
        """The value of an expression of JavaScript."""
        found = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"].get("exception", {}).get("description", "failed"))
        return found["result"].get("value")

    def wait(self, script, seconds=SECONDS):
        """Waits until an expression is true; its value."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            with contextlib.suppress(RuntimeError):  # while it loads
                if value := self.run(script):
                    return value
            time.sleep(PAUSE)
        raise TimeoutError(f"never true: {script}\n{self.run('document.body.innerText')[:3000]}")

    def type(self, selector, words):
        """Puts words in the place of those in a field, as from the keyboard."""
        self.wait(f"!!document.querySelector({json.dumps(selector)})")
        self.run(f"(() => {{ const one = document.querySelector({json.dumps(selector)}); one.scrollIntoView({{block: 'center'}}); one.focus(); "
                 "if (one.select) one.select(); else document.execCommand('selectAll'); })()")
        self.call("Input.insertText", text=words)

    def press(self, words, among="button, [role=tab], .q-item, .q-expansion-item__container .q-item"):
        """Clicks on what has these words."""
        found = f"Array.from(document.querySelectorAll({json.dumps(among)})).find((one) => one.offsetParent && one.innerText.trim().toLowerCase()" \
                f".includes({json.dumps(words.lower())}))"
        self.wait(f"!!{found}")
        self.run(f"{found}.click()")

    def complaints(self):
        """What the console has of errors, and what was asked for elsewhere than at its own address."""
        with contextlib.suppress(TimeoutError):
            while True:
                self.browser.listen(time.monotonic())
        own = [one for one in self.browser.events if one.get("sessionId") == self.session]
        said = [one["params"]["entry"]["text"] for one in own if one["method"] == "Log.entryAdded" and one["params"]["entry"]["level"] == "error"]
        said += [str(one["params"]["args"]) for one in own if one["method"] == "Runtime.consoleAPICalled" and one["params"]["type"] == "error"]
        said += [one["params"]["exceptionDetails"].get("exception", {}).get("description", "exception") for one in own
                 if one["method"] == "Runtime.exceptionThrown"]
        return said

    def asked(self):
        """Addresses that the page has asked for."""
        return [one["params"]["request"]["url"] for one in self.browser.events
                if one.get("sessionId") == self.session and one["method"] == "Network.requestWillBeSent"]

    def picture(self, path):
        """Writes what is seen."""
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
