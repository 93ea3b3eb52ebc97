"""Jumps of the time stamps of a run, as a recording holds them."""

import struct

JUMP = "time_jump"
"""Topic of the jumps [ns]; each applies to all later messages."""
INT64 = "std_msgs/msg/Int64"


def jump_of(data: bytes) -> int:
    """Jump in ns that a message in CDR holds."""
    jump: int = struct.unpack_from("<q", data, 4)[0]
    return jump
