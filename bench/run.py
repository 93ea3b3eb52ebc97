"""Every benchmark in one run: a table, and its figures as JSON. `make bench`."""

import compileall
import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import pyperf
from rich.console import Console
from rich.table import Table

import cluster
import control_steps
import fleet
import measures
import nodes
import starts
from rows import Row, by_turns, figure, holds, machine
from whole_run import simulated, steering_log, written_anew

HERE = Path(__file__).parent
RESULTS = HERE / "results.json"
HOUR = 3600
ROUNDS = 5


def in_process(directory: Path) -> list[Row]:
    """Run pyperf's benchmarks in rounds, so that other load on the machine slows all of them alike."""
    # One core for everybody: nothing here may win by a second one.
    threads = "OPENBLAS_NUM_THREADS"
    times: dict[str, list[float]] = {}
    for index in range(ROUNDS):
        results = directory / f"in_process_{index}.json"
        options = ["--quiet", f"--inherit-environ={threads}", "-o", str(results)]
        subprocess.run(  # noqa: S603 - this project's own script
            [sys.executable, str(HERE / "in_process.py"), *options],
            check=True,
            stdout=subprocess.DEVNULL,
            env={**os.environ, threads: "1"},
        )
        for benchmark in pyperf.BenchmarkSuite.load(str(results)):
            times.setdefault(benchmark.get_name(), []).extend(benchmark.get_values())

    def row(what: str, name: str, reference: str, wanted: str) -> Row:
        return Row(what, reference, times[name], times[reference], "s", wanted)

    product = "matrix-vector product"
    return [
        row("`scipy.signal.lsim`, 15 s of the interlink at 1 kHz", "lsim", "linear_response", ">= 20"),
        row("`control.forced_response`, the same", "forced_response", "linear_response", ">= 20"),
        row("`lsim` against a whole response, path and all units", "lsim", "respond", ""),
        row("one step of the node's stepper", "step", product, "<= 2.5"),
        row("a sample of all outputs", "sample", product, ""),
        row("a change to a speed that it never had", "change of speed", product, "<= 125"),
        row("15 s at 100 Hz, a new speed at every sample", "changing speed", "constant speed", ""),
        row("one step of the nonlinear interlink", "nonlinear step", product, "<= 25"),
        row("`solve_ivp` of its equations, 2 s in steps of 1 ms", "solve_ivp", "nonlinear steps", ">= 1"),
        row("the same in steps of its own, within 1e-6", "solve_ivp, adaptive", "nonlinear steps", ""),
        row("100,000 eigenvalue problems in a sweep", "sweep", "eigvals", "<= 1.5"),
    ]


def of_runs(directory: Path) -> list[Row]:
    """`simulate` of an hour."""
    log = directory / "hour.csv"
    steering_log(log, HOUR)
    ours, least = [], []
    for index in range(2):
        run = directory / f"run_{index}"
        ours.append(simulated(log, run))
        least.append(written_anew(run, directory / f"copy_{index}.mcap"))
    what = f"simulate, an hour at 100 Hz ({HOUR / statistics.median(ours):.0f} times real time)"
    return [Row(what, "serialising and writing alone", ours, least, "s", "<= 1.15")]


def of_nodes(directory: Path) -> list[Row]:
    """The node beside the bare node."""
    peer = nodes.Peer()
    bare = [*nodes.BARE, "100"]
    nonlinear = [*nodes.SIM, "--model", "nonlinear"]

    def load(command: list[str]) -> Callable[[], float]:
        return lambda: nodes.processor_time(peer, command, directory)

    begun = nodes.starts(peer, directory)
    rates = by_turns(
        lambda: nodes.highest_rate(nodes.sim_keeps_up, directory),
        lambda: nodes.highest_rate(nodes.bare_keeps_up, directory),
        1,
    )
    took = sorted(nodes.latencies(peer, directory))
    late = [took[int(0.99 * len(took))]]
    recording = "processor time at 100 Hz, recording"
    shown = "steering to first output that shows it, 99th percentile"
    return [
        Row(recording, "bare node", *by_turns(load(nodes.SIM), load(bare), ROUNDS), "cores", "<= 1.3"),
        Row(
            f"{recording}, of the nonlinear model at 1 kHz",
            "bare node",
            *by_turns(load(nonlinear), load(bare), 3),
            "cores",
            "<= 1.3",
        ),
        Row("highest rate without a lost step", "bare node", *rates, "Hz", ">= 0.9"),
        Row(shown, "one period", late, [0.01], "s", "<= 1.2"),
        Row("start to first message", "bare node", *begun, "s", "<= 1.3"),
    ]


def of_memory(directory: Path) -> list[Row]:
    """The node's memory while it records ten minutes at 1 kHz."""
    after_one, after_ten = nodes.memory(directory)
    what = "memory after 10 minutes at 1 kHz, recording"
    return [Row(what, "after 1 minute", [after_ten], [after_one], "MB", "<= 1.05")]


PARTS = {
    "in_process": in_process,
    "control_steps": control_steps.of_plants,
    "measures": measures.of_stacks,
    "fleet": fleet.of_fleets,
    "starts": starts.of_commands,
    "cluster": cluster.of_clusters,
    "runs": of_runs,
    "nodes": of_nodes,
    "memory": of_memory,
}


def main() -> None:
    """Measure everything but memory, or the parts that are named; print the table, renew results.json."""
    chosen = sys.argv[1:] or [name for name in PARTS if name != "memory"]
    # As installing does: where the environment forbids bytecode, each start would compile the package anew.
    compileall.compile_dir(HERE.parent / "yawdamp_ros", quiet=1)
    parts: dict[str, list[Row]] = {}
    with tempfile.TemporaryDirectory() as directory:
        for name in chosen:
            parts[name] = PARTS[name](Path(directory))
            for row in parts[name]:
                print(f"{row.what}: {row.ratio:.3g} times {row.against}", flush=True)
    table = Table("what", "figure", "against", "figure", "ratio", "wanted", "met", title=machine())
    for row in (row for rows in parts.values() for row in rows):
        table.add_row(
            row.what,
            figure(row.value, row.unit),
            row.against,
            figure(row.reference, row.unit),
            f"{row.ratio:.3g}",
            row.wanted,
            holds(row),
        )
    Console(width=160).print(table)
    kept = json.loads(RESULTS.read_text(encoding="utf-8"))
    # Parts that were not measured anew stand, if this is the machine that they were measured on.
    known = kept["rows"] if kept["machine"] == machine() else []
    found = [
        {"part": name, **row._asdict(), "ratio": row.ratio} for name, rows in parts.items() for row in rows
    ]
    rows = [*found, *(row for row in known if row["part"] not in parts)]
    rows.sort(key=lambda row: list(PARTS).index(row["part"]))
    RESULTS.write_text(json.dumps({"machine": machine(), "rows": rows}, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
