#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the report of a small run, and a comparison, in a real browser and uses them as a reader would.

Usage: browser_test.py FLEXNECK FOLDER      (77: skipped, for want of a browser)
FOLDER keeps axe-core, which npm installs there in the version that axe/package-lock.json names.
"""

import base64
import csv
import json
import math
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
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

# The coarsest neck: the page does not depend on the mesh.
COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius=0.4 in"]
WAIT_S = 60  # a busy machine draws slowly; nothing depends on the time taken


def open_browser(*more):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("headless=new", "no-sandbox", "disable-dev-shm-usage", "force-prefers-reduced-motion",
                     "window-size=1200,900", *(more or ("use-angle=swiftshader", "enable-unsafe-swiftshader"))):
        options.add_argument(f"--{argument}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(shutil.which("chromedriver"))
    browser = webdriver.Chrome(service=service, options=options)
    browser.set_script_timeout(5 * WAIT_S)
    return browser


def axe_source():
    """None where npm, or its registry, is not to be had."""
    here = Path(__file__).resolve().parent / "axe"
    source = AXE_FOLDER / "node_modules/axe-core/axe.min.js"
    wanted = json.loads((here / "package.json").read_text())["dependencies"]["axe-core"]
    package = source.with_name("package.json")
    if not package.exists() or json.loads(package.read_text())["version"] != wanted:
        AXE_FOLDER.mkdir(parents=True, exist_ok=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(here / name, AXE_FOLDER)
        npm = shutil.which("npm")
        if not npm or subprocess.run([npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund"], cwd=AXE_FOLDER,
                                     check=False).returncode != 0:
            return None
    return source.read_text()


def setUpModule():
    """One run for all tests, which do not write into it."""
    workshop = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(workshop.cleanup)
    Page.folder = Path(workshop.name) / "out"
    settings = [word for setting in COARSE for word in ("--set", setting)]
    run = subprocess.run([FLEXNECK, "run", "-q", "-o", Page.folder, *settings], check=False)
    assert run.returncode in (0, 1)  # so coarse a neck may miss a published frequency


class Page:
    """What tests of any page of ours do."""

    @classmethod
    def wait(cls, condition):
        return WebDriverWait(cls.browser, WAIT_S).until(condition)

    @classmethod
    def find(cls, selector):
        return cls.browser.find_element(By.CSS_SELECTOR, selector)

    def run_script(self, script, *arguments):
        return self.browser.execute_script(script, *arguments)

    def saved(self, button, suffix):
        """What a button saves, as a path."""
        target = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                     {"behavior": "allow", "downloadPath": str(target)})
        self.run_script("arguments[0].click()", button)
        self.wait(lambda _: list(target.glob(f"*.{suffix}")))
        return next(target.glob(f"*.{suffix}"))

    def check_by_axe(self):
        """WCAG 2.1 AA as far as axe-core sees it, in light and dark."""
        axe = axe_source()
        if axe is None:
            self.skipTest("axe-core cannot be installed: npm and its registry are wanted")
        for scheme in ("light", "dark"):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {
                "features": [{"name": "prefers-color-scheme", "value": scheme}]})
            self.run_script(axe + "; window.axe = axe;")
            violations = self.browser.execute_async_script("""
                const done = arguments[0];
                axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa'], resultTypes: ['violations']})
                    .then(({violations}) => done(violations.map(({id, nodes}) => [id, nodes.slice(0, 3).map(
                        (node) => [node.target.join(' '), node.failureSummary])])));""")
            self.assertEqual(violations, [], scheme)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


class Report(Page, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get((cls.folder / "report.html").as_uri())
        cls.wait(lambda _: cls.find("#scene-canvas").get_attribute("data-drawn"))

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

    def first_mode(self):
        return next(name for name in self.sources() if name.startswith("Mode 1"))

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
        self.show(self.first_mode())
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
        for source, late in ((self.first_mode(), 0.25), (motion, 0.06)):
            self.show(source)
            still = self.picture_after(lambda: self.set_clock(0))
            moved = self.picture_after(lambda: self.set_clock(late))
            self.assertNotEqual(still["hash"], moved["hash"], source)
            self.assertGreater(moved["colours"], 50)

    def pixels_like(self, colour):
        """How many pixels of the canvas are near a colour."""
        return self.run_script("""
            const canvas = document.getElementById('scene-canvas');
            const copy = document.createElement('canvas');
            [copy.width, copy.height] = [canvas.width, canvas.height];
            const context = copy.getContext('2d');
            context.drawImage(canvas, 0, 0);
            const {data} = context.getImageData(0, 0, copy.width, copy.height);
            let count = 0;
            for (let i = 0; i < data.length; i += 4) {
              if (arguments[0].every((part, k) => Math.abs(part - data[i + k]) < 40) && data[i + 3] > 250) ++count;
            }
            return count;""", colour)

    def test_loads_of_a_static_test_are_drawn(self):
        self.show("Static test: flexion")
        orange = (0xd5, 0x5e, 0x00)
        self.picture_after(lambda: self.set_clock(0))
        without = self.pixels_like(orange)  # the axis x
        self.picture_after(lambda: self.set_clock(2))
        self.assertGreater(self.pixels_like(orange), without + 100)
        with h5py.File(self.folder / "static-flexion.h5") as file:
            newton = file["channels/load/values"][-1, 0]
        self.assertAlmostEqual(float(self.find("#scene-time").text.split(", ")[1].split()[0]), newton / 4.4482216,
                               delta=0.1)

    def test_rigid_variants_move_and_two_cases_stand_side_by_side(self):
        names = [f"Pendulum: {path.stem.removeprefix('pendulum-')}" for path in self.folder.glob("pendulum-*.h5")]
        self.assertEqual(set(names) - set(self.sources()), set())
        self.show("Pendulum: flexion-120-rigid")
        alone = self.picture_after(lambda: self.set_clock(0.05))
        beside = self.picture_after(lambda: Select(self.find("#scene-second")).select_by_visible_text(
            "Pendulum: flexion-120"))
        self.assertNotEqual(alone["hash"], beside["hash"])
        self.assertIn("Right: Pendulum: flexion-120.", self.find("#scene-note").text)
        options = [option.text for option in Select(self.find("#scene-second")).options]
        self.assertFalse([name for name in options if name.startswith(("Mode", "Static"))])
        Select(self.find("#scene-second")).select_by_visible_text("nothing")

    def test_a_mode_has_its_brightest_colour_at_its_largest_displacement_only(self):
        """Viridis' upper end on a few pixels, its lower at the clamped base, much in between."""
        self.show(self.first_mode())
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
        self.show(self.first_mode())
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
        # The reading has four digits, so the neighbours of the nearest time are possible, too.
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

    def choose_units(self, system):
        self.run_script("""
            const units = document.getElementById('units');
            units.value = arguments[0];
            units.dispatchEvent(new Event('change'));""", system)

    def test_units_change_in_curves_tables_and_inputs(self):
        label = lambda: self.find(".plot[data-kind=static] svg[role=img]").get_attribute("aria-label")
        head = lambda: self.run_script("""
            return document.querySelector("[data-table='peaks'] th[data-unit='lbf*ft']").textContent;""")
        inputs = dict(row[:2] for row in self.cells("parameters"))
        thickness = inputs["geometry.plate_thickness"]
        inches = float(thickness.split()[0])
        self.assertIn("(in·lbf)", label())
        before = self.cells("peaks")
        self.choose_units("metric")
        try:
            self.assertIn("(N·m)", label())
            self.assertIn("(deg)", label())
            self.assertIn("N·m", head())
            column = self.run_script("""
                const head = document.querySelector("[data-table='peaks'] th[data-unit='lbf*ft']");
                return [...head.parentElement.cells].indexOf(head);""")
            for customary, metric in zip(before, self.cells("peaks")):
                number = lambda text: float(text.replace("−", "-"))
                self.assertAlmostEqual(number(metric[column]), 1.3558179483 * number(customary[column]), delta=0.06)
                self.assertEqual(metric[1], customary[1])  # degrees stay degrees
            shown = dict(row[:2] for row in self.cells("parameters"))["geometry.plate_thickness"]
            self.assertEqual(shown, f"{thickness} ({float(f'{25.4 * inches:.5g}'):g} mm)")
        finally:
            self.choose_units("customary")
        self.assertEqual(self.cells("peaks"), before)

    # --- downloads --------------------------------------------------------------------------------

    def test_curves_are_saved_as_they_are_drawn(self):
        path = self.saved(self.plot().find_element(By.CSS_SELECTOR, "[data-save=csv]"), "csv")
        with open(path, newline="", encoding="utf-8") as text:
            head, *rows = csv.reader(text)
        self.assertEqual(head[0], "time [ms]")
        case = "flexion-60"
        column = head.index(f"{case}: head rotation [deg]")
        with h5py.File(self.folder / f"pendulum-{case}.h5") as file:
            values = dict(zip(file["time"][:], file["channels/head rotation/values"][:, 0]))
        self.assertGreater(len(rows), 500)
        times = sorted(values)
        for row in rows[::50]:
            nearest = min(times, key=lambda time_s: abs(1000 * time_s - float(row[0])))
            self.assertAlmostEqual(float(row[column]), math.degrees(values[nearest]), delta=1e-4)

    def test_pictures_are_saved_as_svg_and_png(self):
        svg = self.saved(self.plot().find_element(By.CSS_SELECTOR, "[data-save=svg]"), "svg").read_text()
        texts = [each.text for each in xml.etree.ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("flexion-60", texts)  # the legend goes along
        self.assertIn("time (ms)", texts)
        for selector in ("#scene-turn [data-save=png]", ".plot [data-save=png]", "#figure-11 [data-save=png]"):
            data = self.saved(self.find(selector), "png").read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n", selector)
            self.assertGreater(int.from_bytes(data[16:20], "big"), 600, selector)
        figure = self.saved(self.find("#figure-11 [data-save=svg]"), "svg").read_text()
        self.assertEqual(figure, (self.folder / "figures/figure-11.svg").read_text())

    def test_inputs_are_searched(self):
        field = self.find("input[aria-label^='Search: Every input']")
        shown = lambda: self.run_script("""
            return [...document.querySelectorAll('[data-table=parameters] tbody tr')]
                .filter((row) => row.offsetParent).map((row) => row.textContent);""")
        everything = len(shown())
        self.run_script("arguments[0].scrollIntoView({block: 'center'})", field)
        field.send_keys("plate inferred")
        some = shown()
        self.assertTrue(0 < len(some) < everything / 4, some)
        self.assertEqual([row for row in some if "plate" not in row or "inferred" not in row], [])
        field.send_keys(Keys.CONTROL + "a", Keys.DELETE)
        self.assertEqual(len(shown()), everything)

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

    def test_prints_within_the_margins(self):
        """A4 less margins of a centimetre is 718 pixels wide."""
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": 718, "height": 1000, "deviceScaleFactor": 1, "mobile": False})
        try:
            wide = self.run_script("""
                return [...document.querySelectorAll('body *')]
                    .filter((each) => each.getBoundingClientRect().right > 719 && each.getClientRects().length > 0)
                    .map((each) => each.tagName + ' ' + each.textContent.trim().slice(0, 40));""")
            self.assertEqual(wide[:5], [])
        finally:
            self.browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertGreater(len(base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {})["data"])), 1e5)

    def test_axe_finds_nothing(self):
        self.check_by_axe()

    def test_every_control_has_a_name(self):
        nameless = self.run_script("""
            return [...document.querySelectorAll('button, select, input')]
                .filter((control) => !(control.textContent.trim() && control.matches('button'))
                    && !control.getAttribute('aria-label') && !control.closest('label'))
                .map((control) => control.outerHTML);""")
        self.assertEqual(nameless, [])

    def test_z_used_without_complaint(self):
        self.assertEqual(self.browser.get_log("browser"), [])


