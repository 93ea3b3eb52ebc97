"""The page of an assessment, as a browser shows it at desktop and at phone width."""

import json
import os
import re
import signal
import subprocess
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from queue import SimpleQueue

import pytest

from browser import CHROMIUM, QUIET, needs_browser
from yawdamp_ros import load_vehicle
from yawdamp_ros.analysis import MEASURES, Assessment, assess, load_scheme
from yawdamp_ros.cli import run
from yawdamp_ros.pictures.assessment_page import assessment_page
from yawdamp_ros.vehicle import builtin_vehicles

# A frame of the width in question, which is told about from outside: the page has no part in it.
FRAME = """<!DOCTYPE html><link rel="icon" href="data:,"><body>
<iframe src="page.html" width="{width}" height="900"></iframe>
<script>
const frame = document.querySelector("iframe"), page = () => frame.contentDocument;
const box = (selector) => [...page().querySelectorAll(selector)];
const clock = () => page().getElementById("clock").value;
frame.addEventListener("load", () => {{
  const begun = clock();
  // Counted in frames, which a busy machine draws seldom.
  const after = (frames, then) => frame.contentWindow.requestAnimationFrame(
    () => frames ? after(frames - 1, then) : then());
  after(30, () => {{
    fetch("told", {{ method: "POST", body: JSON.stringify({{
      width: frame.clientWidth,
      needed: page().documentElement.scrollWidth,
      outside: box("main *").filter((each) => each.getBoundingClientRect().right > frame.clientWidth + 1
        && !each.closest("svg, .scroll table")).map((each) => each.outerHTML.slice(0, 80)),
      background: getComputedStyle(page().body).backgroundColor,
      verdict: page().getElementById("verdict").textContent,
      rows: box("#rows tr").map((row) => [...row.children].map((cell) => cell.textContent)),
      lane_change: !page().getElementById("lane-change").hidden,
      moved: clock() !== begun,
      units: box("#plan g[transform]").length,
      modes: box("#modes figure").length,
      lines: box("section:not(#turns) figure polyline")
        .filter((each) => each.getBoundingClientRect().width > 100).length,
      definitions: box("#definitions dt").length,
      heading: page().getElementById("heading").textContent,
      turns: box("#turns svg").length,
      drawings: box("#vehicles svg").length,
      pictures: box("#pictures h3").map((each) => each.textContent.split(":")[0]),
      tables: box(".scroll").map((each) => each.previousSibling.textContent),
    }}) }});
  }});
}});
</script></body>"""


class Handler(SimpleHTTPRequestHandler):
    """Serves a directory, remembers what was asked for, and takes what the frame tells."""

    server: "Served"

    def do_POST(self) -> None:
        self.server.told.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_: object) -> None:
        self.server.asked.add(self.path)


class Served(ThreadingHTTPServer):
    """On loopback, at a port of its own."""

    def __init__(self, directory: Path) -> None:
        super().__init__(("127.0.0.1", 0), partial(Handler, directory=str(directory)))
        self.directory = directory
        self.asked: set[str] = set()
        self.told: SimpleQueue[dict[str, object]] = SimpleQueue()

    def looked_at(self, width: int, *flags: str) -> dict[str, object]:
        """What a browser shows of page.html in a frame of a width."""
        (self.directory / "frame.html").write_text(FRAME.format(width=width), encoding="utf-8")
        command = [
            *(
                str(CHROMIUM),
                *QUIET,
                "--remote-debugging-port=0",
                *flags,
                f"--user-data-dir={self.directory / 'profile'}",
            ),
            f"http://127.0.0.1:{self.server_port}/frame.html",
        ]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True) as process:
            try:
                told = self.told.get(timeout=60.0)
            finally:
                os.killpg(process.pid, signal.SIGTERM)
                _, said = process.communicate(timeout=20.0)
        assert "CONSOLE" not in said, said
        return told


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    with Served(tmp_path) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server
        server.shutdown()
        thread.join()


