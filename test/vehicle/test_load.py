from pathlib import Path

import pytest

from yawdamp_ros.share import share_directory
from yawdamp_ros.vehicle import Axle, VehicleError, builtin_vehicles, load_vehicle, vehicle_text

INTERLINK = vehicle_text("interlink")


def test_the_interlink_holds_the_numbers_of_the_report() -> None:
    vehicle = load_vehicle("interlink")
    truck, trailer_1, trailer_2 = vehicle.units
    assert vehicle.unit_names == ("truck", "trailer_1", "trailer_2")
    assert vehicle.speed == pytest.approx(80 / 3.6, abs=1e-12)
    assert sum(unit.mass for unit in vehicle.units) == 56000.0
    assert [unit.yaw_inertia for unit in vehicle.units] == [36776.6, 53285.6, 376276.03]
    assert truck.axles == (
        Axle(0.040, 891384.14, steered=True, static_load=2 * 32843.88),
        Axle(-3.719, 592777.40, static_load=4 * 19239.86),
        Axle(-5.119, 592777.40, static_load=4 * 19239.86),
    )
    assert [axle.position for axle in trailer_1.axles] == [-5.225, -6.625]
    assert [axle.cornering_stiffness for axle in trailer_2.axles] == [632902.54] * 2
    assert [axle.static_load for axle in trailer_1.axles] == [4 * 20386.41] * 2
    assert [axle.static_load for axle in trailer_2.axles] == [4 * 20832.76] * 2
    assert vehicle.hitches == ((-3.311, 1.275), (-5.225, 4.645))


@pytest.mark.parametrize("name", builtin_vehicles())
def test_every_builtin_is_valid_and_named_after_its_file(name: str) -> None:
    assert load_vehicle(name).name == name


