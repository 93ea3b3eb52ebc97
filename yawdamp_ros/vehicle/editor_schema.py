"""Schema of vehicle files for editors: the canonical keys and every other spelling of them.

A file is checked by `vehicle.schema.json` once it has its canonical keys (`spellings`). Editors see the file
as it is written, so that they need the spellings, too. ``make parameters`` writes the file.
"""

import json
from collections.abc import Iterator, Mapping
from copy import deepcopy
from typing import Any

from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle.spellings import DIMENSIONS, FACTORS, ORIGINS

CANONICAL, WRITTEN = "vehicle.schema.json", "vehicle_file.schema.json"
BOUNDS = ("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum")


def editor_schema() -> dict[str, Any]:
    """Schema that accepts every spelling of the keys of a vehicle file.

    Returns
    -------
    dict

    Examples
    --------
    >>> editor_schema()["properties"]["speed_km_per_h"]["maximum"]
    252.0
    """
    path = share_directory() / "config" / CANONICAL
    schema: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    made = deepcopy(schema)
    made["title"] = "yawdamp_ros vehicle file as it is written"
    for record in (made, *made["$defs"].values()):
        if "properties" in record:
            _spell(record, schema)
    unit, axle = made["$defs"]["unit"], made["$defs"]["axle"]
    unit["properties"] |= {
        "positions_from": {"description": f"one of {', '.join(ORIGINS)}", "enum": list(ORIGINS)},
        "cg_position": schema["$defs"]["position"]
        | {"description": "a position of the unladen centre of gravity, with positions_from, in metres"},
        **_spelled("cg_position", schema["$defs"]["position"]),
    }
    axle["properties"] |= {
        "cornering_coefficient": {
            "description": "a cornering stiffness over the static load in 1/rad, above 0",
            "type": "number",
            "exclusiveMinimum": 0,
        },
        "lifted": {"description": "true or false: an axle off the road", "type": "boolean"},
    }
    del axle["oneOf"]
    stiffness = ("cornering_stiffness", "cornering_coefficient", "tyre_load")
    axle["anyOf"] = [{"required": [name]} for key in stiffness for name in _names(key)]
    return made


def _spell(record: dict[str, Any], schema: Mapping[str, Any]) -> None:
    """Add the spellings with units of a record's keys, any of which a required key may have."""
    for key, described in list(record["properties"].items()):
        record["properties"] |= dict(_spelled(key, _resolved(described, schema)))
    required = record.get("required", [])
    record["required"] = [key for key in required if key not in DIMENSIONS]
    alternatives = [
        {"anyOf": [{"required": [name]} for name in _names(key)]} for key in required if key in DIMENSIONS
    ]
    if alternatives:
        record["allOf"] = alternatives


def _names(key: str) -> Iterator[str]:
    yield key
    for unit in FACTORS.get(DIMENSIONS.get(key, ""), ()):
        yield f"{key}_{unit}"


def _spelled(key: str, described: Mapping[str, Any]) -> dict[str, Any]:
    """Descriptions of a key in each of its units."""
    return {
        f"{key}_{unit}": {
            "description": f"{key} in {unit.replace('_per_', '/').replace('_', ' ')}",
            "type": "number",
            **{bound: described[bound] / factor for bound in BOUNDS if bound in described},
        }
        for unit, factor in FACTORS.get(DIMENSIONS.get(key, ""), {}).items()
    }


def _resolved(described: Mapping[str, Any], schema: Mapping[str, Any]) -> Mapping[str, Any]:
    if "$ref" not in described:
        return described
    found: Any = schema
    for part in described["$ref"].removeprefix("#/").split("/"):
        found = found[part]
    return dict(found)


def main() -> None:
    """Write the schema beside the canonical one."""
    text = json.dumps(editor_schema(), indent=2)
    (share_directory() / "config" / WRITTEN).write_text(f"{text}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
