"""Matching of measured channels to the outputs of a vehicle."""

from typing import NamedTuple

from yawdamp_ros.drives.channel import Channel, quantity_of
from yawdamp_ros.drives.drive import Drive

COMPARED = ("yaw_rate", "lateral_acceleration", "articulation", "yaw")
"""Quantities that a model gives at every instant, without a drift of its own but for the yaw."""


class Match(NamedTuple):
    """A measured channel and the output that it measures.

    Attributes
    ----------
    output : str
        Name of the output, as in ``truck/yaw_rate`` or ``articulation_1``.
    channel : Channel

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import matches
    >>> matches(drive, ("truck", "trailer"))[0][0].channel.name
    'trailer/yaw_rate'
    """

    output: str
    channel: Channel


def matches(drive: Drive, unit_names: tuple[str, ...]) -> tuple[list[Match], list[str]]:
    """Return the measured channels of a drive by the outputs of a vehicle, and notes on those left out.

    A channel of a unit of the vehicle is that unit's; one of no unit, or of something that is no unit,
    is the lead unit's, if it is the only one of its quantity.

    Parameters
    ----------
    drive : Drive
    unit_names : tuple of str

    Returns
    -------
    list of Match
    list of str
        A line for each channel that was left out.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0)
    >>> from yawdamp_ros.drives import matches
    >>> found, notes = matches(drive, ("truck", "trailer"))
    >>> [match.output for match in found]
    ['trailer/yaw_rate', 'truck/yaw_rate', 'truck/lateral_acceleration']
    """
    found: dict[str, Channel] = {}
    strangers: dict[str, list[Channel]] = {}
    notes = []
    for channel in drive.measured:
        owner, _, last = channel.name.rpartition("/")
        quantity = quantity_of(channel.name)
        if quantity not in COMPARED:
            continue
        if quantity == "articulation":
            if int(last.removeprefix("articulation_")) < len(unit_names):
                found[last] = channel
            else:
                notes.append(f"{channel.name}: the vehicle has no such joint")
        elif owner in unit_names:
            found[channel.name] = channel
        else:
            strangers.setdefault(quantity, []).append(channel)
    for quantity, channels in strangers.items():
        output = f"{unit_names[0]}/{quantity}"
        if output in found or len(channels) > 1:
            names = ", ".join(channel.name for channel in channels)
            notes.append(f"{names}: of no unit of the vehicle; say --channel {output}=PLACE to take one")
        else:
            found[output] = channels[0]
    order = {name: place for place, name in enumerate(COMPARED)}
    return [
        Match(output, channel)
        for output, channel in sorted(found.items(), key=lambda item: order[quantity_of(item[0])])
    ], notes
