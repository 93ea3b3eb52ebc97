"""The one exception of the pictures room."""

from yawdamp_ros.errors import YawdampError


class PictureError(YawdampError):
    """A picture that cannot be drawn or written.

    Examples
    --------
    >>> from yawdamp_ros.pictures import PictureError, new_figure, save
    >>> try:
    ...     save(new_figure(4.0, 3.0), "picture.jpg")
    ... except PictureError as error:
    ...     print(error)
    picture.jpg: expected a name ending in .png or .svg
    """