def test_a_file_is_read_as_a_builtin_is(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(INTERLINK, encoding="utf-8")
    assert load_vehicle(path) == load_vehicle("interlink")


def test_overrides_change_one_value_each() -> None:
    changed = load_vehicle("interlink", ["units.1.mass=4156", "units.0.axles.2.position=-5.2", "speed=1e1"])
    assert changed.units[1].mass == 4156.0
    assert changed.units[0].axles[2].position == -5.2
    assert changed.speed == 10.0
    assert changed.units[2] == load_vehicle("interlink").units[2]


@pytest.mark.parametrize(
    "override, message",
    [
        ("units.1.mas=1.0", "units.1.mas: unknown key; expected one of name, mass"),
        ("units.1.mass=heavy", "units.1.mass: 'heavy': expected a mass in kg, from 0.001"),
        ("units.1.mass=true", "units.1.mass: True: expected a mass in kg, from 0.001"),
        ("units.1.mass=0", "units.1.mass: 0: expected a mass in kg, from 0.001"),
        ("units.1.mass=-3.5", "units.1.mass: -3.5: expected a mass in kg, from 0.001"),
        ("units.1.mass=1e-300", "units.1.mass: 1e-300: expected a mass in kg, from 0.001"),
        ("units.1.mass=.inf", "units.1.mass: inf: expected a finite number"),
        ("units.1.mass=.nan", "units.1.mass: nan: expected a finite number"),
        (f"units.1.mass=1{'0' * 400}", "units.1.mass: a very long number: expected a finite number"),
        ("units.2.yaw_inertia=0", "units.2.yaw_inertia: 0: expected a yaw moment of inertia"),
        (
            "units.0.axles.0.cornering_stiffness=-1.0",
            "units.0.axles.0.cornering_stiffness: -1.0: expected a cornering stiffness",
        ),
        (
            "units.0.axles.0.cornering_stiffness=5e-324",
            "units.0.axles.0.cornering_stiffness: 5e-324: expected a cornering stiffness",
        ),
        ("units.0.axles.0.position=40", "units.0.axles.0.position: 40: expected a distance"),
        ("units.0.rear_hitch=-3311", "units.0.rear_hitch: -3311: expected a distance"),
        ("units.1.axles.0.position=-29.0", "units.1: 30.275 m from its foremost to its rearmost"),
        ("units.1.name=truck", "units.1.name: 'truck': expected a name not yet taken"),
        ("name=../truck", "name: '../truck': expected a name of lower-case"),
        ('name="truck\\n"', "name: 'truck\\n': expected a name of lower-case"),
        ("units.1.name=Trailer 1", "units.1.name: 'Trailer 1': expected a name of lower-case"),
        ("units.0.front_hitch=1.0", "units.0.front_hitch: the lead unit is not towed"),
        ("units.1.rear_hitch=2.0", "units.1.rear_hitch: 2.0: expected a position behind"),
        ("units.0.axles.0.steered=false", "units.0.axles: no axle of the lead unit is steered"),
        ("units.0.axles=[]", "units.0.axles: []: expected a list of at least one axle"),
        ("units=[]", "units: []: expected a list of at least one unit"),
        ("speed=80", "speed: 80: expected a speed in m/s, from 0.01 to 70 (80 km/h is 22.2222)"),
        ("speed=0", "speed: 0: expected a speed"),
        ("units.7.mass=1.0", "units.7.mass: no such key to set"),
        ("units.x.mass=1.0", "units.x.mass: 'x': expected a number, *, or one of "),
        ("units.1.mass", "units.1.mass: expected KEY=VALUE"),
        ("units.1.mass=[", "--set units.1.mass=[: line 1: not valid YAML"),
    ],
)
def test_a_wrong_value_is_refused_in_one_line_that_names_it(override: str, message: str) -> None:
    with pytest.raises(VehicleError) as caught:
        load_vehicle("interlink", [override])
    assert message in str(caught.value)
    assert "interlink" in str(caught.value) or "--set" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("    rear_hitch: -3.311", "    #", "units.0.rear_hitch: missing: truck tows the next unit"),
        ("    front_hitch: 4.645", "    #", "units.2.front_hitch: missing: trailer_2 is towed"),
        ("    yaw_inertia: 53285.6", "    #", "units.1.yaw_inertia: missing"),
        ("name: interlink", "name: interlink\nname: other", "line 3: not valid YAML: found duplicate key"),
        ("speed:", "speed: !!python/object/apply:os.getcwd []\nx:", "not valid YAML"),
        ("units:", "units: [", "not valid YAML"),
    ],
)
def test_a_wrong_file_is_refused_in_one_line_that_names_it(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    path = tmp_path / "wrong.yaml"
    assert old in INTERLINK
    path.write_text(INTERLINK.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(VehicleError) as caught:
        load_vehicle(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["", "3", "[]", "just words", "a: {b: [c"])
def test_what_is_no_vehicle_at_all_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "other.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(VehicleError, match=r"other.yaml: "):
        load_vehicle(path)


def test_a_name_that_is_neither_file_nor_builtin_lists_the_builtins() -> None:
    with pytest.raises(
        VehicleError, match=r"interlnk: no such vehicle; expected a file or one of .*interlink"
    ):
        load_vehicle("interlnk")


def test_a_directory_and_a_binary_file_are_refused(tmp_path: Path) -> None:
    with pytest.raises(VehicleError, match="cannot be read"):
        load_vehicle(tmp_path)
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(VehicleError, match="not UTF-8 text"):
        load_vehicle(binary)


def test_vehicle_files_name_the_schema_that_editors_read() -> None:
    for name in builtin_vehicles():
        first = vehicle_text(name).splitlines()[0]
        schema = first.partition("$schema=")[2]
        assert (share_directory() / "config" / "vehicles" / schema).resolve().is_file()


@pytest.mark.parametrize(
    "name, said",
    [
        ("trailer_1_hitch", "units.2.name: 'trailer_1_hitch': that is the frame of the hitch of trailer_1"),
        ("odom", "units.2.name: 'odom': that is the frame of the ground"),
        ("truck_steered_axle", "that is the frame of the steered axle of truck"),
    ],
)
def test_names_of_other_frames_are_refused(name: str, said: str) -> None:
    with pytest.raises(VehicleError, match=said):
        load_vehicle("interlink", [f"units.2.name={name}"])


@pytest.mark.parametrize("text", ["1: 2", "units: [{2: 3}]", "? [1]\n: 2", "null: 1"])
def test_keys_that_are_no_names_are_refused(text: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(VehicleError, match=r"unknown key; expected a name|not valid YAML"):
        load_vehicle(path)


@pytest.mark.parametrize("bracket", ["[", "{a: ", "- "])
def test_deep_nesting_is_refused(bracket: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(bracket * 20_000, encoding="utf-8")
    with pytest.raises(VehicleError, match="not valid YAML"):
        load_vehicle(path)


def test_indices_are_counted_from_the_front() -> None:
    with pytest.raises(VehicleError, match=r"units.1.axles.-1.position: -1: expected an index, 0 or more"):
        load_vehicle("interlink", ["units.1.axles.-1.position=-5"])