class Comparison(Page, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.workshop = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.workshop.cleanup)
        folders = [Path(cls.workshop.name) / name for name in ("one", "two")]
        for folder in folders:
            shutil.copytree(cls.folder, folder)
        subprocess.run([FLEXNECK, "compare", "-q", "-o", cls.workshop.name, *folders], check=True)
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)
        cls.browser.get((Path(cls.workshop.name) / "comparison.html").as_uri())
        cls.wait(lambda _: cls.find("#scene-canvas").get_attribute("data-drawn"))

    def test_all_folders_are_shown_at_once(self):
        curves = [each.get_attribute("data-curve") for each in self.browser.find_elements(
            By.CSS_SELECTOR, ".plot[data-kind=pendulum] .legend li")]
        self.assertTrue({"flexion-60", "flexion-60-two"} <= set(curves), curves)
        first, second = (Select(self.find(f"#scene-{menu}")).first_selected_option.text
                         for menu in ("source", "second"))
        self.assertEqual((first.replace("one: ", ""), first[:3]), (second.replace("two: ", ""), "one"))
        links = [each.get_attribute("href").partition("#")[2] for each in self.browser.find_elements(
            By.CSS_SELECTOR, "nav a")]
        self.assertGreater(len(links), 5)
        self.assertEqual([link for link in links if not self.find(f"#{link}")], [])
        self.assertEqual(self.browser.get_log("browser"), [])

    def test_axe_finds_nothing(self):
        self.check_by_axe()


