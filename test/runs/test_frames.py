import math

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from yawdamp_ros import load_vehicle
from yawdamp_ros.runs.frames import TF_TYPE, Frames
from yawdamp_ros.runs.message_definitions import message_definition
from yawdamp_ros.simulation.models import make_motion
from yawdamp_ros.stepping import AppliedInput, Sample

STORE = get_typestore(Stores.ROS2_JAZZY)
STAMP = 1_700_000_000_123_456_789
INTERLINK = load_vehicle("interlink")


def turned() -> Sample:
    """The interlink two seconds into a turn."""
    motion = make_motion(INTERLINK, "consistent", None, 0.01)
    motion.apply(AppliedInput(0, "steering", 0.05))
    return motion.run([0.05] * 200)


def transforms(data: bytes) -> dict[str, tuple[str, int, float, float, float]]:
    """Parent, stamp, place and yaw of every frame of a message, as rosbags reads it."""
    return {
        each.child_frame_id: (
            each.header.frame_id,
            each.header.stamp.sec * 10**9 + each.header.stamp.nanosec,
            each.transform.translation.x,
            each.transform.translation.y,
            2.0 * math.atan2(each.transform.rotation.z, each.transform.rotation.w),
        )
        for each in STORE.deserialize_cdr(data, TF_TYPE).transforms
    }


@pytest.mark.parametrize("prefix", ["", "l/", "left/", "right_"])
def test_the_tree_of_frames_leads_to_the_pose_of_every_unit(prefix: str) -> None:
    sample, frames = turned(), Frames(INTERLINK, prefix)
    (moving,) = frames.moving(sample, [STAMP])
    tree = transforms(moving) | transforms(frames.fixed(STAMP))
    assert {stamp for _, stamp, *_ in tree.values()} == {STAMP}
    for index, name in enumerate(INTERLINK.unit_names):
        chain, frame = [], prefix + name
        while frame != f"{prefix}odom":
            chain.append(tree[frame])
            frame = tree[frame][0]
        place, yaw = 0j, 0.0
        for _, _, x, y, turn in reversed(chain):
            place += complex(x, y) * np.exp(1j * yaw)
            yaw += turn
        assert place == pytest.approx(complex(sample.x[index], sample.y[index]), abs=1e-9)
        assert yaw == pytest.approx(sample.yaw[index], abs=1e-12)


def test_what_is_fixed_is_apart_from_what_moves() -> None:
    frames = Frames(INTERLINK, "")
    moving, fixed = transforms(frames.moving(turned(), [STAMP])[0]), transforms(frames.fixed(STAMP))
    assert set(fixed) == {"trailer_1", "trailer_2"}
    assert {child for child, (parent, *_) in moving.items() if parent == "odom"} == {"truck"}
    assert not set(moving) & set(fixed)


def test_without_the_hitches_only_the_lead_unit_moves() -> None:
    frames = Frames(INTERLINK, "", hitches=False)
    assert set(transforms(frames.moving(turned(), [STAMP])[0])) == {"truck"}
    assert transforms(frames.fixed(STAMP)) == {}


def test_a_sample_of_several_instants_has_a_message_for_each() -> None:
    motion = make_motion(INTERLINK, "consistent", None, 0.01)
    sample = motion.run([0.05] * 30, 10)
    messages = Frames(INTERLINK, "").moving(sample, [1, 2, 3])
    assert [transforms(data)["truck"][2] for data in messages] == sample.x[:, 0].tolist()


def test_the_definition_of_the_message_holds_that_of_a_transform() -> None:
    text = message_definition(TF_TYPE).text
    assert text.startswith("geometry_msgs/TransformStamped[] transforms\n")
    assert "MSG: geometry_msgs/Quaternion" in text