@needs_browser
@pytest.mark.parametrize("width", [1280, 390])
def test_page_fits_and_shows_everything(
    width: int, served: Served, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "page.html"
    assert run(["assess", "--vehicle", "a_double", "--html", str(page)]) == 1
    capsys.readouterr()
    shown = served.looked_at(width)
    assert shown["width"] == width
    assert shown["needed"] <= width
    assert shown["outside"] == []
    assert shown["verdict"] == "Fails: high speed transient offtracking"
    rows = {cells[0]: cells[1:] for cells in shown["rows"]}
    assert list(rows) == [name.replace("_", " ") for name in MEASURES]
    assert rows["high speed transient offtracking"][:2] == ["1.018 m", "FAIL"]
    assert rows["yaw damping coefficient"][:3] == ["0.3721", "pass", "PBS: ≥ 0.15"]
    assert shown["definitions"] == len(MEASURES)
    assert shown["lane_change"]
    assert shown["moved"], "the animation stands still"
    # Four units in the plan; four curves twice, two paths, the steer angle, decay, amplification; two tracks.
    assert shown["units"] == 4
    assert shown["lines"] == 4 + 4 + 2 + 1 + 1 + 1 + 2
    assert shown["modes"] == 5
    assert served.asked == {"/frame.html", "/page.html", "/told"}


@needs_browser
@pytest.mark.parametrize("width", [1280, 390])
def test_page_of_a_scheme_tells_who_what_and_whether_and_compares(
    width: int, served: Served, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    vehicles = ["--vehicle", "a_double", "--vehicle", "interlink"]
    said = [
        "--project",
        "Bridge",
        "--author",
        "An assessor",
        "--date",
        "2026-11-24",
        "--units",
        "engineering",
    ]
    scheme = ["--scheme", "pbs", "--level", "2"]
    assert run(["assess", *vehicles, *scheme, *said, "--html", str(tmp_path / "page.html")]) == 1
    capsys.readouterr()
    shown = served.looked_at(width)
    assert shown["needed"] <= width
    assert shown["outside"] == []
    assert shown["verdict"].startswith(
        "a_double: FAILS pbs, level 2; level reached: none; decided by rearward amplification steer axle"
    )
    assert "interlink: meets what is known of pbs" in shown["verdict"]
    assert shown["heading"].startswith(
        "Project: BridgeAuthor: An assessorDate: 2026-11-24Scheme: Performance"
    )
    assert shown["turns"] == 2
    assert shown["drawings"] == 2
    assert shown["pictures"] == [
        "Tracking ability on a straight path",
        "Frontal swing",
        "Tail swing",
        "Steer tyre friction demand",
        "Directional stability under braking",
    ]
    assert {"Side by side", "What differs in their data", "Units", "Axles"} <= set(shown["tables"])
    assert len(shown["rows"]) == len(load_scheme("pbs").measures)


@needs_browser
def test_page_prints_to_a4(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "page.pdf"
    assert run(["assess", "--vehicle", "interlink", "--scheme", "rtac", "--pdf", str(path)]) == 0
    capsys.readouterr()
    boxes = set(re.findall(rb"/MediaBox \[([^\]]+)\]", path.read_bytes()))
    (box,) = (tuple(map(float, each.split())) for each in boxes)
    assert box == pytest.approx((0.0, 0.0, 595.0, 842.0), abs=1.5)


def test_without_a_browser_printing_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert run(["assess", "--scheme", "rtac", "--pdf", str(tmp_path / "page.pdf")]) == 2
    assert "needs a browser that prints, none of chromium," in capsys.readouterr().err


@needs_browser
def test_page_of_an_unstable_vehicle_leaves_out_what_there_is_not(served: Served, tmp_path: Path) -> None:
    car = load_vehicle("single_vehicle", ["units.0.axles.1.cornering_stiffness=3e4"])
    findings = assess(car, speed=40.0)
    page = assessment_page([Assessment(car, "consistent", load_scheme("lateral"), None, findings)])
    (tmp_path / "page.html").write_text(page)
    shown = served.looked_at(390, "--blink-settings=preferredColorScheme=0")
    assert shown["verdict"].startswith("Fails: least damping ratio")
    assert shown["needed"] <= 390
    assert not shown["lane_change"]
    assert shown["modes"] >= 1
    assert shown["background"] == "rgb(22, 24, 27)"


@pytest.mark.parametrize("name", builtin_vehicles())
def test_page_of_every_builtin_needs_nothing_from_elsewhere(name: str) -> None:
    vehicle = load_vehicle(name)
    scheme = load_scheme("lateral")
    text = assessment_page([Assessment(vehicle, "consistent", scheme, None, assess(vehicle))])
    addresses = set(re.findall(r"https?://[^\"'\s)]+", text))
    assert addresses == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"<link[^>]+href=\"(?!data:)|<script[^>]+src=|@import|url\(", text)
    assert "NaN" not in text
    (held,) = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    data = json.loads(held)
    assert len(data["units"]) == len(vehicle.units)
    assert len(data["lane_change"]["time"]) == len(data["lane_change"]["x"]) > 100


def test_page_that_cannot_be_written_is_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert run(["assess", "--html", str(tmp_path / "nowhere" / "page.html")]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.endswith("page.html: cannot be written: No such file or directory\n")
