"""Schemes of levels: data files that say which measures count, and against which limits."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.files import read_text
from yawdamp_ros.plain_yaml import parse_yaml
from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle import VehicleError
from yawdamp_ros.vehicle.schema import check_schema

DEFAULT_SCHEME = "lateral"
KINDS = ("most", "least", "above")
SIGNS = {"most": "<=", "least": ">=", "above": ">"}
LARGEST_FILE, MOST_VALUES = 1 << 16, 2000


@dataclass(frozen=True)
class Requirement:
    """Requirement of a scheme on a measure.

    Attributes
    ----------
    measure : str
    kind : str
        ``least`` and ``above`` bound the value from below, ``most`` from above.
    limits : tuple of float
        Limits in the measure's unit, or per unit of another measure; one for each level, or one for all.
    times : str
        Measure that the limits are multiplied by; empty for none.
    text : str
        Text of the requirement in tables.
    note : str
        Note of the scheme's file.

    Examples
    --------
    >>> Requirement("tail_swing", "most", (0.3, 0.35)).met(0.32, 1, {})
    True
    """

    measure: str
    kind: str
    limits: tuple[float, ...]
    times: str = ""
    text: str = ""
    note: str = ""

    def limit(self, level: int, values: Mapping[str, float | None]) -> float | None:
        """Limit of a level; None where it depends on a measure without a value.

        Parameters
        ----------
        level : int
            Index among the scheme's levels.
        values : mapping of str to float or None
            Values of the measures, by name.

        Returns
        -------
        float or None
        """
        limit = self.limits[min(level, len(self.limits) - 1)]
        if not self.times:
            return limit
        factor = values.get(self.times)
        return None if factor is None else limit * factor

    def met(self, value: float, level: int, values: Mapping[str, float | None]) -> bool | None:
        """Compare a value with a level; None where its limit is not known."""
        limit = self.limit(level, values)
        if limit is None:
            return None
        return {"least": value >= limit, "above": value > limit, "most": value <= limit}[self.kind]


@dataclass(frozen=True)
class Scheme:
    """Measures that count, and their limits.

    Attributes
    ----------
    name, title : str
    levels : tuple of str
        Levels, the hardest first; a scheme without levels has one without a name.
    measures : tuple of str
        Measures in the order of the file.
    requirements : tuple of Requirement
    sources : tuple of str
        Sources of the limits.

    Examples
    --------
    >>> scheme = load_scheme("pbs")
    >>> scheme.levels
    ('1', '2', '3', '4')
    >>> [limit.limits for limit in scheme.of("tail_swing")]
    [(0.3, 0.35, 0.35, 0.5)]
    """

    name: str
    title: str
    levels: tuple[str, ...]
    measures: tuple[str, ...]
    requirements: tuple[Requirement, ...]
    sources: tuple[str, ...]

    def of(self, measure: str) -> tuple[Requirement, ...]:
        """Return the requirements of a measure.

        Parameters
        ----------
        measure : str
        """
        return tuple(each for each in self.requirements if each.measure == measure)

    def level(self, name: str) -> int:
        """Place of a level by its name.

        Parameters
        ----------
        name : str

        Raises
        ------
        AnalysisError
            If the scheme has no such level.
        """
        if name not in self.levels or not name:
            known = f"one of {', '.join(self.levels)}" if self.levels[0] else "none: the scheme has no levels"
            message = f"level: {name}: {self.name}: expected {known}"
            raise AnalysisError(message)
        return self.levels.index(name)


def builtin_schemes() -> tuple[str, ...]:
    """Return the names of the schemes that come with the package.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> builtin_schemes()
    ('lateral', 'pbs', 'rtac')
    """
    return tuple(sorted(path.stem for path in _directory().glob("*.yaml")))


def load_scheme(scheme: str | Path, only: str | None = None, vehicle_class: str | None = None) -> Scheme:
    """Read a scheme by builtin name or from a file.

    Parameters
    ----------
    scheme : str or Path
        One of `builtin_schemes`, or the path of a YAML file.
    only : str, optional
        Names of its measures that count, separated by commas; all unless given.
    vehicle_class : str, optional
        Class of vehicles whose own limits count, where the scheme has such.

    Returns
    -------
    Scheme

    Raises
    ------
    AnalysisError
        If there is no such scheme, or its file is not valid; the message names file, key and what was
        expected.

    Examples
    --------
    >>> load_scheme("rtac").measures[0]
    'static_rollover_threshold'
    >>> load_scheme("pbs", "tail_swing").measures
    ('tail_swing',)
    >>> load_scheme("pbs", vehicle_class="tanker").of("static_rollover_threshold")[0].limits
    (0.4,)
    """
    source = str(scheme) or "''"
    known = builtin_schemes()
    path = _directory() / f"{source}.yaml" if source in known else Path(source)
    try:
        data = parse_yaml(read_text(path, LARGEST_FILE), MOST_VALUES)
        check_schema(data, source, "scheme.schema.json")
    except FileNotFoundError as error:
        message = f"{source}: no such scheme; expected a file or one of {', '.join(known)}"
        raise AnalysisError(message) from error
    except OSError as error:
        message = f"{source}: cannot be read: {error.strerror}"
        raise AnalysisError(message) from error
    except VehicleError as error:
        raise AnalysisError(str(error)) from error
    except ValueError as error:  # no UTF-8 or no YAML
        message = f"{source}: {error}"
        raise AnalysisError(message) from error
    built = _build(data, source, vehicle_class)
    return built if only is None else _restricted(built, only.split(","))


def _restricted(scheme: Scheme, names: list[str]) -> Scheme:
    """Scheme with some of its measures, as its name says, and those that multiply limits of these."""
    for name in names:
        if name not in scheme.measures:
            message = f"measures: {name}: {scheme.name}: expected one of {', '.join(scheme.measures)}"
            raise AnalysisError(message)
    kept = tuple(each for each in scheme.requirements if each.measure in names)
    needed = {*names, *(each.times for each in kept)}
    return replace(
        scheme,
        name=f"{scheme.name} ({len(set(names))} of {len(scheme.measures)} measures)",
        measures=tuple(name for name in scheme.measures if name in needed),
        requirements=kept,
    )


def _build(data: dict[str, Any], source: str, vehicle_class: str | None) -> Scheme:
    from yawdamp_ros.analysis.measures import ALL_MEASURES  # noqa: PLC0415 - which loads much of SciPy

    levels = tuple(data.get("levels", [""]))
    names = tuple(entry["measure"] for entry in data["measures"])
    classes = sorted({each for limit in _limits(data["measures"]) for each in limit.get("classes", ())})
    if vehicle_class is not None and vehicle_class not in classes:
        known = f"one of {', '.join(classes)}" if classes else "none: the scheme has no classes"
        message = f"class: {vehicle_class}: {data['name']}: expected {known}"
        raise AnalysisError(message)
    requirements = tuple(_requirements(data["measures"], source, len(levels), vehicle_class))
    for place, name in enumerate(names):
        if name not in ALL_MEASURES:
            message = f"{source}: measures.{place}: {name}: expected one of {', '.join(ALL_MEASURES)}"
            raise AnalysisError(message)
        if names.index(name) != place:
            message = f"{source}: measures.{place}: {name}: expected every measure once"
            raise AnalysisError(message)
    for each in requirements:
        if each.times and each.times not in ALL_MEASURES:
            message = f"{source}: {each.measure}: times: {each.times}: expected a measure"
            raise AnalysisError(message)
    name = data["name"] if vehicle_class is None else f"{data['name']} for the class {vehicle_class}"
    return Scheme(name, data["title"], levels, names, requirements, tuple(data["sources"]))


def _limits(entries: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [limit for entry in entries for limit in entry.get("require", ())]


def _requirements(
    entries: list[dict[str, Any]], source: str, levels: int, vehicle_class: str | None
) -> Iterator[Requirement]:
    for place, entry in enumerate(entries):
        for limit in entry.get("require", ()):
            (kind,) = (kind for kind in KINDS if kind in limit)
            given = limit.get("classes", {}).get(vehicle_class, limit[kind])
            values = given if isinstance(given, list) else [given]
            if len(values) not in {1, levels}:
                message = (
                    f"{source}: measures.{place}.require: {kind}: {len(values)} limits: "
                    f"expected one, or one for each of {levels} levels"
                )
                raise AnalysisError(message)
            times = limit.get("times", "")
            text = f"{SIGNS[kind]} {', '.join(f'{value:g}' for value in values)}" + (times and f" x {times}")
            yield Requirement(
                entry["measure"],
                kind,
                tuple(map(float, values)),
                times,
                limit.get("text", text),
                limit.get("note", ""),
            )


def _directory() -> Path:
    return share_directory() / "config" / "schemes"
