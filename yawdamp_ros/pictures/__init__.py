"""Pictures: results in, matplotlib figures out; no file is read here."""

from yawdamp_ros.pictures.errors import PictureError
from yawdamp_ros.pictures.figure import new_figure, save

__all__ = ["PictureError", "new_figure", "save"]
