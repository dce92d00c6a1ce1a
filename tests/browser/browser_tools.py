"""A headless Chromium that tests steer, and what they hold pages against."""
import base64
import sys
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By  # noqa: F401
    from selenium.webdriver.common.keys import Keys  # noqa: F401
except ImportError:
    print("python3-selenium is not installed")
    sys.exit(77)
for program in ("/usr/bin/chromium", "/usr/bin/chromedriver"):
    if not Path(program).exists():
        print(f"{program} is not installed")
        sys.exit(77)

AXE = Path(__file__).resolve().parents[2] / "build/tools/package/axe.min.js"  # scripts/setup --tests fetches it
CHROMIUM = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader", "--disable-background-networking", "--no-first-run"]
failures = []


def check(good, what):
    print(("ok      " if good else "FAILED  ") + what)
    if not good:
        failures.append(what)


def browser():
    options = Options()
    options.binary_location = "/usr/bin/chromium"
    for argument in CHROMIUM:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.set_script_timeout(300)
    return driver


def wait_for_viewer(driver):
    for _ in range(200):
        state = driver.execute_script("return document.body.dataset.viewer")
        if state:
            return state
        driver.implicitly_wait(0.05)
        driver.execute_async_script("setTimeout(arguments[0], 50)")
    return "nothing"


def set_width(driver, width, height=900):
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})


def save_screenshot(driver, file):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(base64.b64decode(driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "format": "png"})["data"]))


def check_accessible(driver, name):
    """No serious or critical finding of axe-core on the page as it is shown, in light and in dark."""
    if not AXE.exists():
        print(f"skipped {name}: axe-core is not there, so its accessibility is not judged (scripts/setup --tests)")
        return
    for scheme in ("light", "dark"):
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
        driver.execute_cdp_cmd("Runtime.evaluate", {"expression": AXE.read_text(encoding="utf-8")})
        found = driver.execute_async_script("""const done = arguments[0]; axe.run(document, {preload: false}).then(r => done({passes: r.passes.length, violations:
          r.violations.filter(v => ['serious', 'critical'].includes(v.impact)).map(v => v.id + ' (' + v.impact + '), '
            + v.nodes.length + ' times, first: ' + v.nodes[0].html.slice(0, 200))}))""")
        check(found["passes"] > 5, f"{name}, {scheme}: axe-core has looked at it ({found['passes']} rules pass)")
        check(not found["violations"], f"{name}, {scheme}: nothing serious is inaccessible" + "".join("\n        " + v for v in found["violations"]))
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def check_console(driver):
    errors = [e["message"] for e in driver.get_log("browser") if e["level"] == "SEVERE"]
    check(not errors, "the console has no error" + "".join("\n        " + e for e in errors))


def finish():
    sys.exit(f"{len(failures)} failed" if failures else 0)