class WithoutWebGL(Page, unittest.TestCase):
    def test_pictures_stand_in(self):
        type(self).browser = open_browser("disable-3d-apis", "disable-gpu")
        self.addCleanup(self.browser.quit)
        self.browser.get((self.folder / "report.html").as_uri())
        self.wait(lambda _: self.browser.find_elements(By.CSS_SELECTOR, ".viewer figure img"))
        sizes = self.wait(lambda _: self.run_script("""
            const images = [...document.querySelectorAll('.viewer figure img')];
            return images.every((image) => image.complete) && images.map((image) => image.naturalWidth);"""))
        self.assertGreaterEqual(len(sizes), 3)
        self.assertGreater(min(sizes), 100)

    def test_figures_that_are_not_drawn_do_not_stand_in(self):
        workshop = tempfile.TemporaryDirectory()
        self.addCleanup(workshop.cleanup)
        folder = Path(workshop.name) / "less"
        shutil.copytree(self.folder, folder)
        for run in folder.glob("static-*"):
            run.unlink()
        subprocess.run([FLEXNECK, "report", "-q", "-o", folder], check=True)
        page = (folder / "report.html").read_text()
        self.assertIn("Not drawn, since this is missing:", page)
        type(self).browser = open_browser("disable-3d-apis", "disable-gpu")
        self.addCleanup(self.browser.quit)
        self.browser.get((folder / "report.html").as_uri())
        self.wait(lambda _: self.browser.find_elements(By.CSS_SELECTOR, ".viewer figure img"))


if __name__ == "__main__":
    for program in ("chromium", "chromedriver"):
        if not shutil.which(program):
            print(f"SKIPPED: there is no {program}; install chromium and chromium-driver")
            sys.exit(SKIPPED)
    FLEXNECK, AXE_FOLDER = sys.argv.pop(1), Path(sys.argv.pop(1))
    unittest.main(verbosity=2)
