"""`assess --random`: share of many vehicles that meets a level, and the decisive measures."""

import argparse
import json

import numpy as np

from yawdamp_ros.analysis import Scheme
from yawdamp_ros.analysis.measures import ALL_MEASURES
from yawdamp_ros.analysis.points import Draws
from yawdamp_ros.analysis.share import SchemeStudy, Share, share_of
from yawdamp_ros.analysis.study import Study, evaluate_all
from yawdamp_ros.cli.console import progress_bar
from yawdamp_ros.cli.draws import parse_span
from yawdamp_ros.cli.executors import mapping
from yawdamp_ros.cli.options import DEFAULT_MODEL, chosen_vehicle, overrides
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.vehicle import vehicle_text


def run(options: argparse.Namespace, scheme: Scheme, name: str) -> int:
    """Draw, assess and report; 0 if all meet the level."""
    spans = [parse_span(text) for text in options.range]
    chosen_vehicle(options, name)  # warns of implausible values, whichever key varies
    text, changes = vehicle_text(name), tuple(overrides(options))
    keys = tuple(each for each, _ in spans)
    model = options.model or DEFAULT_MODEL
    study = SchemeStudy(
        tuple(Study(text, name, changes, model, keys, measure) for measure in scheme.measures)
    )
    points = Draws([span for _, span in spans], options.random, options.seed or 0)
    study.check(points)
    gathered = []
    with progress_bar("vehicles") as bar:
        task = bar.add_task("assessing", total=len(points))
        chunks = -(-len(points) // study.chunk)
        with mapping(chunks, options.jobs, None) as mapped:
            for values in evaluate_all(study, points, mapped):
                gathered.append(values)
                bar.advance(task, len(values))
    share = share_of(scheme, study.columns, np.concatenate(gathered), options.level, options.srt)
    if options.format == "json":
        print(json.dumps(_record(name, scheme, options, share), indent=2))
    else:
        _print(name, scheme, options, share)
    return 0 if share.meeting == 1.0 else 1


def _record(name: str, scheme: Scheme, options: argparse.Namespace, share: Share) -> dict[str, object]:
    return {
        "vehicle": name,
        "scheme": scheme.name,
        "level": options.level,
        "count": share.count,
        "seed": options.seed or 0,
        "meeting": share.meeting,
        "reaching": share.reaching,
        "failing": share.failing,
        "failing_alone": share.alone,
        "unknown": share.unknown,
        "assuming": _assuming(share),
    }


def _print(name: str, scheme: Scheme, options: argparse.Namespace, share: Share) -> None:
    asked = f"{scheme.name}, level {options.level}" if options.level else scheme.name
    print(f"{name}: {100.0 * share.meeting:.1f} % of {share.count} vehicles meet {asked}")
    if share.reaching:
        print("; ".join(f"level {level}: {100.0 * part:.1f} %" for level, part in share.reaching.items()))
    deciding = sorted(share.failing.items(), key=lambda item: -item[1])
    rows = [
        (measure, f"{100.0 * part:.1f} %", f"{100.0 * share.alone[measure]:.1f} %")
        for measure, part in deciding
        if part > 0.0
    ]
    if rows:
        print_table("What decides", ("measure", "fails in", "alone in"), rows, width=80)
    if share.unknown:
        print(f"not known: {', '.join(share.unknown)}")
    if assuming := _assuming(share):
        print(f"by assumptions for {', '.join(assuming)}")


def _assuming(share: Share) -> list[str]:
    """Measures with a limit whose value rests on assumptions."""
    return [name for name in share.failing if getattr(ALL_MEASURES[name], "assumes", "")]
