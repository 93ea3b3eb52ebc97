"""The commands: one module each; parse, call, print."""

from yawdamp_ros.cli.dispatch import run

__all__ = ["run"]
