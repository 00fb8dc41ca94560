#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the report of a small run in a real browser and uses it as a reader would.

Usage: browser_test.py FLEXNECK      (77: skipped, for want of a browser)
"""

import json
import math
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SKIPPED = 77
try:
    import h5py
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-selenium and python3-h5py")
    sys.exit(SKIPPED)

# The coarsest neck: what the page shows does not depend on it.
COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius=0.4 in"]
WAIT_S = 60  # a busy machine draws slowly; nothing depends on the time taken


def open_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "use-angle=swiftshader",
                     "enable-unsafe-swiftshader", "force-prefers-reduced-motion",
                     "window-size=1200,900"):
        options.add_argument(f"--{argument}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
    return webdriver.Chrome(service=service, options=options)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.workshop = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.workshop.cleanup)
        cls.folder = Path(cls.workshop.name)
        settings = [word for setting in COARSE for word in ("--set", setting)]
        run = subprocess.run([FLEXNECK, "run", "-q", "-o", cls.folder, *settings], check=False)
        assert run.returncode in (0, 1)  # so coarse a neck may miss a published frequency
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get((cls.folder / "report.html").as_uri())
        cls.wait(lambda _: cls.find("#scene-canvas").get_attribute("data-drawn"))

    @classmethod
    def wait(cls, condition):
        return WebDriverWait(cls.browser, WAIT_S).until(condition)

    @classmethod
    def find(cls, selector):
        return cls.browser.find_element(By.CSS_SELECTOR, selector)

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def picture_after(self, act):
        """The canvas once it has been drawn anew after an action: a hash, and its many colours."""
        drawn = lambda: int(self.find("#scene-canvas").get_attribute("data-drawn"))
        before = drawn()
        act()
        self.wait(lambda _: drawn() > before)
        while (latest := drawn()) > before:  # until nothing more is drawn
            before = latest
            time.sleep(0.2)
        return self.run_script("""
            const canvas = document.getElementById('scene-canvas');
            const copy = document.createElement('canvas');
            [copy.width, copy.height] = [canvas.width, canvas.height];
            const context = copy.getContext('2d');
            context.drawImage(canvas, 0, 0);
            const pixels = new Uint32Array(
                context.getImageData(0, 0, copy.width, copy.height).data.buffer);
            let hash = 0;
            for (const pixel of pixels) hash = (Math.imul(hash, 31) + pixel) | 0;
            return {hash, colours: new Set(pixels).size};""")

    def set_clock(self, value):
        self.run_script("""
            const clock = document.getElementById('scene-clock');
            clock.value = arguments[0];
            clock.dispatchEvent(new Event('input'));""", value)

    def cells(self, table):
        """The texts of a table's body, as a reader sees them."""
        return self.run_script("""
            return [...document.querySelectorAll(`[data-table='${arguments[0]}'] tbody tr`)]
                .map((row) => [...row.cells].map((cell) => cell.innerText.trim()));""", table)

    def centre(self, element):
        """Scrolls it to where nothing covers it."""
        self.run_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})",
                        element)
        return element

    def show(self, text):
        """Chooses a mode or a run, with the canvas in view."""
        self.centre(self.find("#scene-canvas"))
        Select(self.find("#scene-source")).select_by_visible_text(text)

    def sources(self):
        return [option.text for option in Select(self.find("#scene-source")).options]

    # --- the page -------------------------------------------------------------------------------

    def test_1_opens_without_complaint_and_without_the_network(self):
        self.assertEqual(self.browser.get_log("browser"), [])
        opened = self.run_script("""
            const [page] = performance.getEntriesByType('navigation');
            return [page.loadEventEnd, performance.getEntriesByType('resource')
                .map((entry) => entry.name).filter((name) => !name.startsWith('data:'))];""")
        print(f"opened in {opened[0] / 1000:.2f} s, "
              f"{(self.folder / 'report.html').stat().st_size / 1e6:.1f} MB")
        self.assertEqual(opened[1], [])
        self.assertLess((self.folder / "report.html").stat().st_size, 10e6)

    def test_verification_shows_the_numbers_of_its_file(self):
        rows = json.loads((self.folder / "verification.json").read_text())["rows"]
        shown = self.cells("verification")
        self.assertEqual([row[:5] for row in shown],
                         [[row[key] for key in ("quantity", "detail", "value", "reference", "unit")]
                          for row in rows])
        verdicts = {"passed": "pass", "failed": "FAIL"}
        for row, cells in zip(rows, shown):
            self.assertEqual(verdicts.get(row["status"], "") in cells[6], True)
            self.assertEqual("fitted" in cells[6], row["fitted"])

    def test_result_tables_show_the_cells_of_their_files(self):
        tables = [table for name in ("pendulum.json", "static.json")
                  for table in json.loads((self.folder / name).read_text())["tables"]]
        self.assertGreater(len(tables), 1)
        for table in tables:
            self.assertEqual(self.cells(table["name"]), table["rows"])

    def test_modes_show_the_frequencies_of_their_file(self):
        with h5py.File(self.folder / "modes.h5") as file:
            frequencies = file["frequencies"][:]
            names = [name.decode() for name in file["mode_names"][:]]
        shown = self.cells("modes")
        self.assertEqual([row[0] for row in shown], names)
        for row, frequency in zip(shown, frequencies):
            self.assertEqual(row[2], f"{frequency:.3f}")

    def test_origins_can_be_hidden(self):
        everything = len(self.cells("parameters"))
        button = self.find("#origins [data-origin=inferred]")
        hidden = "return document.querySelectorAll('[data-table=parameters] tr[hidden]').length"
        self.run_script("arguments[0].click()", button)
        count = self.run_script(hidden)
        self.assertTrue(0 < count < everything)
        self.assertIn(str(count), button.text)
        self.run_script("arguments[0].click()", button)
        self.assertEqual(self.run_script(hidden), 0)

    # --- three dimensions -----------------------------------------------------------------------

    def test_the_neck_turns_by_mouse_and_keyboard(self):
        self.show(self.sources()[0])
        before = self.picture_after(lambda: self.set_clock(0.25))
        self.assertGreater(before["colours"], 50)  # a blank canvas has one
        canvas = self.find("#scene-canvas")
        drag = ActionChains(self.browser).move_to_element(canvas).click_and_hold() \
            .move_by_offset(120, 20).release()
        dragged = self.picture_after(drag.perform)
        self.assertNotEqual(dragged["hash"], before["hash"])
        turned = self.picture_after(lambda: canvas.send_keys(Keys.ARROW_LEFT))
        self.assertNotEqual(turned["hash"], dragged["hash"])
        home = self.picture_after(lambda: canvas.send_keys(Keys.HOME))
        self.assertEqual(home["hash"], before["hash"])

    def test_modes_and_motions_move(self):
        motion = next(name for name in self.sources() if name.startswith("Pendulum"))
        for source, late in ((self.sources()[0], 0.25), (motion, 0.06)):
            self.show(source)
            still = self.picture_after(lambda: self.set_clock(0))
            moved = self.picture_after(lambda: self.set_clock(late))
            self.assertNotEqual(still["hash"], moved["hash"], source)
            self.assertGreater(moved["colours"], 50)

    def test_a_mode_has_its_brightest_colour_at_its_largest_displacement_only(self):
        """Viridis' upper end on a few pixels, its lower at the clamped base, much in between."""
        self.show(self.sources()[0])
        self.picture_after(lambda: self.set_clock(0.25))
        shares = self.run_script("""
            const canvas = document.getElementById('scene-canvas');
            const copy = document.createElement('canvas');
            [copy.width, copy.height] = [canvas.width, canvas.height];
            const context = copy.getContext('2d');
            context.drawImage(canvas, 0, 0);
            const {data} = context.getImageData(0, 0, copy.width, copy.height);
            const counts = {yellow: 0, green: 0, violet: 0, all: 0};
            for (let i = 0; i < data.length; i += 4) {
              const [red, green, blue] = data.subarray(i, i + 3);
              if (data[i + 3] < 255 || Math.max(red, green, blue) < 1.25 * Math.min(red, green, blue))
                continue;  // nothing, lines
              ++counts.all;
              if (red > 0.8 * green && green > 2 * blue) ++counts.yellow;
              else if (green > 1.2 * red && green > 1.2 * blue) ++counts.green;
              else if (blue > green && red > 0.4 * blue) ++counts.violet;
            }
            return counts;""")
        self.assertGreater(shares["all"], 1000)
        self.assertLess(shares["yellow"], 0.3 * shares["all"], shares)
        self.assertGreater(shares["green"], 0.05 * shares["all"], shares)
        self.assertGreater(shares["violet"], 0.05 * shares["all"], shares)

    def test_play_runs_and_stops(self):
        self.show(self.sources()[0])
        self.centre(self.find("#scene-play")).click()
        first = self.find("#scene-time").text
        self.wait(lambda _: self.find("#scene-time").text != first)
        self.find("#scene-play").click()
        stopped = self.find("#scene-time").text
        time.sleep(0.3)
        self.assertEqual(self.find("#scene-time").text, stopped)

    # --- curves ---------------------------------------------------------------------------------

    def plot(self):
        return self.find(".plot[data-kind=pendulum]")

    def read_curve(self, plot, x, case):
        """Moves the reading line to a share of the plot's width and returns (x, value)."""
        svg = plot.find_element(By.CSS_SELECTOR, ".drawing svg")
        self.centre(svg)
        ActionChains(self.browser).move_to_element_with_offset(
            svg, int((x - 0.5) * svg.size["width"]), 0).perform()
        reading = plot.find_element(By.TAG_NAME, "output").text.split(":")[0].removeprefix("at ")
        value = plot.find_element(By.CSS_SELECTOR, f"[data-curve='{case}'] .value").text
        return [float(text.replace("−", "-")) for text in (reading, value)]

    def test_a_value_read_off_a_curve_is_the_one_of_the_file(self):
        case = "flexion-60"
        time_ms, rotation_deg = self.read_curve(self.plot(), 0.2, case)
        with h5py.File(self.folder / f"pendulum-{case}.h5") as file:
            times = file["time"][:]
            values = file["channels/head rotation/values"][:, 0]
        nearest = abs(times - time_ms / 1000).argmin()
        around = [math.degrees(values[k]) for k in (nearest - 1, nearest, nearest + 1)]
        # The reading has four digits, so the neighbours of the nearest time come into question.
        self.assertLess(min(abs(rotation_deg - each) for each in around),
                        2e-3 * max(abs(each) for each in around))

    def test_cases_are_compared_and_zoomed(self):
        plot = self.plot()
        curves = lambda: plot.find_elements(By.CSS_SELECTOR, ".drawing path.curve")
        shown = len(curves())
        button = plot.find_element(By.CSS_SELECTOR, "[data-choice=flexion-60]")
        self.run_script("arguments[0].click()", button)
        self.assertEqual(len(curves()), shown - 1)
        self.run_script("arguments[0].click()", button)
        self.assertEqual(len(curves()), shown)
        ticks = lambda: [tick.text for tick in plot.find_elements(By.CSS_SELECTOR, ".axis text")]
        everything = ticks()
        svg = self.centre(plot.find_element(By.CSS_SELECTOR, ".drawing svg"))
        ActionChains(self.browser).move_to_element_with_offset(svg, -150, 0).click_and_hold() \
            .move_by_offset(120, 0).release().perform()
        self.assertNotEqual(ticks(), everything)
        svg.send_keys(Keys.HOME)
        self.assertEqual(ticks(), everything)

    def test_no_two_curves_of_the_study_look_alike(self):
        for kind in ("pendulum", "static"):
            plot = self.find(f".plot[data-kind={kind}]")
            for choice in plot.find_elements(By.CSS_SELECTOR, "[data-choice][aria-pressed=false]"):
                self.run_script("arguments[0].click()", choice)
            runs = len(list(self.folder.glob(f"{kind}-*.h5")))
            styles = self.run_script("""
                return [...arguments[0].querySelectorAll('.drawing path.curve')].map((path) => {
                  const {stroke, strokeDasharray, strokeWidth} = getComputedStyle(path);
                  return [stroke, strokeDasharray, strokeWidth].join(' | ');
                });""", plot)
            legend = self.run_script("""
                return [...arguments[0].querySelectorAll('.legend line')].map((line) => {
                  const {stroke, strokeDasharray, strokeWidth} = getComputedStyle(line);
                  return [stroke, strokeDasharray, strokeWidth].join(' | ');
                });""", plot)
            self.assertEqual(len(styles), runs)
            self.assertEqual(len(set(styles)), runs)
            self.assertEqual(legend, styles)

    def test_si_units_are_a_button_away(self):
        units = self.find("#units")
        label = lambda: self.plot().find_element(By.CSS_SELECTOR, "svg[role=img]") \
            .get_attribute("aria-label")
        self.assertIn("(deg)", label())
        self.run_script("arguments[0].click()", units)
        self.assertIn("(rad)", label())
        self.run_script("arguments[0].click()", units)
        self.assertIn("(deg)", label())

    # --- readers --------------------------------------------------------------------------------

    def test_fits_a_phone(self):
        width = self.run_script("return document.documentElement.clientWidth")
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 360, "height": 740, "deviceScaleFactor": 1, "mobile": True})
        try:
            self.wait(lambda _: self.run_script(
                "return document.documentElement.scrollWidth") <= 360)
        finally:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            self.wait(lambda _: self.run_script(
                "return document.documentElement.clientWidth") == width)

    def test_every_control_has_a_name(self):
        nameless = self.run_script("""
            return [...document.querySelectorAll('button, select, input')]
                .filter((control) => !(control.textContent.trim() && control.matches('button'))
                    && !control.getAttribute('aria-label') && !control.closest('label'))
                .map((control) => control.outerHTML);""")
        self.assertEqual(nameless, [])

    def test_z_used_without_complaint(self):
        self.assertEqual(self.browser.get_log("browser"), [])


if __name__ == "__main__":
    for program in ("chromium", "chromedriver"):
        if not shutil.which(program):
            print(f"SKIPPED: there is no {program}; install chromium and chromium-driver")
            sys.exit(SKIPPED)
    FLEXNECK = sys.argv.pop(1)
    unittest.main(verbosity=2)
